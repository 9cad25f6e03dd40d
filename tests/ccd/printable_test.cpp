// `printable` turns any text from outside into valid UTF-8 without control characters.
#include "ccd/query/printable.hpp"

#include <gtest/gtest.h>

namespace nearmiss {
namespace {

TEST(Printable, LeavesTextAsItIs) {
  for (const char* text : {"", "wang-tight:p24", "naïve CCD", "ψ ≤ 41 B ε^¼", "水", "a\u00a0b", "\ud7fb",
                           "نیم\u200cفاصله", "a\u3000b", "𝕏"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, ReplacesControlCharacters) {
  EXPECT_EQ(printable("a\nb\tc"), "a b c");
  EXPECT_EQ(printable("\x1b[31mred\x7f\r"), "?[31mred??");
  EXPECT_EQ(printable("a\u0085b"), "a??b");   // NEL, another line end
  EXPECT_EQ(printable("a\u202eb"), "a???b");  // this character reverses the text after it
  EXPECT_EQ(printable("a\u2028b"), "a???b");  // this character is a line end in JavaScript
  for (const char* unseen : {"\u200b", "\u2060", "\ufeff", "\u061c", "\u00ad", "\U000e0041", "\ufe0f",
                             "\ue000", "\uffff", "\u2800"})
    EXPECT_EQ(printable(unseen), std::string(std::string_view(unseen).size(), '?')) << unseen;
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a?b");
}

TEST(Printable, ReplacesBytesThatAreNotUtf8) {
  EXPECT_EQ(printable("\xff"), "?");
  EXPECT_EQ(printable("a\xc3"), "a?");               // a character that is cut off
  EXPECT_EQ(printable("\xc0\xaf"), "??");            // an overlong slash
  EXPECT_EQ(printable("\xed\xa0\x80"), "???");       // a surrogate
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "????");  // beyond Unicode
  EXPECT_EQ(printable("\xe0\x80\xafx"), "???x");
}

}  // namespace
}  // namespace nearmiss

// Numbers as text, arguments for a shell, and digests.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "reports/sha256.hpp"
#include "reports/text/shell.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {
namespace {

TEST(Text, NumbersAreGroupedByThousands) {
  EXPECT_EQ(with_separators(7), "7");
  EXPECT_EQ(with_separators(1234), "1,234");
  EXPECT_EQ(with_separators(123456789), "123,456,789");
}

TEST(Text, WhatIsBelowTheBoundIsNotRoundedToIt) {
  EXPECT_EQ(fraction_of_bound(0.99999962), "0.9999996");
  EXPECT_EQ(fraction_of_bound(0.1234), "0.123");
  EXPECT_EQ(fraction_of_bound(1), "1");
  EXPECT_EQ(fraction_of_bound(1.0001), "1");
  EXPECT_EQ(fraction_of_bound(std::numeric_limits<double>::max()), "inf");
  EXPECT_EQ(times_the_bound(0.1234), "at 0.123 of the bound");
  EXPECT_EQ(times_the_bound(8e11), "at 8e+11 times the bound");
  EXPECT_EQ(times_the_bound(std::numeric_limits<double>::max()), "beyond a bound of 0");
  EXPECT_EQ(fraction_of_bound(std::nextafter(1.0, 0.0)), "0.9999999999999999");
}

TEST(Text, ADistanceThatIsNoFractionOfAClaimSaysSo) {
  EXPECT_EQ(times_the_bound(66.7, DistanceUnit::wangs_bound), "at 66.7 times wang's bound (it claims none)");
  EXPECT_EQ(times_the_bound(std::numeric_limits<double>::max(), DistanceUnit::wangs_bound),
            "beyond wang's bound of 0 (it claims none)");
  EXPECT_EQ(times_the_bound(0.5, DistanceUnit::both), "at 0.5 times wang's bound or a claim");
  EXPECT_EQ(marked_fraction_of_bound(0.1234, DistanceUnit::claimed_bound), "0.123");
  EXPECT_EQ(marked_fraction_of_bound(0.1234, DistanceUnit::wangs_bound), "0.123**");
}

TEST(Text, ATimeThatIsMissingIsADash) {
  EXPECT_EQ(whole_ns(12.6), "13");
  EXPECT_EQ(whole_ns(std::nullopt), "-");
}

TEST(Text, IsBrokenAtBlanksAndLosesNoCharacterWithoutThem) {
  EXPECT_EQ(wrapped("one two three", "  ", 2, 9), "one two\n  three\n");
  EXPECT_EQ(wrapped("abcdefghij", "  ", 2, 9), "abcdefghi\n  j\n");
  EXPECT_EQ(wrapped("abcdefghij", "", 1, 9), "abcde ...\n");
}

TEST(Shell, QuotesWhatItMust) {
  EXPECT_EQ(shell_quoted("./plugin.so"), "./plugin.so");
  EXPECT_EQ(shell_quoted("my plugin"), "'my plugin'");
  EXPECT_EQ(shell_quoted("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_quoted(""), "''");
  for (const char* word : {"plain", "my plugin", "it's", "", "a\\b\"c$d", " "})
    EXPECT_EQ(shell_words(shell_quoted(word)), std::vector<std::string>{word});
}

TEST(Shell, EscapesBytesThatAreNotPrintable) {
  EXPECT_EQ(printable_argument("my plugin"), "'my plugin'");
  EXPECT_EQ(printable_argument("it's M\xe4\\\n.case"), "$'it\\047s M\\344\\134\\012.case'");
}

TEST(Shell, KnowsOneCommand) {
  for (const std::string word : {"a b", "it's", "\n;touch x\xff'", "$HOME", "\\'"})
    for (const std::string& quoted : {shell_quoted(word), printable_argument(word)})
      EXPECT_TRUE(is_one_command("nearmiss fuzz " + quoted + " --cases 3")) << quoted;
  for (const char* more : {"a; b", "a\nb", "a | b", "a 'b", "a $'b\\'", "a $'\\'; b; #'", "a $(b)", "a `b`",
                           "a > b", "a *", "a $b", "a\\", "a #"})
    EXPECT_FALSE(is_one_command(more)) << more;
}

TEST(Text, ACommandIsDividedAsAShellDividesIt) {
  using Words = std::vector<std::string>;
  EXPECT_EQ(shell_words("  python3 \t a.py  "), (Words{"python3", "a.py"}));
  EXPECT_EQ(shell_words("'a b'.py a\\ b.py \"a b\".py"), (Words{"a b.py", "a b.py", "a b.py"}));
  EXPECT_EQ(shell_words("\"it's\" '\"' \"\\\"\\x\" '\\'"), (Words{"it's", "\"", "\"\\x", "\\"}));
  EXPECT_EQ(shell_words("a '' b"), (Words{"a", "", "b"}));
  EXPECT_EQ(shell_words(""), Words{});
}

// The examples of FIPS 180-4.
TEST(Sha256, GivesTheDigestsOfTheStandard) {
  EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_hex("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

TEST(Sha256, DoesNotDependOnThePieces) {
  const auto pieces = Sha256().add("a").add("").add("bc").hex_digest();
  EXPECT_EQ(pieces, sha256_hex("abc"));
}

}  // namespace
}  // namespace nearmiss

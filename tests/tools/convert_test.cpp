// nearmiss convert writes what it read, bit for bit, with exact truths.
#include <regex>

#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using testing::CommandLine;
using ::testing::HasSubstr;

class Convert : public CommandLine {
 protected:
  /// The queries and truths that a folder or file holds, in plain form.
  [[nodiscard]] std::string plain(const std::string& path) const {
    std::filesystem::remove_all(file("again"));
    expect_code(0, "convert " + path + " -o again");
    std::string all;
    for (const char* kind : {"vt", "ee", "vv", "ve"}) all += read(std::string("again/queries.") + kind);
    // Rational numbers have no -0, which is the same place as 0.
    return std::regex_replace(all, std::regex("-0x0p"), "0x0p");
  }
};

TEST_F(Convert, EveryFormatIsReadBackExactly) {
  for (const char* kind : {"vt", "ee"})
    write(std::string("q.") + kind,
          run(std::string("family decimals --count 50 --kind ") + kind).out +
              run(std::string("family near-underflow --count 50 --kind ") + kind).out);
  std::filesystem::create_directory(file("q"));
  for (const char* name : {"q.vt", "q.ee"}) std::filesystem::rename(file(name), file("q") / name);
  const std::string all = plain("q");
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 2 * 200);
  for (const char* format : {"csv", "json", "case", "plain"}) {
    const std::string to = std::string("as-") + format;
    expect_code(0, "convert q -o " + to + " --as " + format);
    EXPECT_EQ(plain(to), all) << format;
  }
  // The truths are recorded, and the oracle confirms them.
  EXPECT_EQ(run("replay as-csv as-json as-case as-plain --subject exact").code, 0);
  EXPECT_EQ(read("as-csv/vertex-face/queries.csv")
                .substr(0, read("as-csv/vertex-face/queries.csv").find('\n'))
                .find(' '),
            std::string::npos);
}

TEST_F(Convert, OtherKindsAndSeparationsAreInPlainFilesAndCases) {
  write("w.ve", "0 0 0  0 0 1  0 0 2   0 0 1  0 0 1  0 0 2   0.5\n");
  expect_code(0, "convert w.ve -o plain");
  EXPECT_THAT(read("plain/queries.ve"), HasSubstr("# expect=1\n"));
  EXPECT_EQ(plain("plain"), read("plain/queries.ve"));
  expect_code(0, "convert w.ve -o cases --as case");
  EXPECT_EQ(plain("cases"), read("plain/queries.ve"));
  expect_refused("convert w.ve -o new --as csv", {"w.ve:1", "ve query with a separation", "vt or ee"});
}

TEST_F(Convert, ADistanceOfExactlyTheSeparationIsACollision) {
  write("tie.vt", "0.25 0.25 1 0 0 0 1 0 0 0 1 0 0.25 0.25 0.25 0 0 0 1 0 0 0 1 0 0.25\n");
  expect_code(0, "convert tie.vt -o plain");
  EXPECT_THAT(read("plain/queries.vt"), HasSubstr("# expect=1\n"));
}

TEST_F(Convert, ThereMayBeMoreCasesThanOpenFiles) {
  std::string all;
  for (int i = 0; i < 1500; ++i) all += hit;
  write("q.vt", all);
  expect_code(0, "convert q.vt -o cases --as case", "ulimit -n 100;");
  EXPECT_THAT(read("cases/000001.case"), HasSubstr("truth 1\n"));
  EXPECT_EQ(plain("cases"), plain("q.vt"));
}

TEST_F(Convert, NothingIsOverwritten) {
  write("q.vt", hit);
  expect_code(0, "convert q.vt -o plain");
  expect_refused("convert q.vt -o plain", {"plain/queries.vt", "exists already"});
  expect_code(0, "convert q.vt -o cases --as case");
  expect_refused("convert q.vt -o cases --as case", {"cases/000001.case", "exists already"});
}

}  // namespace
}  // namespace nearmiss

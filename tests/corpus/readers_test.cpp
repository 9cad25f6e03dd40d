// A file of each format is read back exactly as it was written, and each error in a file gives a message of
// one line.
#include "corpus/readers.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <sstream>
#include <vector>

#include "ccd/query/error.hpp"
#include "corpus/file.hpp"
#include "corpus/line_reader.hpp"
#include "corpus/query_text.hpp"
#include "tests/queries.hpp"
#include "tests/refused.hpp"
#include "tests/temporary_folder.hpp"

namespace nearmiss {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class Files : public testing::TemporaryFolder {};

std::vector<Case> read_all(const fs::path& path) {
  std::vector<Case> cases;
  read_cases(path, [&](Case&& each) { cases.push_back(std::move(each)); });
  return cases;
}

void expect_error(const fs::path& path, const std::string& message) {
  EXPECT_REFUSED(read_all(path), message);
}

TEST(Numbers, AreReadExactly) {
  EXPECT_EQ(parse_number("0.1", ""), 0.1);
  EXPECT_EQ(parse_number("-0x1.8p-3", ""), -0.1875);
  EXPECT_EQ(parse_number("0X1.8P-3", ""), 0.1875);
  EXPECT_EQ(parse_number("+1e3", ""), 1000);
  EXPECT_EQ(parse_number("4.9406564584124654e-324", ""), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(parse_number("1e-400", ""), 0);
  EXPECT_EQ(parse_number(".5", ""), 0.5);
}

TEST(Numbers, OtherThanFiniteOnesAreRefused) {
  for (const char* text :
       {"nan", "inf", "-inf", "1e400", "0x1p1024", "1.0x", "", "-", "0x", "--1", "1,5", "abc", "1e"})
    EXPECT_THROW((void)parse_number(text, "here"), Error) << text;
}

TEST(QueryLine, RoundTripsExtremes) {
  Query query{.kind = Kind::edge_edge};
  const std::array values{0.1, -0.0, 1e308, std::numeric_limits<double>::denorm_min(), -1.0 / 3, 5e-310};
  for (std::size_t i = 0; i < 24; ++i) query.x[i] = values[i % values.size()];
  const Query back = parse_line(Kind::edge_edge, to_line(query), "here");
  EXPECT_EQ(to_line(back), to_line(query));
  EXPECT_EQ(back, query);
}

TEST(QueryLine, HasSixNumbersForEachVertex) {
  std::array<double, 18> numbers{};
  std::iota(numbers.begin(), numbers.end(), 1);
  for (const Kind kind : {Kind::vertex_vertex, Kind::vertex_edge}) {
    const Query query = query_of(kind, numbers.data());
    for (const Query& each : {query, with_separation(query, 0.5)})
      for (const std::string& line : {to_line(each), to_readable(each)})
        EXPECT_EQ(parse_line(kind, line, "here"), each) << line;
  }
  EXPECT_EQ(to_readable(query_of(Kind::vertex_vertex, numbers.data())), "1 2 3  4 5 6   7 8 9  10 11 12");
  EXPECT_ERROR(parse_line(Kind::vertex_vertex, "1 2 3", "here"),
               "here: found 3 numbers, expected 12, or 13 with a separation");
  EXPECT_ERROR(parse_line(Kind::vertex_edge, to_line(Query{}), "here"),
               "here: found 24 numbers, expected 18, or 19 with a separation");
}

TEST(QueryLine, HasItsSeparationLast) {
  const Query query = testing::falling_vertex(0.5, 0.25, 1, -1);
  EXPECT_EQ(parse_line(query.kind, to_line(query) + " 0", "here"), query);
  EXPECT_FALSE(std::signbit(parse_line(query.kind, to_line(query) + " -0", "here").separation));
  const Query apart = with_separation(query, 0.375);
  EXPECT_EQ(to_line(apart), to_line(query) + " 0x1.8p-2");
  for (const std::string& line : {to_line(apart), to_readable(apart)})
    EXPECT_EQ(parse_line(query.kind, line, "here"), apart) << line;
  EXPECT_ERROR(parse_line(query.kind, to_line(query) + " -0.5", "here"),
               "here: found the separation -0.5, expected a number that is not negative");
  EXPECT_ERROR(parse_line(query.kind, to_line(query) + " 1 2", "here"),
               "here: found 26 numbers, expected 24, or 25 with a separation");
}

Case case_from(const std::string& text) {
  std::istringstream in(text);
  return parse_case(in, "x.case");
}

TEST(CaseFile, RoundTrips) {
  Case each;
  each.query = testing::falling_vertex(0.1, 0.25, 1, -1);
  each.truth = true;
  each.why = "first line\nsecond line";
  each.provenance = "planted:1:42";
  const Case back = case_from(to_text(each));
  EXPECT_EQ(back.query, each.query);
  EXPECT_EQ(back.truth, each.truth);
  EXPECT_EQ(back.why, each.why);
  EXPECT_EQ(back.provenance, each.provenance);
  EXPECT_EQ(back.name, "x.case");
}

TEST(CaseFile, HasThePointsOfItsKind) {
  std::array<double, 18> numbers{};
  std::iota(numbers.begin(), numbers.end(), 1);
  for (const Kind kind : {Kind::vertex_vertex, Kind::vertex_edge}) {
    Case each;
    each.query = query_of(kind, numbers.data());
    EXPECT_EQ(case_from(to_text(each)).query, each.query);
  }
  const std::string vv = "kind vv\nx0 0 0 0\nx1 0 0 0\ny0 0 0 0\n";
  EXPECT_REFUSED(case_from(vv), "x.case:4: found no y1, expected 4 points");
  EXPECT_REFUSED(case_from(vv + "y1 0 0 0\nx2 0 0 0\n"),
                 "x.case:6: found x2, expected only the points of kind vv");
}

/// Writes a case as text, puts `before` and `behind` around each line, and reads the case back.
Case read_with(const Case& each, const std::string& before, const std::string& behind) {
  std::istringstream lines(to_text(each));
  std::string text;
  for (std::string line; std::getline(lines, line);) text += before + line + behind;
  return case_from(text);
}

TEST(CaseFile, MayHaveEmptyAndIndentedLines) {
  Case each;
  each.query = testing::falling_edge(0.1, -1);
  EXPECT_EQ(read_with(each, "\n", "\n \n").query, each.query);
  each.why = "first\nsecond";
  const Case back = read_with(each, "  ", "\n");
  EXPECT_EQ(back.why, each.why);
  EXPECT_EQ(back.query, each.query);
}

TEST(CaseFile, KeepsEmptyLinesOfTheReason) {
  for (const char* why : {"\nsecond", "first\n", "first\n\nthird", "\n"}) {
    Case each;
    each.why = why;
    EXPECT_EQ(case_from(to_text(each)).why, why);
  }
}

TEST_F(Files, ReadsTheCaseThatWasWritten) {
  Case each;
  each.query = testing::falling_edge(1, -1);
  write_case(each, file("a.case"));
  EXPECT_EQ(read_all(file("")).at(0).query, each.query);
}

TEST_F(Files, NamesTheLineOfABadCase) {
  const std::string points = "x0 0 0 0\nx1 0 0 0\nx2 0 0 0\nx3 0 0 0\ny0 0 0 0\ny1 0 0 0\ny2 0 0 0\n";
  expect_error(write("a.case", "kind vt\n" + points), "a.case:8: found no y3");
  expect_error(write("b.case", points + "y3 0 0 0\n"), "b.case:8: found no kind");
  expect_error(write("c.case", "kind vt\n" + points + "y3 0 nan 0\n"), "c.case:9: found 'nan'");
  expect_error(write("d.case", "kind vt\n" + points + "y3 0 0\n"), "d.case:9: found 2 numbers, expected 3");
  expect_error(write("e.case", "kind xx\n"), "e.case:1: found kind 'xx', expected vt, ee, vv or ve");
  expect_error(write("f.case", "kind vt\nx0 0 0 0\nx0 0 0 0\n"), "f.case:3: found a second x0");
  for (const char* line : {"kind vt\n", "truth 1\n", "separation 0\n"})
    expect_error(write("twice.case", std::string(line) + line), "twice.case:2: found a second");
  expect_error(write("g.case", "colour red\n"), "g.case:1: found 'colour'");
  expect_error(write("h.case", "truth 2\n"), "h.case:1: found truth '2'");
}

TEST_F(Files, QueryFilesHaveCommentsAndWindowsLineEnds) {
  const std::string line = to_line(testing::falling_edge(1, -1));
  const auto cases = read_all(write("a.ee", "# comment\r\n\r\n" + line + "  # mine\r\n" + line + "\n"));
  ASSERT_EQ(cases.size(), 2U);
  EXPECT_EQ(cases[0].query, testing::falling_edge(1, -1));
  EXPECT_THAT(cases[1].name, HasSubstr("a.ee:4"));
}

TEST_F(Files, AByteOrderMarkIsSkipped) {
  const std::string mark = "\xef\xbb\xbf";
  Case each;
  each.query = testing::falling_edge(1, -1);
  const std::string line = to_line(each.query);
  EXPECT_EQ(read_all(write("a.ee", mark + line + "\n")).at(0).query, each.query);
  EXPECT_EQ(read_all(write("b.ee", mark + "# comment\n" + line + "\n")).at(0).name, file("b.ee:2").string());
  EXPECT_EQ(read_all(write("a.case", mark + to_text(each))).at(0).query, each.query);
  each.why = "a reason";
  EXPECT_EQ(read_all(write("b.case", mark + to_text(each))).at(0).why, "a reason");
  std::string rows;
  for (int i = 0; i < 8; ++i) rows += "1,2,1,2,1,2,0\n";
  EXPECT_EQ(read_all(write("edge-edge/a.csv", mark + rows)).at(0).query.x[0], 0.5);
  expect_error(write("c.ee", mark + "x\n"), "c.ee:1: found 'x'");
  expect_error(write("d.ee", line + "\n" + mark + line + "\n"), "d.ee:2: found '" + mark);
  expect_error(write("e.ee", mark), "e.ee:1: found no query");
}

TEST_F(Files, ACommentOfAQueryFileMayRecordTheTruth) {
  const std::string query = "0 0 0 1 0 0  0 0 0 1 0 0\n";
  std::vector<std::optional<bool>> truths;
  for (const Case& each :
       read_all(write("a.vv", "# expect=1 toi=0.5 source: a suite\n" + query + query + "#expect=0\n" + query +
                                  "# expect=1\n# expect=-\n" + query + "# expected=7\n" + query +
                                  "# expect=0\n\n" + query)))
    truths.push_back(each.truth);
  EXPECT_EQ(truths,
            (std::vector<std::optional<bool>>{true, std::nullopt, false, std::nullopt, std::nullopt, false}));
  expect_error(write("b.vv", "# expect=yes\n" + query),
               "b.vv:1: found 'expect=yes', expected expect=0, expect=1 or expect=-");
}

TEST_F(Files, SampleQueriesAreRationalNumbers) {
  std::string rows;
  for (int i = 0; i < 8; ++i) rows += std::to_string(2 * i) + ",16, -3,\t4,5,1, 1\r\n \r\n";
  const auto cases = read_all(write("vertex-face/data.csv", rows));
  ASSERT_EQ(cases.size(), 1U);
  EXPECT_EQ(cases[0].query.kind, Kind::vertex_triangle);
  EXPECT_EQ(cases[0].truth, true);
  EXPECT_THAT(cases[0].name, HasSubstr("data.csv:1"));
  EXPECT_EQ(cases[0].query.end(3), Vector3<double>(0.875, -0.75, 5));
}

TEST_F(Files, TruthsOfSampleQueriesMayStandInAFileOfTheirOwn) {
  std::string rows = "# a query\n";
  for (int i = 0; i < 16; ++i) rows += "1,2,1,4,0,1\n";
  const auto csv = write("cloth/queries/92ee.csv", rows);
  EXPECT_EQ(read_all(csv).at(1).truth, std::nullopt);
  const auto truths = [&](const std::string& text) {
    return write("cloth/mma_bool/92ee_mma_bool.json", text);
  };
  truths("\xEF\xBB\xBF[ true,\n false ]\n");
  std::filesystem::create_directory_symlink(csv.parent_path(), csv.parent_path().parent_path() / "linked");
  EXPECT_EQ(read_all(csv.parent_path().parent_path() / "linked" / csv.filename()).at(0).truth, true);
  const auto cases = read_all(csv);
  ASSERT_EQ(cases.size(), 2U);
  EXPECT_EQ(cases[0].query.kind, Kind::edge_edge);
  EXPECT_EQ(cases[0].truth, true);
  EXPECT_EQ(cases[1].truth, false);
  truths("[true]");
  expect_error(csv, "92ee_mma_bool.json: found 1 truths, but more queries, expected one for each");
  truths("[true, false, true]");
  expect_error(csv, "92ee_mma_bool.json: found 3 truths, but fewer queries, expected one for each");
  for (const char* bad : {"", "[true, 1]", "[true, false] x", "[true false]", "[true,", "[,true]"}) {
    truths(bad);
    expect_error(csv, "expected an array of true and false in JSON");
  }
}

TEST_F(Files, NamesTheLineOfABadSampleQuery) {
  const std::string row = "1,2,1,2,1,2,0\n";
  std::string seven;
  for (int i = 0; i < 7; ++i) seven += row;
  expect_error(write("edge-edge/a.csv", seven), "a.csv:7: found 7 rows");
  expect_error(write("edge-edge/b.csv", seven + "1,2,1,2,1,2,1\n"), "b.csv:8: found a truth that differs");
  expect_error(write("edge-edge/c.csv", "1,3,1,2,1,2,0\n"),
               "c.csv:1: found 1/3, expected a number that is a double");
  expect_error(write("edge-edge/d.csv", "1,0,1,2,1,2,0\n"), "d.csv:1: found '1,0'");
  expect_error(write("edge-edge/e.csv", "1,2\n"), "e.csv:1: found 2 columns");
  expect_error(write("edge-edge/g.csv", "x\n"), "g.csv:1: found 1 columns");
  expect_error(write("elsewhere/f.csv", seven + row), "expected vertex-face or edge-edge");
}

TEST_F(Files, RefusesUnreadableFilesAndFolders) {
  expect_error(write("empty.vt", ""), "empty file");
  expect_error(write("comments.vt", "# nothing\n"), "found no query");
  expect_error(write("mesh.obj", "v 0 0 0\n"), "unknown kind of file");
  expect_error(file("missing.case"), "cannot be read");
  fs::create_directories(file("sub"));
  expect_error(file("sub"), "found no case");
}

TEST_F(Files, ReadsAFolderInOrderAndIgnoresOtherFiles) {
  const std::string line = to_line(Query{}) + "\n";
  write("b/second.ee", line);
  write("a/first.vt", line);
  write("a/README.md", "text");
  fs::create_directories(file("c.vt"));
  const auto cases = read_all(file(""));
  ASSERT_EQ(cases.size(), 2U);
  EXPECT_THAT(cases[0].name, HasSubstr("first.vt:1"));
  EXPECT_THAT(cases[1].name, HasSubstr("second.ee:1"));
}

TEST_F(Files, MayHaveLongLinesButNotEndlessOnes) {
  const std::string longest(most_line_bytes, ' ');
  const std::string query = to_line(testing::falling_vertex(0.5, 0.25, 1, -1));
  EXPECT_EQ(read_all(write("a.vt", query + '\n' + longest + '\n' + query)).size(), 2);
  for (const std::string name : {"a.vt", "a.case", "edge-edge/a.csv"})
    expect_error(write(name, '\n' + longest + ' '),
                 name + ":2: found a line of more than 1048576 bytes, expected a shorter one");
}

class Open {
 public:
  explicit Open(const fs::path& path) : number(open(path.c_str(), O_RDWR | O_CLOEXEC)) {}
  Open(const Open&) = delete;
  Open& operator=(const Open&) = delete;
  ~Open() { close(number); }
  const int number;
};

TEST_F(Files, AnOpenFileIsWrittenAndNotReplaced) {
  const Open open_file(write("a", "before"));
  replace_file(fs::path("/proc/self/fd") / std::to_string(open_file.number), "after!");
  std::array<char, 6> text{};
  ASSERT_EQ(pread(open_file.number, text.data(), text.size(), 0), 6);
  EXPECT_EQ(std::string(text.begin(), text.end()), "after!");
}

TEST_F(Files, PartsAreRemovedIfASignalEndsTheProgram) {
  write("mine.part", "mine");
  PartFile placed(file("placed"));
  placed.put_in_place();
  std::optional<PartFile> given_up(file("given up"));
  given_up.reset();
  write("given up.part", "mine, too");
  const PartFile first(file("mine"));
  const PartFile second(file("second"));
  remove_part_files();
  EXPECT_FALSE(fs::exists(first.path()));
  EXPECT_FALSE(fs::exists(second.path()));
  for (const char* kept : {"mine.part", "placed", "given up.part"})
    EXPECT_TRUE(fs::exists(file(kept))) << kept;
}

TEST_F(Files, AreReplacedWithoutAStandardInput) {
  const int input = dup(STDIN_FILENO);
  close(STDIN_FILENO);
  EXPECT_NO_THROW(replace_file(file("a"), "text"));
  dup2(input, STDIN_FILENO);
  close(input);
  EXPECT_EQ(read("a"), "text");
}

}  // namespace
}  // namespace nearmiss

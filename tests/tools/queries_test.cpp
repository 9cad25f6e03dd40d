// Tests commands that answer, print, time or convert queries: queries of families, queries with separations,
// and queries of the kinds vv and ve.
#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;
using testing::CommandLine;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;

TEST_F(CommandLine, VerdictPrintsTheDistanceBoundAndWhoseItIs) {
  write("q.vt", hit + miss);
  const std::string wangs = run("verdict --kind vt --subject wang --distance-bound q.vt").out;
  EXPECT_THAT(wangs, MatchesRegex("1 proximity 0x1p-1 0x[^ ]* claimed\n0 0x[^ ]* claimed\n"));
  // basic claims no distance bound, so nearmiss prints wang's distance bound for each query.
  std::string expected = wangs;
  for (auto at = expected.find("claimed"); at != std::string::npos; at = expected.find("claimed"))
    expected.replace(at, 7, "wang");
  EXPECT_EQ(run("verdict --kind vt --subject basic --distance-bound q.vt").out, expected);
}

TEST_F(CommandLine, VerdictPrintsTheQueryAsTheSubjectRoundsIt) {
  const std::string fine = "0x1.0000001p+0 0x1p+0 0x1p+1";
  const std::string triangle = " 0x0p+0 0x0p+0 0x0p+0 0x1p+0 0x0p+0 0x0p+0 0x0p+0 0x1p+0 0x0p+0";
  const std::string end = " 0x1p+0 0x1p+0 0x1p+0" + triangle + "\n";
  write("q.vt", fine + triangle + end);
  EXPECT_EQ(run("verdict --kind vt --subject wang --rounded q.vt").out, "0 " + fine + triangle + end);
  EXPECT_EQ(run("verdict --kind vt --subject wang:float --rounded q.vt").out,
            "0 0x1p+0 0x1p+0 0x1p+1" + triangle + end);
}

TEST_F(CommandLine, FamilyPrintsTheQueriesOfACampaign) {
  const auto lines = [&](const std::string& options) {
    return expect_code(0, "family parallel --seed 5 " + options).out;
  };
  for (const std::string kind : {"--kind vt ", "--kind ee "})
    EXPECT_EQ(lines(kind + "--count 8"), lines(kind + "--count 4") + lines(kind + "--first 8 --count 4"));
  // nearmiss family prints the queries that a campaign asks, so a replay of them gives the campaign's counts.
  write("q.ee", lines("--kind ee --count 500"));
  const json campaign = json_of(0, "fuzz --family parallel --seed 5 --cases 1000")["subjects"]["wang"]["ee"];
  const json replay = json_of(0, "replay q.ee")["subjects"]["wang"]["ee"];
  for (const char* each : {"queries", "collisions", "positives", "false_positives"})
    EXPECT_EQ(replay[each], campaign[each]) << each;
  ASSERT_FALSE(campaign["farthest"].empty());
  EXPECT_EQ(replay["farthest"][0]["query"], campaign["farthest"][0]["query"]);
}

TEST_F(CommandLine, FamilyRefusesUnknownNames) {
  expect_refused("family uniforms --kind vt --count 1", {"unknown family 'uniforms'", "uniform-end"});
  expect_refused("family all --kind vt --count 1", {"unknown family 'all'"});
  expect_refused("family needle@5 --kind vt --count 1", {"'needle@5'", "from -16 to 0"});
  expect_refused("family uniform --count 1", {"--kind is required"});
  expect_refused("family uniform --kind vf --count 1", {"--kind", "vf"});
  expect_refused("family uniform --kind vt", {"--count is required"});
  expect_refused("family uniform --kind vt --count 0", {"--count"});
  expect_refused("family uniform --kind vt --count 1 --first=-1", {"--first"});
  expect_refused("family uniform --kind vt --count 1 --seed x", {"--seed"});
  expect_refused("family --kind vt --count 1", {"NAME is required"});
}

TEST_F(CommandLine, FamilyRefusesFactorsOfOtherFamilies) {
  for (const char* option : {"--coverage", "--missed-by wang", "--kind vt --factors"})
    expect_refused(std::string("family uniform --count 1 ") + option, {"'uniform'", "crossed"});
  expect_refused("family crossed --count 1 --coverage --kind vt", {"--coverage", "--kind"});
  expect_refused("family crossed --count 1 --factors", {"--factors", "--kind"});
}

TEST_F(CommandLine, FamilyShowsTheFactorsOfCrossedQueries) {
  EXPECT_THAT(run("family crossed --kind ee --factors --count 1").out,
              MatchesRegex("shape=[a-z-]+ motion=[a-z]+ when=[a-z0-9-]+ .*offset=[a-z]+\n"));
  const std::string coverage = run("family crossed --coverage --count 1").out;
  EXPECT_THAT(coverage, ::testing::HasSubstr("not made: motion=rest when=at-1\n"));
  EXPECT_THAT(coverage, ::testing::HasSubstr("pairs: 21 of the 604 that are made occur in 1 query\n"));
  EXPECT_THAT(coverage, ::testing::HasSubstr("triples: 35 of the 4,885 that are made occur in 1 query\n"));
  const std::string missed = run("family crossed --missed-by basic --count 4000").out;
  EXPECT_THAT(missed, ::testing::HasSubstr("basic vt: "));
  EXPECT_THAT(missed, ::testing::HasSubstr(" % of the missed ones have "));
  EXPECT_THAT(run("family crossed --missed-by exact --count 100").out,
              ::testing::HasSubstr("exact vt: 0 of "));
}

// The output has at most twelve lines. Apart from the paths of plug-ins, no line has more than 100 columns.
TEST_F(CommandLine, AReplayOfOneCaseSaysWhatMatters) {
  std::string crowd = "wang,basic,exact,wang-scalar,wang-eps,wang-no-planes,wang-plain,basic-plain,bridson";
  write("long.vt",
        "0.1234567890123456 -0.1234567890123456 0x1.123456789abcdp-900 0 0 0 1 0 0 0 1 0 "
        "0.1234567890123456 -0.1234567890123456 -0x1.123456789abcdp-900 0 0 0 1 0 0 0 1 0");
  struct Shown {
    std::string arguments;
    std::vector<std::string> words;
  };
  for (const auto& [arguments, words] : std::vector<Shown>{
           {"hit.vt --subject basic,wang",
            {" ok  basic: reports the collision at t*\n ok  wang: reports the collision\n",
             "\nexact: first contact at t* = 0.5; ordinary vt query\n       contact inside the step; ",
             "\n  x0 (0.25, 0.25, 1) -> (0.25, 0.25, -1)\n  x1 (0, 0, 0)\n"}},
           {"miss.vt --subject wang",
            {": reports no collision\nexact: no contact; the smallest distance is 1;"}},
           {"hit.vt --separation 0.5 --subject exact", {"exact: first within 0.5 at t* = 0.25; ordinary vt"}},
           {NEARMISS_CORPUS "/vertices/ve-resting.case --subject exact",
            {"exact: first within 0.25 at t* = 0;"}},
           {NEARMISS_CORPUS "/roots/vt-barely-twice.case --subject wang",
            {"root parity counts an even number"}},
           {"long.vt", {"\n  x0 ~(0.123457, -0.123457, 1.26"}},
           {"hit.vt --subject " + crowd, {"      and 4 more subjects: -v shows all\nexact: "}},
           {"hit.vt --query-time 2s --subject wang," + plugin("never"),
            {"FAIL always: MISSED the collision\n ok  wang: ",
             "simplify it: nearmiss shrink hit.vt --subject " + plugin("never") +
                 " --query-time 2s\nas a test: ",
             " --as c++\n"}},
           {"hit.vt --subject " + plugin("crash"),
            {": NO ANSWER: crash SEGV\nexact: ", "\nstderr: ?[31mlast words\nstderr: /",
             "\nsimplify it: "}}}) {
    const std::string text = run("replay " + arguments, "NEARMISS_ONE_IN=1").out;
    for (const std::string& each : words) EXPECT_THAT(text, HasSubstr(each)) << arguments;
    EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 12) << text;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
      if (line.find(NEARMISS_PLUGINS) == line.npos) {
        EXPECT_LE(line.size(), 100) << line;
      }
    EXPECT_THAT(run("replay -v " + arguments, "NEARMISS_ONE_IN=1").out, HasSubstr("ns/query")) << arguments;
  }
}

class SeparationOption : public testing::CommandLine {
 protected:
  /// The vertex of `hit` comes within 1/2 of the triangle at t = 1/4; the vertex of `miss` never does.
  void SetUp() override { write("q.vt", hit + miss); }

  /// A query with its separation as the 25th number.
  static std::string with(const std::string& query, const std::string& separation) {
    return query.substr(0, query.size() - 1) + " " + separation + "\n";
  }

  /// A subject that reports every pair as a collision, with t = 1/2 as a lower bound of the time.
  const std::string promises = " --subject " + plugin("promises");
};

TEST_F(SeparationOption, OracleSaysWhenTheDistanceFallsToIt) {
  const std::string expected = "1 0x1p-2 0x1p-2\n0 inf inf\n";
  EXPECT_EQ(run("oracle --kind vt --toi --separation 0.5 q.vt").out, expected);
  EXPECT_EQ(run("oracle --kind vt --toi --separation 0x1p-1 --method all q.vt").out, expected);
  EXPECT_EQ(run("oracle --kind vt --rational --separation 0.5 q.vt").out,
            "1 0x1p-2 0x1p-2 1/4\n0 inf inf -\n");
  write("own.vt", with(hit, "0.5") + with(miss, "0.5"));
  EXPECT_EQ(run("oracle --kind vt --toi own.vt").out, expected);
  EXPECT_EQ(run("oracle --kind vt --toi --separation 0 own.vt").out, run("oracle --kind vt --toi q.vt").out);
}

TEST_F(SeparationOption, OracleSaysYesToADistanceOfExactlyIt) {
  // In miss.vt, the distance falls to exactly 1.
  for (const std::string method : {"filtered", "exact", "certificate", "all"})
    EXPECT_EQ(run("oracle --kind vt --toi --separation 1 miss.vt --method " + method).out,
              "1 0x1p+0 0x1p+0\n")
        << method;
  EXPECT_EQ(run("oracle --kind vt --separation 0x1.fffffffffffffp-1 miss.vt").out, "0\n");
}

TEST_F(SeparationOption, VerdictPrintsTheTime) {
  EXPECT_THAT(run("verdict --kind vt --subject exact --separation 0.5 q.vt").out,
              MatchesRegex("1 [a-z]+ 0x1p-2\n0\n"));
  EXPECT_EQ(run("verdict --kind vt --separation 0.5 q.vt" + promises).out,
            "1 unspecified 0x1p-1\n1 unspecified 0x1p-1\n");
}

TEST_F(SeparationOption, IsRefusedIfItIsNoDistanceOrIfASubjectTakesNone) {
  for (const std::string command :
       {"oracle --kind vt q.vt", "verdict --kind vt --subject exact q.vt", "bench q.vt --subject exact",
        "replay q.vt", "shrink hit.vt --subject exact", "fuzz --cases 10 --subject exact"})
    for (const char* other : {"-1", "nan", "inf", "x", "0.5,1"})
      expect_refused(command + " --separation=" + other, {"--separation", other});
  for (const std::string command : {"verdict --kind vt q.vt", "bench q.vt --json new.json", "shrink hit.vt",
                                    "fuzz --cases 10 --kind vt --db new.db", "replay q.vt --db new.db"})
    expect_refused(command + " --subject wang --separation 0.5", {"wang: answers for contact only"});
  write("own.vt", hit + with(hit, "0.5"));
  expect_refused("bench own.vt --subject exact,wang", {"wang: answers for contact only"});
  expect_refused("verdict --kind vt --subject wang own.vt", {"wang: answers for contact only"});
}

TEST_F(SeparationOption, ReplaySaysWhoIsNotAsked) {
  write("own.vt", hit + with(hit, "0.5"));
  EXPECT_THAT(
      run("replay own.vt --subject exact,wang").out,
      HasSubstr("wang: not asked about 1 case with a separation, because it answers for contact only\n"));
  EXPECT_THAT(run("replay own.vt --subject exact").out, Not(HasSubstr("not asked")));
  EXPECT_THAT(run("replay own.vt --separation 0 --subject wang").out, Not(HasSubstr("not asked")));
}

TEST_F(SeparationOption, BenchTimesQueriesWithIt) {
  const std::string bench = "bench q.vt --subject exact --queries 5 --runs 1";
  const json results = json_of(0, bench + " --separation 1.5")["results"];
  ASSERT_EQ(results.size(), 7);
  EXPECT_EQ(results[0]["input"], "q.vt~1.5");
  EXPECT_EQ(results[0]["queries"], 2);  // in each query, the two boxes are at most 1.5 apart
  EXPECT_EQ(results[1]["input"], "uniform~1.5");
  const json of_contact = json_of(0, bench)["results"][0];
  EXPECT_EQ(of_contact["input"], "q.vt");
  EXPECT_EQ(of_contact["queries"], 1);
}

TEST_F(SeparationOption, ZeroAsksForContact) {
  const auto collisions = [&](const std::string& option) {
    const std::string fuzz = "fuzz --subject wang --family uniform --cases 100 ";
    return json_of(0, fuzz + option)["subjects"]["wang"]["vt"]["collisions"];
  };
  for (const std::string zero : {"0", "0x0p+0"}) {
    EXPECT_EQ(collisions("--separation " + zero), collisions(""));
    expect_code(0, "bench --subject wang --family uniform --queries 5 --runs 1 --separation " + zero);
  }
}

TEST_F(SeparationOption, ShrinkKeepsALateTime) {
  expect_code(2, "shrink hit.vt" + promises);  // contact is at t = 1/2, so the subject's time is not late
  expect_code(0, "shrink hit.vt -o late.case --separation 0.5" + promises);
  EXPECT_THAT(read("late.case"), HasSubstr("# late of always: vt "));
  const json counts = json_of(1, "replay late.case --no-shrink" + promises)["subjects"]["always"]["vt"];
  EXPECT_THAT(read("error.txt"), HasSubstr("FAIL always: LATE, by 0.386 of the step\n"));
  EXPECT_EQ(counts["late"], 1);
  EXPECT_EQ(counts["times_promised"], 1);
  EXPECT_EQ(counts["time_sort"], "lower-bound");
}

TEST_F(SeparationOption, AReportSaysThatOfEachRun) {
  for (const std::string each : {"0.25", "drawn"})
    expect_code(0, "fuzz --family uniform --cases 8 --no-shrink --subject exact --db " + each +
                       ".db --separation " + each);
  const json report = report_of("0.25.db drawn.db");
  std::vector<std::string> separations;
  for (const json& each : report["runs"]) separations.push_back(each["separation"].get<std::string>());
  EXPECT_THAT(separations, ::testing::UnorderedElementsAre("0.25", "drawn"));
  const json& families = report["subjects"]["exact"]["vt"]["families"];
  EXPECT_TRUE(families.contains("uniform~0.25") && families.contains("uniform~drawn"));
}

class Vertices : public testing::CommandLine {
 protected:
  /// Writes two queries in which a vertex moves. In q.ve, the vertex passes the edge from (1, -1, 0) to (1,
  /// 1, 0) at a distance of 1. In q.vv, the vertex passes the first end of this edge at a distance of √2.
  void SetUp() override {
    write("q.ve", "0 0 1  1 -1 0  1 1 0   2 0 1  1 -1 0  1 1 0\n");
    write("q.vv", "0 0 1  1 -1 0   2 0 1  1 -1 0\n");
  }

  const std::string never = " --subject " + plugin("never_vertices");
};

TEST_F(Vertices, AreDecidedProvedAndMeasured) {
  EXPECT_EQ(run("oracle --kind ve --toi --separation 1.25 q.ve").out, "1 0x1p-3 0x1p-3\n");
  EXPECT_EQ(run("oracle --kind ve --separation 0.5 --method all q.ve").out, "0\n");
  EXPECT_EQ(run("oracle --kind vv --separation 1.5 q.vv").out, "1\n");
  EXPECT_EQ(run("oracle --kind vv --separation 1.25 q.vv").out, "0\n");
  const auto line = json::parse(run("certify --kind vv --separation 1.5 q.vv").out);
  EXPECT_EQ(line["kind"], "vv");
  EXPECT_EQ(line["x"].size(), 12);
  EXPECT_EQ(line["weights"], json({"1", "1"}));
}

TEST_F(Vertices, OnlySomeSubjectsDecideThem) {
  EXPECT_EQ(run("verdict --kind ve --separation 1.25 --subject wang q.ve").out.substr(0, 2), "1 ");
  EXPECT_EQ(run("verdict --kind vv --separation 1.25 --subject wang-tight q.vv").out, "0\n");
  expect_refused("verdict --kind ve --subject adaptive q.ve", {"adaptive", "found queries of kind ve"});
  expect_refused("fuzz --family vertices --subject adaptive --cases 100", {"adaptive"});
  expect_refused("family v-uniform --kind vt --count 1", {"found vt, expected vv or ve"});
  expect_refused("oracle --kind ve q.vv", {"q.vv:1: found 12 numbers, expected 18, or 19 with a separation"});
}

TEST_F(Vertices, ACampaignAsksTheKindsThatSubjectsDecide) {
  const auto asked = [&](const std::string& options, int code = 0) {
    const json counts = json_of(code, "fuzz --cases 400 --no-shrink " + options)["subjects"];
    std::map<std::string, std::set<std::string>> kinds_of;
    for (const auto& [subject, by_kind] : counts.items())
      for (const auto& [kind, count] : by_kind.items())
        if (count["queries"] > 0) kinds_of[subject].insert(kind);
    return kinds_of;
  };
  using Kinds = std::map<std::string, std::set<std::string>>;
  EXPECT_EQ(asked("--subject wang"), (Kinds{{"wang", {"vt", "ee", "vv", "ve"}}}));
  EXPECT_EQ(asked("--subject adaptive,exact"), (Kinds{{"adaptive", {"vt", "ee"}}, {"exact", {"vt", "ee"}}}));
  EXPECT_EQ(asked("--subject exact"), (Kinds{{"exact", {"vt", "ee"}}}));
  EXPECT_EQ(asked("--subject wang --kind ve,ee"), (Kinds{{"wang", {"ee", "ve"}}}));
  EXPECT_EQ(asked("--subject exact --separation drawn --kind vt"), (Kinds{{"exact", {"vt"}}}));
  EXPECT_EQ(asked("--subject wang,exact --separation drawn"),
            (Kinds{{"wang", {"vv", "ve"}}, {"exact", {"vv", "ve"}}}));
  // The subject `rows` decides vv only without a separation, and ve only with a separation.
  const std::string rows = "--subject " + plugin("rows") + ",wang-plain";
  EXPECT_EQ(asked(rows, 1)["rows"], std::set<std::string>{"ve"});
  EXPECT_EQ(asked(rows + " --separation 0 --kind vv", 1)["rows"], std::set<std::string>{"vv"});
}

TEST_F(Vertices, ACampaignCanBeRepeatedByItsRecord) {
  const auto of_run = [&](const std::string& options) {
    return json_of(0, "fuzz --cases 40 " + options)["runs"][0];
  };
  const json run_of_exact = of_run("--subject exact --family v-uniform");
  EXPECT_EQ(run_of_exact["kinds"], "vv,ve");
  EXPECT_THAT(run_of_exact["again"].get<std::string>(), HasSubstr("--family v-uniform --kind vv,ve"));
  EXPECT_EQ(of_run("--subject wang --kind ve,vt")["again"], of_run("--subject wang --kind vt,ve")["again"]);
}

TEST_F(Vertices, ACampaignRefusesKindsThatItsFamiliesDoNotHave) {
  expect_refused("fuzz --subject wang --cases 10 --kind vv --family uniform",
                 {"--kind: found vv, expected vt or ee for the family uniform"});
  expect_refused("fuzz --subject wang --cases 10 --kind vt,vt", {"--kind: found vt twice"});
  expect_refused("fuzz --subject wang,advance --cases 10 --kind vt,vv --separation 0.5",
                 {"wang: answers for contact only in queries of kind vt"});
  write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 2 3 4\n");
  expect_refused("fuzz --subject wang --cases 10 --kind vv --mesh a.obj a.obj", {"--kind: found vv", "mesh"});
}

TEST_F(Vertices, ACampaignFindsShrinksAndProvesWhatIsMissed) {
  const Output output =
      expect_code(1, "fuzz --family vertices --cases 100 --db new.db" + never + ",wang,exact");
  EXPECT_THAT(output.out, HasSubstr("always: MISSED"));
  const json report = report_of("new.db", 1);
  for (const char* kind : {"vv", "ve"}) {
    EXPECT_GT(report["subjects"]["always"][kind]["false_negatives"], 0);
    EXPECT_EQ(report["subjects"]["wang"][kind]["false_negatives"], 0);
  }
  ASSERT_FALSE(report["findings"].empty());
  for (const json& finding : report["findings"]) {
    const std::size_t coordinates = finding["kind"] == "vv" ? 12 : 18;
    EXPECT_EQ(finding["shrunk"].size(), coordinates + 1);
    EXPECT_EQ(json::parse(finding["certificate"].get<std::string>())["x"].size(), coordinates);
  }
  expect_code(1, "replay report/cases --quiet --no-shrink" + never);
}

TEST_F(Vertices, BecomeTests) {
  const std::string test = run("shrink q.ve --separation 1.25 --as c++" + never).out;
  EXPECT_THAT(test, HasSubstr("// A vertex (the first point) and an edge (the other two)"));
  EXPECT_THAT(test, HasSubstr("bool test_vertex_edge() {\n  const double start[3][3] = {\n"));
  EXPECT_THAT(run("shrink q.vv --separation 1.5 --as python" + never).out,
              HasSubstr("def test_vertex_vertex():"));
}

class Convert : public CommandLine {
 protected:
  /// The queries and truths of the cases in a folder or file, as lines of the format "plain".
  [[nodiscard]] std::string plain(const std::string& path) const {
    std::filesystem::remove_all(file("again"));
    expect_code(0, "convert " + path + " -o again");
    std::string all;
    for (const char* kind : {"vt", "ee", "vv", "ve"}) all += read(std::string("again/queries.") + kind);
    // The rational numbers of a CSV file cannot express -0. The replacement changes no query, because a
    // coordinate -0 means the same as 0.
    return std::regex_replace(all, std::regex("-0x0p"), "0x0p");
  }
};

TEST_F(Convert, EveryFormatIsReadBackExactly) {
  for (const std::string kind : {"vt", "ee"})
    write("q/q." + kind, run("family decimals --count 20 --kind " + kind).out +
                             run("family near-underflow --count 20 --kind " + kind).out);
  const std::string all = plain("q");
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 2 * 80);
  for (const std::string format : {"csv", "json", "case", "plain"}) {
    expect_code(0, "convert q -o as-" + format + " --as " + format);
    EXPECT_EQ(plain("as-" + format), all) << format;
  }
  expect_code(0, "replay as-csv as-json as-case as-plain --subject exact");
  EXPECT_THAT(read("as-csv/vertex-face/queries.csv"), ::testing::MatchesRegex("[^ \n]*\n.*"));
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

TEST_F(Convert, ThereMayBeMoreCasesThanOpenFiles) {
  std::string all;
  for (int i = 0; i < 300; ++i) all += hit;
  write("q.vt", all);
  expect_code(0, "convert q.vt -o cases --as case", "ulimit -n 100;");
  EXPECT_THAT(read("cases/000001.case"), HasSubstr("truth 1\n"));
  EXPECT_EQ(plain("cases"), plain("q.vt"));
}

TEST_F(Convert, NothingIsOverwritten) {
  for (const auto& [format, name] : {std::pair{"plain", "queries.vt"}, std::pair{"case", "000001.case"}}) {
    const std::string convert = std::string("convert hit.vt -o to --as ") + format;
    expect_code(0, convert);
    expect_refused(convert, {std::string("to/") + name, "exists already"});
  }
}

}  // namespace
}  // namespace nearmiss

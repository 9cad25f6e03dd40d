// The command line with queries of two vertices, and of a vertex and an edge.
#include <map>
#include <set>

#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class Vertices : public testing::CommandLine {
 protected:
  /// A vertex that passes the edge from (1, -1, 0) to (1, 1, 0), and its first end, at a distance of 1 and of
  /// √2.
  void SetUp() override {
    write("q.ve", "0 0 1  1 -1 0  1 1 0   2 0 1  1 -1 0  1 1 0\n");
    write("q.vv", "0 0 1  1 -1 0   2 0 1  1 -1 0\n");
  }

  /// A subject that finds nothing.
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
  const auto asked = [&](const std::string& options) {
    const json counts =
        json::parse(expect_code(0, "fuzz --cases 400 --json - --no-shrink " + options).out)["subjects"];
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
  // It decides vv without a separation, and ve with one.
  const std::string rows = "--subject " + plugin("rows") + ",wang-plain";
  const auto of_rows = [&](const std::string& options) {
    return json::parse(
        run("fuzz --cases 400 --json - --no-shrink " + rows + options).out)["subjects"]["rows"];
  };
  EXPECT_EQ(of_rows("").size(), 1);
  EXPECT_GT(of_rows("")["ve"]["queries"], 0);
  EXPECT_GT(of_rows(" --separation 0 --kind vv")["vv"]["queries"], 0);
}

TEST_F(Vertices, ACampaignCanBeRepeatedByItsRecord) {
  const auto of_run = [&](const std::string& options) {
    return json::parse(run("fuzz --cases 40 --json - " + options).out)["runs"][0];
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
      expect_code(1, "fuzz --family vertices --cases 500 --db new.db --jobs 1" + never + ",wang,exact");
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
  EXPECT_EQ(run("replay report/cases --quiet" + never).code, 1);
}

TEST_F(Vertices, BecomeTests) {
  const std::string test = run("shrink q.ve --separation 1.25 --as c++" + never).out;
  EXPECT_THAT(test, HasSubstr("// A vertex (the first point) and an edge (the other two)"));
  EXPECT_THAT(test, HasSubstr("bool test_vertex_edge() {\n  const double start[3][3] = {\n"));
  EXPECT_THAT(run("shrink q.vv --separation 1.5 --as python" + never).out,
              HasSubstr("def test_vertex_vertex():"));
}

}  // namespace
}  // namespace nearmiss

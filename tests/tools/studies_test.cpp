// Tests studies as a user sees them: the commands tightness, ladder, audit, power and paper. Also tests the
// demo, and the completion of command lines.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using testing::Background;
using testing::CommandLine;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(CommandLine, TightnessGoesIntoTheReport) {
  expect_refused("tightness --tolerance nu", {"'nu'"});
  const json found = json_of(0, "tightness --time 1ms --tolerance D2,vertex-edge --db new.db");
  EXPECT_THAT(read("error.txt"), HasSubstr("D2"));
  EXPECT_LT(found["tightness"]["D2"]["value"], 1);
  EXPECT_GT(report_of("new.db")["tightness"]["vertex-edge"]["queries"], 0);
}

TEST_F(CommandLine, TheLadderIsACampaign) {
  const std::string ladder = "ladder --scalar float,p60 --family uniform --cases 30 --db ladder.db";
  expect_code(0, ladder);
  EXPECT_THAT(run(ladder + " --resume").out, HasSubstr("wang-tight:p60"));
  expect_refused("ladder --scalar p15 --cases 1", {"p16 to p256"});
}

TEST_F(CommandLine, TheAuditNamesConstantsThatAreTooSmall) {
  const Output output = expect_code(0, "audit --json audit.json");
  EXPECT_THAT(output.out, HasSubstr("TOO SMALL"));
  EXPECT_THAT(output.out, HasSubstr("not proven by Theorem 4.1: relative positions of edges are within 2B"));
  EXPECT_THAT(output.out, HasSubstr("33492"));
  expect_code(0, "fuzz --cases 4 --db a.db");
  (void)report_of("a.db --audit audit.json");
  write("other.json", "{\"constants\": []}");
  expect_refused("report a.db -o report --audit other.json", {"expected what nearmiss audit --json keeps"});
}

TEST_F(CommandLine, PowerResumesWhereItStoppedButDoesNotMixSettings) {
  const std::string command = "power --way families,search --json a.json --subject defect:vertex-edge";
  EXPECT_THAT(expect_code(0, command + " --time 1s").out, HasSubstr("found, of 1"));
  expect_code(0, command + ",defect:mu*1 --time 1s");
  const json results = read_json("a.json");
  ASSERT_EQ(results.size(), 4);
  EXPECT_EQ(results[0]["failure"], "false-negative");
  EXPECT_GT(results[0]["cases"], 0);
  EXPECT_EQ(results[2]["subject"], "defect:mu*1");
  EXPECT_TRUE(results[2]["failure"].is_null());
  expect_refused(command + " --time 2s", {"a.json: found hunts with --time 1s --seed 1, expected 2s and 1"});
  expect_refused(command + " --time 1s --seed 2", {"--seed 1"});
}

TEST_F(CommandLine, AnInterruptEndsPowersHuntWithLibFuzzer) {
  write("fuzzer",
        "test $2 = late || { echo nothing in 2 s, 100 executions; exit; }\n"
        "trap '' TERM\ntouch late\nsetsid sleep 30 &\nsleep 100000\n");
  Background power(file(""),
                   "power --time 24h --way libfuzzer --libfuzzer 'sh fuzzer' --json new.json "
                   "--subject defect:vv,defect:later-root");
  ASSERT_TRUE(power.wait_for_a_change(file("late"))) << read("error.txt");
  power.stop(SIGTERM);
  EXPECT_EQ(power.code(), 130) << read("error.txt");
  EXPECT_EQ(read_json("new.json").size(), 1);
}

TEST_F(CommandLine, PowerTakesWhateverItsCommandPrints) {
  std::filesystem::copy(plugin("never"), file("it's.so"));
  const std::string power =
      "power --time 2s --json new.json --subject \"./it's.so\" --way libfuzzer --libfuzzer ";
  write("long", "echo found after $(head -c 1000000 /dev/zero | tr '\\0' 1) s\n");
  EXPECT_THAT(expect_code(2, power + "'sh long'").error, HasSubstr("111...', expected 'found after ...'"));
  write("odd", "printf 'found after 1 s, 2 executions: \\033[31ma\\n'; echo \"$*\" >odd.txt\n");
  expect_code(0, power + "'sh odd'");
  EXPECT_EQ(read_json("new.json")[0]["provenance"], "?[31ma");
  EXPECT_THAT(read("odd.txt"), HasSubstr("s ./it's.so\n"));
  std::filesystem::remove(file("new.json"));
  write("much", "yes | head -c 100000000\n");
  EXPECT_THAT(expect_code(2, power + "'sh much'").error,
              HasSubstr("printed 'y', expected 'found after ...'"));
}

TEST_F(CommandLine, PowerHuntsWithATargetOfLibFuzzerForEachPromise) {
  write("fuzzer",
        "echo $* >>hunts\n"
        "case $2 in late) echo found after 0.5 s, 12 executions: a.case ;;\n"
        "refuted_bound) echo found after 0.7 s, 3 executions: b.case ;;\n"
        "*) echo nothing in 2 s, 100 executions ;; esac\n");
  expect_code(0,
              "power --time 6s --way libfuzzer --libfuzzer 'sh fuzzer' --json new.json "
              "--subject defect:later-root,defect:vv");
  EXPECT_EQ(read("hunts"),
            "--first false_negative 2s defect:later-root\n"
            "--first late 2s defect:later-root\n"
            "--first refuted_bound 2s defect:later-root\n"
            "--first false_negative 3s defect:vv\n"
            "--first refuted_bound 3s defect:vv\n");
  const json results = read_json("new.json");
  ASSERT_EQ(results.size(), 2);
  EXPECT_EQ(results[0]["failure"], "late");
  EXPECT_EQ(results[0]["seconds"], 0.5);
  EXPECT_EQ(results[0]["cases"], 12);
  EXPECT_EQ(results[1]["failure"], "refuted-bound");
}

class OptionValues : public CommandLine {
 protected:
  const std::string tightness = "tightness --family uniform --json new.json -q --subject ";
  const std::string sampling = plugin("sampling") + ":tolerance='*'";
};

TEST_F(OptionValues, AreAskedTheSameQueries) {
  const Output output = expect_code(1, tightness + "exact," + sampling + " --values 0,0.01,1 --cases 400");
  EXPECT_THAT(output.out, HasSubstr("\nsampling:tolerance=*\n"));
  const json all = read_json("new.json");
  EXPECT_EQ(all["subjects"].size(), 4);
  const json steps = all["option_sweeps"]["sampling:tolerance=*"];
  ASSERT_EQ(steps.size(), 3);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(steps[i]["value"], (std::array{0.0, 0.01, 1.0})[i]);
    EXPECT_EQ(steps[i]["queries"], 400);
    EXPECT_EQ(steps[i]["collisions"], steps[0]["collisions"]);
  }
  EXPECT_EQ(steps[0]["false_negatives"], steps[0]["collisions"]);  // no sampled distance is exactly 0
  EXPECT_LT(steps[1]["false_negatives"], steps[0]["false_negatives"]);
  EXPECT_EQ(steps[2]["false_negatives"], 0);
  EXPECT_EQ(steps[0]["false_positives"], 0);
  EXPECT_GT(steps[2]["false_positives"], steps[1]["false_positives"]);
}

TEST_F(OptionValues, AreSearchedOneByOne) {
  EXPECT_LE(run(tightness + sampling + " --values 0.01,0.1 --search --cases 132").code, 1);
  const json families = read_json("new.json")["subjects"]["sampling:tolerance=0.1"]["ee"]["families"];
  for (const char* searched : {"search-late-sampling:tolerance=0.01", "search-early-sampling:tolerance=0.1"})
    EXPECT_TRUE(families.contains(searched)) << searched;
}

TEST_F(OptionValues, ARunIsRepeatedByACampaign) {
  expect_code(1, tightness + sampling + " --values 0,0.01 --cases 200 --seed 5 --db a.db");
  const std::string again = read_json("new.json")["runs"][0]["again"];
  EXPECT_THAT(again, HasSubstr(":tolerance=0,"));
  EXPECT_EQ(json_of(1, again.substr(again.find(' ') + 1))["signatures"], read_json("new.json")["signatures"]);
  EXPECT_EQ(report_of("a.db", 1)["option_sweeps"].size(), 1);
}

TEST_F(OptionValues, AreRefusedWithoutAnOptionToTakeThem) {
  expect_refused(tightness + "wang", {"--values"});
  expect_refused("tightness --values 1,2 --json new.json", {"--subject"});
  expect_refused("tightness --cases 100 --json new.json", {"--values"});
  expect_refused(tightness + "exact --values 1,2", {"found 'exact', expected NAME:KEY=*"});
  expect_refused(tightness + sampling + " --values 1,2 --tolerance D2", {"--tolerance"});
  expect_refused(tightness + sampling + " --values 1,-1", {"tolerance=LENGTH"});
  expect_refused(tightness + "wang-eps:h='*' --values 1,2",
                 {"found 'h=2', expected h=NUMBER from 1e-300 to 1"});
  expect_refused(tightness + sampling + " --values 1,2 --separation 0.1", {"answers for contact only"});
  expect_refused(tightness + sampling + " --values 1,1", {"found '1' and '1', expected different numbers"});
}

class Paper : public CommandLine {
 protected:
  [[nodiscard]] json claim(const std::string& name) const {
    json all = json_of(0, "paper " + name).at("claims");
    EXPECT_EQ(all.size(), 1U) << name;
    EXPECT_EQ(all[0].at("name"), name);
    return all[0];
  }
};

TEST_F(Paper, AClaimIsMeasuredByItsCommands) {
  const json audit = json_of(0, "audit");
  const auto too_small =
      std::ranges::count_if(audit["constants"], [](const json& row) { return row["too_small"] == true; });
  struct Row {
    std::string name, verdict, measured, command;
  };
  for (const auto& [name, verdict, measured, command] :
       {Row{"constants", "holds with a condition",
            "and " + std::to_string(too_small) + " are too small where end points of edges are beyond B",
            "audit"},
        Row{"planes", "holds", "together 0.2", "paper planes"},
        Row{"order", "does not hold", "ε^0.250", "audit"},  // the paper's introduction claims ε^⅓
        Row{"gpu", "cannot be measured here", "", "paper gpu"}}) {
    const json found = claim(name);
    EXPECT_EQ(found["verdict"], verdict);
    EXPECT_THAT(found["measured"], HasSubstr(measured));
    EXPECT_EQ(found["commands"], json{"nearmiss " + command});
  }
}

TEST_F(Paper, NothingElseIsPrintedWithTheJson) {
  const Output output = expect_code(0, "paper constants tolerances --quiet --json -");
  EXPECT_EQ(json::parse(output.out)["claims"].size(), 2U);
  EXPECT_THAT(output.error, Not(HasSubstr("constant  ")));  // heading of the table of nearmiss audit
}

TEST_F(Paper, AnUnknownClaimIsRefused) { expect_refused("paper nothing", {"'nothing'", "constants"}); }

TEST_F(Paper, AReportShowsTheClaims) {
  expect_code(0, "paper gpu --json paper.json");
  expect_code(0, "fuzz --cases 4 --db a.db");
  EXPECT_EQ(report_of("a.db --paper paper.json")["paper"], read_json("paper.json"));
  for (const char* other : {R"({"claims": 1})", R"([])", R"({"claims": [1]})", R"({"claims": [], "run": 1})",
                            R"({"claims": [{"name": null}], "run": {}})"}) {
    write("other.json", other);
    EXPECT_THAT(expect_code(2, "report a.db -o report --paper other.json").error,
                HasSubstr("expected what nearmiss paper --json keeps"))
        << other;
  }
  json paper = read_json("paper.json");
  paper["claims"][0]["verdict"] = "maybe";
  write("other.json", paper.dump());
  EXPECT_THAT(expect_code(2, "report a.db -o report --paper other.json").error,
              HasSubstr("the verdict 'maybe'"));
}

// The table in ccd/README.md has a row for each claim of the paper that nearmiss measures. The row quotes the
// claim.
TEST_F(Paper, EachClaimIsInTheTable) {
  std::ifstream file(std::filesystem::path(NEARMISS_README).parent_path() / "ccd/README.md");
  const std::string readme((std::istreambuf_iterator<char>(file)), {});
  std::istringstream listed(expect_code(0, "paper --list").out);
  int claims = 0;
  for (std::string line; std::getline(listed, line);) {
    if (line.starts_with(" ")) continue;  // a command
    ++claims;
    const auto name = line.substr(0, line.find(' '));
    const auto says = line.substr(line.find("): ") + 3);
    EXPECT_THAT(readme, HasSubstr("| " + name + " |")) << line;
    EXPECT_THAT(readme, HasSubstr("| " + says + " |")) << line;
  }
  EXPECT_GT(claims, 20);
}

class DemoTest : public testing::CommandLine {
 protected:
  /// The words that bash offers as completions of the last word of this command line.
  [[nodiscard]] std::string completed(const std::string& words) const {
    (void)run("completion bash", "", "&& cp out.txt completion");
    const std::string command =
        "cd " + file("").string() + " && bash -c 'source ./completion; COMP_WORDS=(" + words +
        "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _nearmiss; echo \"${COMPREPLY[*]}\"' >words.txt";
    EXPECT_EQ(std::system(command.c_str()), 0) << words;
    return read("words.txt");
  }
};

TEST_F(DemoTest, ShowsAMissThatCanBeReplayed) {
  const Output output = expect_code(0, "demo -o 'a miss.case'");
  EXPECT_THAT(output.out,
              AllOf(ContainsRegex("of ordinary families, it has missed [0-9]+ collision"),
                    ContainsRegex("of degenerate and extreme families, basic has missed [0-9]+ collision"),
                    HasSubstr("wang, the failure-proof CCD, reports it."), ContainsRegex("\n  +[ .o#]*[0-3]"),
                    HasSubstr("nearmiss replay 'a miss.case' --subject bridson:thickness=0,wang\n")));
  std::istringstream lines(output.out);
  for (std::string line; std::getline(lines, line);)
    EXPECT_TRUE(line.size() <= 100 || line.starts_with("  x")) << line;
  const Output replayed = expect_code(1, "replay 'a miss.case' --subject bridson:thickness=0,wang,basic");
  EXPECT_THAT(replayed.out,
              AllOf(ContainsRegex("^FAIL bridson:thickness=0: MISSED the collision\n ok  basic: reports the "
                                  "collision.*\n ok  wang: reports the collision\n"),
                    HasSubstr("; ordinary "), HasSubstr(" --subject bridson:thickness=0 --as c++\n")));
}

TEST_F(DemoTest, SaysThatItCannotWrite) {
  expect_refused("demo -o no/folder.case", {"no/folder.case"});
  EXPECT_THAT(run("demo -o no/folder.case").out, ::testing::Not(HasSubstr("missed")));
  expect_refused("demo -o miss.txt", {"found 'miss.txt', expected a name that ends in .case"});
}

TEST_F(DemoTest, BashCompletesCommandsOptionsAndLists) {
  for (const auto& [words, completions] : std::vector<std::pair<std::string, std::string>>{
           {"shr", "shrink"},
           {"fuzz --subj", "--subject"},
           {"fuzz --subject basic,wang-t", "basic,wang-tight basic,wang-time"},
           {"fuzz --family uniform-e", "uniform-end"},
           {"fuzz --subject = ba", "basic basic-plain"},  // as in --subject=ba
           {"fuzz --sweep asp", "aspect"},
           {"fuzz --sweep uniform-e", ""},  // this family has no parameter
           {"fuzz --subject wang,./compl", "wang,./completion"}})
    EXPECT_EQ(completed("nearmiss " + words), completions + "\n");
  EXPECT_EQ(completed("nearmiss fuzz --subject ="), completed("nearmiss fuzz --subject \"\""));
  EXPECT_THAT(run("completion zsh").out, ::testing::StartsWith("#compdef nearmiss\n"));
  expect_refused("completion fish", {"found 'fish', expected bash or zsh"});
}

}  // namespace
}  // namespace nearmiss

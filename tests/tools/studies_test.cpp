// Studies as a user sees them: ladder, audit, power, tightness, and the values of a CCD's option.
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;
using testing::Background;
using testing::CommandLine;
using ::testing::HasSubstr;

TEST_F(CommandLine, TightnessGoesIntoTheReport) {
  expect_refused("tightness --tolerance nu", {"'nu'"});
  const Output output =
      expect_code(0, "tightness --time 1ms --tolerance D2,vertex-edge --db new.db --json new.json");
  EXPECT_THAT(output.out, HasSubstr("D2"));
  EXPECT_LT(read_json("new.json")["tightness"]["D2"]["value"], 1);
  EXPECT_GT(report_of("new.db")["tightness"]["vertex-edge"]["queries"], 0);
}

TEST_F(CommandLine, TheLadderIsACampaign) {
  const std::string ladder = "ladder --scalar float,p60 --family uniform --cases 80 --db ladder.db";
  EXPECT_EQ(run(ladder).code, 0);
  EXPECT_THAT(run(ladder + " --resume").out, HasSubstr("wang-tight:p60"));
  EXPECT_THAT(run("report ladder.db -o ladder").out, HasSubstr("wang:float"));
  EXPECT_THAT(run("ladder --scalar p15 --cases 1").error, HasSubstr("p16 to p256"));
}

TEST_F(CommandLine, TheAuditNamesConstantsThatAreTooSmall) {
  const Output output = expect_code(0, "audit --json audit.json");
  EXPECT_THAT(output.out, HasSubstr("TOO SMALL"));
  EXPECT_THAT(output.out, HasSubstr("not proven by Theorem 4.1: relative positions of edges are within 2B"));
  EXPECT_THAT(output.out, HasSubstr("33492"));
  EXPECT_EQ(run("fuzz --cases 4 --db a.db").code, 0);
  (void)report_of("a.db --audit audit.json");
  write("other.json", "{\"constants\": []}");
  EXPECT_THAT(run("report a.db -o report --audit other.json").error,
              HasSubstr("expected what nearmiss audit --json keeps"));
}

TEST_F(CommandLine, PowerResumesWhereItStopped) {
  const std::string command = "power --time 1s --way families,search --json new.json --subject ";
  const Output output = expect_code(0, command + "defect:vertex-edge");
  EXPECT_THAT(output.out, HasSubstr("found, of 1"));
  EXPECT_EQ(run(command + "defect:vertex-edge,defect:mu*1").code, 0);
  const json results = read_json("new.json");
  ASSERT_EQ(results.size(), 4);
  EXPECT_EQ(results[0]["failure"], "false-negative");
  EXPECT_GT(results[0]["cases"], 0);
  EXPECT_EQ(results[2]["subject"], "defect:mu*1");
  EXPECT_TRUE(results[2]["failure"].is_null());
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

TEST_F(CommandLine, PowerDoesNotMixSettings) {
  const std::string power = "power --subject defect:vertex-edge --way uniform --json a.json ";
  expect_code(0, power + "--time 1s");
  const Output other = expect_code(2, power + "--time 2s");
  EXPECT_THAT(other.error, HasSubstr("a.json: found hunts with --time 1s --seed 1, expected 2s and 1"));
  expect_code(2, power + "--time 1s --seed 2");
  expect_code(0, power + "--time 1s");
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

TEST_F(OptionValues, OfBuiltInSubjectsAreAskedToo) {
  EXPECT_EQ(run(tightness + "bridson:thickness='*' --values 0,1e-6,0.1 --cases 4000").code, 1);
  const json steps = read_json("new.json")["option_sweeps"]["bridson:thickness=*"];
  EXPECT_GT(steps[0]["false_negatives"], steps[1]["false_negatives"]);
  EXPECT_EQ(steps[2]["false_negatives"], 0);
  EXPECT_LE(steps[0]["false_positives"], steps[1]["false_positives"]);
  EXPECT_LT(steps[1]["false_positives"], steps[2]["false_positives"]);
}

// A short interval does not bracket roots, and a long one leaves weights too much room.
TEST_F(OptionValues, OfTheIntervalOfVertexEdgeCullingCauseNoMiss) {
  const std::string command =
      "tightness --family uniform,crossed --json new.json -q --subject wang-eps:h='*'";
  EXPECT_EQ(run(command + " --values 1e-12,1e-8,1e-3,1 --cases 4000").code, 0);
  const json subjects = read_json("new.json")["subjects"];
  const auto culled = [&](const char* h) {
    return subjects[std::string("wang-eps:h=") + h]["vt"]["rejected_by"].value("culled", 0);
  };
  EXPECT_EQ(culled("1e-12"), 0);
  EXPECT_GT(culled("1e-8"), culled("1e-3"));
  EXPECT_GT(culled("1e-3"), 0);
  EXPECT_EQ(culled("1"), 0);
}

TEST_F(OptionValues, AreSearchedOneByOne) {
  EXPECT_LE(run(tightness + sampling + " --values 0.01,0.1 --search --cases 132").code, 1);
  const json families = read_json("new.json")["subjects"]["sampling:tolerance=0.1"]["ee"]["families"];
  for (const char* searched : {"search-late-sampling:tolerance=0.01", "search-early-sampling:tolerance=0.1"})
    EXPECT_TRUE(families.contains(searched)) << searched;
}

TEST_F(OptionValues, ARunIsRepeatedByACampaign) {
  EXPECT_EQ(run(tightness + sampling + " --values 0,0.01 --cases 200 --seed 5 --db a.db").code, 1);
  const std::string again = read_json("new.json")["runs"][0]["again"];
  EXPECT_THAT(again, HasSubstr(":tolerance=0,"));
  EXPECT_EQ(run(again.substr(again.find(' ') + 1) + " --json again.json").code, 1);
  EXPECT_EQ(read_json("again.json")["signatures"], read_json("new.json")["signatures"]);
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

}  // namespace
}  // namespace nearmiss

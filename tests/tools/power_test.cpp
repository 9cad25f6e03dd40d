// Tests nearmiss power as a user sees it.
#include "tests/tools/command_line.hpp"

namespace nearmiss {
namespace {

using nlohmann::json;
using testing::CommandLine;
using ::testing::HasSubstr;

TEST_F(CommandLine, PowerResumesWhereItStopped) {
  const std::string command = "power --time 1s --way families,search --json new.json --subject ";
  const Output output = run(command + "defect:vertex-edge");
  EXPECT_EQ(output.code, 0) << output.error;
  EXPECT_THAT(output.out, HasSubstr("found, of 1"));
  EXPECT_EQ(run(command + "defect:vertex-edge,defect:mu*1").code, 0);
  const json results = read_json("new.json");
  ASSERT_EQ(results.size(), 4);
  EXPECT_EQ(results[0]["failure"], "false-negative");
  EXPECT_GT(results[0]["cases"], 0);
  EXPECT_EQ(results[2]["subject"], "defect:mu*1");
  EXPECT_TRUE(results[2]["failure"].is_null());
}

TEST_F(CommandLine, PowerHuntsWithATargetOfLibFuzzerForEachPromise) {
  write("fuzzer",
        "echo $* >>hunts\n"
        "case $2 in late) echo found after 0.5 s, 12 executions: a.case ;;\n"
        "refuted_bound) echo found after 0.7 s, 3 executions: b.case ;;\n"
        "*) echo nothing in 2 s, 100 executions ;; esac\n");
  const Output output =
      run("power --time 6s --way libfuzzer --libfuzzer 'sh fuzzer' --json new.json "
          "--subject defect:later-root,defect:vv");
  EXPECT_EQ(output.code, 0) << output.error;
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

}  // namespace
}  // namespace nearmiss

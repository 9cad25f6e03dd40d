// Whatever a plug-in does to nearmiss, each query gets an answer or a fault, and nothing of the plug-in stays.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "ccd/error.hpp"
#include "fuzz/subjects/isolation/isolated_plugin.hpp"
#include "fuzz/trial/signatures.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::string plugin(const std::string& name) { return NEARMISS_PLUGINS "/" + name + ".so"; }

/// A hundred queries; a plug-in intrudes at number 40.
constexpr std::size_t chosen = 40;
std::vector<Query> queries() {
  std::vector<Query> some(100, testing::falling_vertex(0.25, 0.25, 1, -1));
  some[chosen].x[0] = 0.95;
  return some;
}

std::vector<Verdict> answers_of(const Subject& subject, const std::vector<Query>& asked) {
  std::vector<Verdict> verdicts(asked.size());
  subject.decide(asked, verdicts);
  return verdicts;
}

/// A copy of a plug-in, by whose path its processes are known.
class CopiedPlugin {
 public:
  explicit CopiedPlugin(const std::string& name) {
    std::string folder = std::filesystem::temp_directory_path() / "nearmiss-XXXXXX";
    path_ = std::filesystem::path(mkdtemp(folder.data())) / (name + ".so");
    std::filesystem::copy(plugin(name), path_);
  }
  CopiedPlugin(const CopiedPlugin&) = delete;
  CopiedPlugin& operator=(const CopiedPlugin&) = delete;
  ~CopiedPlugin() { std::filesystem::remove_all(path_.parent_path()); }

  [[nodiscard]] std::string path() const { return path_; }

  /// The number of processes with this path among their arguments.
  [[nodiscard]] int processes() const {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
      std::ifstream file(entry.path() / "cmdline", std::ios::binary);
      const std::string arguments(std::istreambuf_iterator<char>(file), {});
      count += arguments.find(path_) != std::string::npos ? 1 : 0;
    }
    return count;
  }

 private:
  std::filesystem::path path_;
};

struct Intrusion {
  std::string name;
  Fault fault;  ///< at the query at which the plug-in intrudes; what is harmless is no fault
};

void PrintTo(const Intrusion& each, std::ostream* out) { *out << each.name; }

class Intruding : public ::testing::TestWithParam<Intrusion> {};
INSTANTIATE_TEST_SUITE_P(All, Intruding,
                         ::testing::Values(Intrusion{"write", Fault::protocol},
                                           Intrusion{"close", Fault::protocol},
                                           Intrusion{"truncate", Fault::none},
                                           Intrusion{"move_on", Fault::time},
                                           Intrusion{"fork", Fault::crash}),
                         [](const auto& each) { return each.param.name; });

TEST_P(Intruding, IsAFaultOfOneQueryAtMost) {
  const CopiedPlugin copied("intruding_" + GetParam().name);
  {
    const auto subject = make_isolated_plugin(copied.path(), {.time = std::chrono::milliseconds(100)});
    EXPECT_GT(copied.processes(), 0);
    const auto asked = queries();
    const auto verdicts = answers_of(*subject, asked);
    int faults = 0;
    for (const Verdict& verdict : verdicts) {
      EXPECT_EQ(verdict.hit, verdict.fault == Fault::none);
      faults += verdict.fault == Fault::none ? 0 : 1;
    }
    EXPECT_EQ(faults, GetParam().fault == Fault::none ? 0 : 1);
    // A worker that broke its channel cannot say which query it was at.
    if (GetParam().fault != Fault::protocol) {
      EXPECT_EQ(verdicts[chosen].fault, GetParam().fault);
    }
  }
  EXPECT_EQ(copied.processes(), 0);
}

/// What nearmiss holds for its workers: open files, and mappings of the memory that it shares with them.
std::array<std::size_t, 2> held() {
  std::array<std::size_t, 2> count{};
  for ([[maybe_unused]] const auto& each : std::filesystem::directory_iterator("/proc/self/fd")) ++count[0];
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);)
    count[1] += line.find("nearmiss-worker") != line.npos ? 1 : 0;
  return count;
}

TEST(Isolation, LeavesNoFileAndNoMemory) {
  const auto before = held();
  {
    const auto subject = make_isolated_plugin(plugin("crash"));
    const auto during = held();
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_GT(during[i], before[i]);
    answers_of(*subject, queries());  // replaces the worker
    EXPECT_EQ(held(), during);
  }
  EXPECT_EQ(held(), before);
}

TEST(Isolation, MayStartSomeProcesses) {
  const auto subject = make_isolated_plugin(plugin("process_limit"));
  EXPECT_EQ(subject->decide(queries().front()).fault, Fault::none);
  EXPECT_TRUE(subject->decide(queries().front()).hit);
}

TEST(Throwing, IsAFaultWithItsText) {
  const auto subject = make_isolated_plugin(plugin("throwing"));
  const auto asked = queries();
  const auto verdicts = answers_of(*subject, asked);
  for (std::size_t i = 0; i < asked.size(); ++i)
    EXPECT_EQ(verdicts[i].fault, i == chosen ? Fault::exception : Fault::none) << i;
  const std::string text = subject->fault_text(verdicts[chosen]);
  EXPECT_EQ(text, "no root in [0.950000, 1] ?[31m");
  EXPECT_EQ(fault_signature(Kind::vertex_triangle, verdicts[chosen], text),
            "vt exception no root in [#, #] ?[#m");
}

TEST(Throwing, WhileItIsLoadedIsSaid) {
  EXPECT_THAT(
      [] { make_isolated_plugin(plugin("throwing_while_loaded")); },
      ThrowsMessage<Error>(HasSubstr("the plug-in threw an exception: no licence while it was loaded")));
}

TEST(Isolation, ANameIsMadePrintable) {
  EXPECT_EQ(make_isolated_plugin(plugin("bad_name"))->name(), "=1+1?[31m?");
}

}  // namespace
}  // namespace nearmiss

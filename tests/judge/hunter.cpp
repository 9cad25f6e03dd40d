// Hunts for a disagreement within the oracle: usage: judge_hunter [QUERIES [SEED]].
//
// It takes blocks of queries from all families in turn. It stops if two parts of the oracle disagree, if a
// part crashes or takes too long, or after QUERIES queries. It prints one line, "found WHAT FAMILY:SEED:INDEX
// QUERIES" or "nothing QUERIES". Exit code 1 means that something was found.
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "corpus/query_text.hpp"
#include "fuzz/families/families.hpp"
#include "tests/judge/questions.hpp"

namespace nearmiss {
namespace {

/// The position of the hunt, for the message of a signal.
struct HuntPosition {
  const char* family = "";
  std::uint64_t seed = 0;
  std::uint64_t index = 0;
  std::uint64_t queries = 0;
};
HuntPosition position;  // NOLINT: a signal handler can read only globals

std::string found(const std::string& what) {
  return fmt::format("found {} {}:{}:{} {}\n", what, position.family, position.seed, position.index,
                     position.queries);
}

/// Limit of CPU time for one query, far above the time of any query; a defect can make a search endless.
constexpr int seconds_per_query = 20;

void restart_clock() {
  const itimerval limit{{0, 0}, {seconds_per_query, 0}};
  setitimer(ITIMER_PROF, &limit, nullptr);
}

extern "C" void say_where_it_ended(int signal) {
  std::array<char, 256> line;
  const char* const what = signal == SIGPROF ? "hang" : signal == SIGXCPU ? "slow" : "crash";
  const int size = std::snprintf(line.data(), line.size(), "found %s %s:%llu:%llu %llu\n", what,
                                 position.family, static_cast<unsigned long long>(position.seed),
                                 static_cast<unsigned long long>(position.index),
                                 static_cast<unsigned long long>(position.queries));
  const auto written = write(STDOUT_FILENO, line.data(), static_cast<std::size_t>(size));
  _exit(written == size ? 1 : 3);
}

/// Makes sure that a crash, an endless search or exhausted memory ends the program with a line about the
/// query.
void catch_all_ends() {
  static std::array<char, 1 << 16> stack;  // a separate stack for the handler, because the program's stack
                                           // may have overflowed
  const stack_t other{.ss_sp = stack.data(), .ss_flags = 0, .ss_size = stack.size()};
  sigaltstack(&other, nullptr);
  struct sigaction action {};
  action.sa_handler = say_where_it_ended;
  action.sa_flags = SA_ONSTACK;
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGPROF, SIGXCPU})
    sigaction(signal, &action, nullptr);
  constexpr rlim_t memory = rlim_t{2} << 30;
  const rlimit bytes{memory, memory};
  setrlimit(RLIMIT_AS, &bytes);
  constexpr rlim_t minutes = 5;  // all queries together take a few seconds
  const rlimit seconds{60 * minutes, 60 * minutes + 1};
  setrlimit(RLIMIT_CPU, &seconds);
}

/// The line about a disagreement in a block of a family's queries, or "".
std::string hunt(const Family& family, std::uint64_t first, std::uint64_t count) {
  const std::uint64_t before = position.queries;
  std::vector<Query> queries;
  for (std::uint64_t i = 0; i < count; ++i) queries.push_back(make_query(family, position.seed, first + i));
  const auto go_to = [&](std::size_t i) {
    position.index = first + i;
    position.queries = before + i + 1;
    restart_clock();
  };
  position.family = family.name.c_str();
  const auto disagreement = family.has_separation ? first_approach_disagreement(queries, first, go_to)
                                                  : first_disagreement(queries, first, go_to);
  go_to(disagreement ? disagreement->at : count - 1);
  return disagreement ? found(disagreement->what) : "";
}

/// All families that ask for contact, each followed by a family of the same queries with a separation. For
/// small integers, some separations are distances of points on a grid, so that ties occur.
std::vector<Family> hunted_families() {
  std::vector<Family> hunted;
  for (const Family& family : families()) {
    hunted.push_back(family);
    hunted.push_back(with_separation(family, drawn_separation));
    for (const char* const h : {"0.25", "0.5", "1"})
      if (family.name == "small-integer" || family.name == "unit-integer")
        hunted.push_back(with_separation(family, h));
  }
  hunted.insert(hunted.end(), separation_families().begin(), separation_families().end());
  return hunted;
}

std::string hunt_until(std::uint64_t most) {
  constexpr std::uint64_t of_contact = 50;
  constexpr std::uint64_t with_a_separation = 10;  // fewer, because exact answers take longer
  const std::vector<Family> hunted = hunted_families();
  for (std::uint64_t block = 0;; ++block)
    for (const Family& family : hunted) {
      if (position.queries >= most) return fmt::format("nothing {}\n", position.queries);
      const std::uint64_t count = family.has_separation ? with_a_separation : of_contact;
      if (std::string line = hunt(family, block * count, count); !line.empty()) return line;
    }
}

}  // namespace
}  // namespace nearmiss

int main(int argc, char** argv) {
  using namespace nearmiss;
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  std::string line;
  try {
    const double most = arguments.empty() ? 100000 : parse_number(arguments[0], "QUERIES");
    position.seed = static_cast<std::uint64_t>(arguments.size() < 2 ? 1 : parse_number(arguments[1], "SEED"));
    catch_all_ends();
    line = hunt_until(static_cast<std::uint64_t>(most));
  } catch (const std::exception& error) {
    line = found(fmt::format("exception: {}", error.what()));
  }
  std::fputs(line.c_str(), stdout);
  return line.starts_with("nothing") ? 0 : 1;
}

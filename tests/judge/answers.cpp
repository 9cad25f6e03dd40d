// Prints the oracle's answers to queries of all families, and whether certificates prove them. Usage:
// judge_answers QUERIES [all]. It prints one line for each query:
//
//   FAMILY:SEED:INDEX#HASH KIND ANSWER PROVED TIME TIME PROVED DISTANCE DISTANCE PROVED
//
// HASH tells queries apart. ANSWER is 0, 1 or tie. TIME TIME enclose the earliest time, and DISTANCE DISTANCE
// the smallest distance; "-" stands for what there is not. PROVED is 1 or 0. A query that crashes or takes too
// long has no line; after ten of these, the program ends. At the first query that has no line, or a 0, it prints
// "found FAMILY:SEED:INDEX QUERIES" and, without `all`, ends. The exit code is then 1.
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/query_text.hpp"
#include "fuzz/families/families.hpp"
#include "oracle/agreement/checked.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Whether a certificate proves a bound of the smallest distance. If it does not, the next double away from
/// the distance may be the proved one.
template <class Certify>
bool is_proved_bound(const Query& query, std::string_view claim, double h, double next,
                     const Certify& certify) {
  const auto is_proved_for = [&](double each, bool is_strict) {
    const Query with_h = with_separation(query, each);
    return proved(certify(with_h, is_strict)) == statement_about(with_h, claim, {}, is_strict);
  };
  return is_proved_for(h, false) || is_proved_for(next, claim == "apart");
}

bool is_proved_distance(const Query& query, const Enclosure& d) {
  const auto apart = [](const Query& each, bool is_strict) { return certify_apart(each, {}, is_strict); };
  const auto meets = [](const Query& each, bool) { return certify_meets(each, {}); };
  return (d.lo == 0 || is_proved_bound(query, "apart", d.lo, std::nextafter(d.lo, 0), apart)) &&
         (d.hi == infinity || is_proved_bound(query, "meets", d.hi, std::nextafter(d.hi, infinity), meets));
}

/// A line about a query.
struct Line {
  std::string text;
  bool is_proved = true;

  /// Adds answers, and whether they are proved.
  void add(std::string_view answers, bool are_proved) {
    text += fmt::format(" {} {:d}", answers, are_proved);
    is_proved &= are_proved;
  }
};

std::string ends(const Enclosure& enclosure) {
  return fmt::format("{} {}", to_hex(enclosure.lo), to_hex(enclosure.hi));
}

Line line(const Query& query) {
  const Decision decision = decide(query);
  Line line{std::string(short_name(query.kind))};
  line.add(decision.is_tie ? "tie" : decision.collision ? "1" : "0", is_proved(query, decision));
  if (decision.collision || decision.is_tie)
    line.add(ends(EarliestTime(query, decision.known).enclosure()),
             time_disagreement(query, decision).empty());
  else
    line.add("- -", true);
  const Enclosure d = minimum_distance(query);
  line.add(ends(d), is_proved_distance(query, d));
  return line;
}

enum class Result : std::uint8_t { proved, not_proved, missing };

/// Calls a function that returns whether all answers are proved. An error of the oracle may crash the process or
/// make a search endless, so it runs in a process of its own.
template <class IsProved>
Result in_a_process(const IsProved& is_proved) {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    constexpr rlim_t seconds = 5;
    const rlimit limit{seconds, seconds};
    setrlimit(RLIMIT_CPU, &limit);
    const bool all = is_proved();
    std::fflush(stdout);
    _exit(all ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (!WIFEXITED(status) || WEXITSTATUS(status) > 1) return Result::missing;
  return WEXITSTATUS(status) == 0 ? Result::proved : Result::not_proved;
}

}  // namespace
}  // namespace nearmiss

int main(int argc, char** argv) {
  using namespace nearmiss;
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const double most = arguments.empty() ? 3000 : parse_number(arguments[0], "QUERIES");
  const bool goes_on = arguments.size() > 1;
  const auto families = all_families();
  constexpr int most_missing = 10;
  int missing = 0;
  bool is_proved = true;
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(most); ++i) {
    const Family& family = families[i % families.size()];
    const std::uint64_t index = i / families.size();
    const std::string name = fmt::format("{}:1:{}", family.name, index);
    const Result result = in_a_process([&] {
      const Query query = make_query(family, 1, index);
      const Line about = line(query);
      // Some families ask the oracle for their separations, so an error may change the query itself.
      fmt::print("{}#{:x} {}\n", name, std::hash<std::string>()(to_line(query)), about.text);
      return about.is_proved;
    });
    missing += result == Result::missing ? 1 : 0;
    if (result != Result::proved && is_proved) fmt::print("found {} {}\n", name, i + 1);
    is_proved &= result == Result::proved;
    if ((!is_proved && !goes_on) || missing == most_missing) break;
  }
  return is_proved ? 0 : 1;
}

// Searches for the queries that take longest in each part of the oracle's work. The parts are the decision;
// the earliest time of a collision; the distance of a false positive; the comparison of all exact methods;
// and the certificates. The search begins with queries of all families, and with the cases in the files and
// folders PATH. Then the search mutates and crosses the slowest queries of each part. Prints ms of processor
// time, and writes the slowest query of each part into FOLDER:
//   slowest_queries SECONDS SEED FOLDER [PATH...]
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ccd/query/arithmetic.hpp"
#include "ccd/query/error.hpp"
#include "ccd/subjects/stopwatch.hpp"
#include "corpus/query_text.hpp"
#include "corpus/readers.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/families/mutation.hpp"
#include "fuzz/subjects/subjects.hpp"
#include "fuzz/trial/judge.hpp"
#include "fuzz/trial/truth.hpp"
#include "oracle/certificates/certificate.hpp"

namespace nearmiss {
namespace {

/// A part of the oracle's work. The function `work` does this part for a query that is already decided.
struct Part {
  std::string_view name;
  std::string_view about;
  bool (*concerns)(const Decision& decision);
  void (*work)(const Query& query, const Decision& decision);
};

/// Judges a false positive of the subject `basic`, which claims no bound. The judgement needs the query's
/// smallest distance.
void judge_report(const Query& query, const Decision& decision) {
  static const auto basic = make_subject("basic");
  static const Judge judge(*basic);
  Truth truth(query, decision);
  (void)judge.judge({.hit = true, .stage = Stage::unspecified}, truth);
}

constexpr Part parts[] = {
    {"decision", "whether there is a collision", [](const Decision& /*decision*/) { return true; },
     [](const Query& query, const Decision& /*decision*/) { decide(query); }},
    {"time", "the earliest time as narrowly as doubles allow, and whether a time equal to it is late",
     [](const Decision& decision) { return decision.collision || decision.is_tie; },
     [](const Query& query, const Decision& decision) {
       Truth truth(query, decision);
       (void)truth.time().makes_late(truth.time().enclosure(0).lo);
     }},
    {"distance", "the smallest distance in units of wang's bound, to 1/1000",
     [](const Decision& decision) { return !decision.collision && !decision.is_tie; }, judge_report},
    {"agreement", "the answers and times of all exact methods",
     [](const Decision& /*decision*/) { return true; },
     [](const Query& query, const Decision& decision) {
       const Truth truth(query, decision);
       (void)truth.disagreement(truth.ask_methods());
     }},
    {"certificate", "proofs of the answer, of the earliest time and of the smallest distance",
     [](const Decision& /*decision*/) { return true; },
     [](const Query& query, const Decision& /*decision*/) {
       certify(query);
       certify_time(query);
       certify_distance(query);
     }},
};

struct Timed {
  std::uint64_t nanoseconds;
  Query query;
  std::string provenance;
};

class Slowest {
 public:
  explicit Slowest(const Part& part) : part_(part) {}

  void offer(const Query& query, const Decision& decision, std::string provenance) {
    if (!part_.concerns(decision)) return;
    const auto work = [&] { part_.work(query, decision); };
    if (!is_slow(time_of(CLOCK_THREAD_CPUTIME_ID, work))) return;
    const std::uint64_t best = best_time_of(CLOCK_THREAD_CPUTIME_ID, work);
    if (!is_slow(best)) return;
    if (kept_.size() == most) kept_.pop_back();
    const auto place =
        std::find_if(kept_.begin(), kept_.end(), [&](const Timed& each) { return each.nanoseconds < best; });
    kept_.insert(place, {best, query, std::move(provenance)});
  }

  [[nodiscard]] const Part& part() const { return part_; }
  [[nodiscard]] const std::vector<Timed>& kept() const { return kept_; }

 private:
  static constexpr std::size_t most = 32;

  [[nodiscard]] bool is_slow(std::uint64_t time) const {
    return kept_.size() < most || time > kept_.back().nanoseconds;
  }

  const Part& part_;
  std::vector<Timed> kept_;  ///< slowest first
};

/// Tries queries of the families for a quarter of the time, then mutations of the slowest queries.
class Search {
 public:
  Search(double seconds, std::uint64_t seed) : seconds_(seconds), seed_(seed) {
    for (const Part& part : parts) slowest_.emplace_back(part);
  }

  void offer(const Query& query, const std::string& provenance) {
    const Decision decision = decide(query);
    for (Slowest& slowest : slowest_) slowest.offer(query, decision, provenance);
  }

  void run() {
    for (std::uint64_t index = 0; elapsed() < seconds_ / 4; ++index)
      for (const Family& family : all_families())
        offer(make_query(family, seed_, index), fmt::format("{}:{}:{}", family.name, seed_, index));
    for (std::uint64_t index = 0; elapsed() < seconds_; ++index) {
      Slowest& slowest = slowest_[index % slowest_.size()];
      if (!slowest.kept().empty()) mutate(slowest, index);
    }
  }

  [[nodiscard]] const std::vector<Slowest>& slowest() const { return slowest_; }

 private:
  void mutate(Slowest& slowest, std::uint64_t index) {
    Random random(seed_, 0, index);
    const auto& kept = slowest.kept();
    const auto any = [&]() -> const Timed& {
      return kept[static_cast<std::size_t>(random.integer(0, static_cast<int>(kept.size()) - 1))];
    };
    const Timed& parent = any();
    const Query& other = any().query;
    const bool crosses = other.kind == parent.query.kind && random.one_in(4);
    const Query child = crosses ? crossed(random, parent.query, other) : mutated(random, parent.query);
    if (is_finite(child)) slowest.offer(child, decide(child), parent.provenance);
  }

  [[nodiscard]] double elapsed() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  double seconds_;
  std::uint64_t seed_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::vector<Slowest> slowest_;
};

void run(const std::vector<std::string>& arguments) {
  if (arguments.size() < 3) throw Error("expected SECONDS SEED FOLDER [PATH...]");
  const PlainArithmetic guard;
  const auto seed = parse_integer<std::uint64_t>(arguments[1]);
  if (!seed) throw Error(fmt::format("SEED: found '{}', expected an integer", arguments[1]));
  Search search(parse_number(arguments[0], "SECONDS"), *seed);
  for (std::size_t i = 3; i < arguments.size(); ++i)
    read_cases(arguments[i], [&](const Case& each) {
      search.offer(each.query, each.provenance.empty() ? each.name : each.provenance);
    });
  search.run();
  const std::filesystem::path folder(arguments[2]);
  std::filesystem::create_directories(folder);
  for (const Slowest& slowest : search.slowest()) {
    if (slowest.kept().empty()) continue;
    const auto& [nanoseconds, query, provenance] = slowest.kept().front();
    const double ms = 1e-6 * static_cast<double>(nanoseconds);
    std::cout << fmt::format("{:9} {:7.3f} ms  from {}\n", slowest.part().name, ms, provenance);
    const std::string name = fmt::format("{}-{}", short_name(query.kind), slowest.part().name);
    write_case(
        {.name = name,
         .query = query,
         .truth = collides(query),
         .why = fmt::format("The slowest query found for one part of the oracle:\n{}.", slowest.part().about),
         .provenance = provenance},
        folder / (name + ".case"));
  }
}

}  // namespace
}  // namespace nearmiss

int main(int argc, char** argv) {
  try {
    nearmiss::run({argv + 1, argv + argc});
  } catch (const std::exception& exception) {
    std::cerr << exception.what() << "\n";
    return 2;
  }
  return 0;
}

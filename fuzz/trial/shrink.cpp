#include "fuzz/trial/shrink.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "fuzz/trial/neighbourhoods.hpp"
#include "reports/campaign/complexity.hpp"

namespace nearmiss {

namespace {

/// The length, in machine words, of the integers that exact arithmetic needs to compute with a query's
/// numbers.
int words(const Numbers& x) {
  const auto all = magnitudes(x);
  if (all.empty()) return 1;
  int lowest = std::ilogb(all.front());
  for (const double m : all) lowest = std::min(lowest, std::ilogb(m) - significant_bits(m) + 1);
  return 1 + (std::ilogb(all.back()) - lowest) / 64;
}

class Shrinker {
 public:
  Shrinker(const Query& query, const FindFailing& find_failing)
      : kind_(query.kind),
        neighbourhoods_(neighbourhoods(query.kind)),
        best_(numbers_of(query)),
        complexity_(complexity(query)),
        find_failing_(find_failing) {}

  Query run() {
    Numbers before;
    do {
      before = best_;
      for (const auto& neighbourhood : neighbourhoods_) explore(neighbourhood(best_));
    } while (best_ != before && work_ > 0);
    return query_of(best_);
  }

 private:
  /// A changed query, and the place of its change in a neighbourhood.
  struct Candidate {
    Numbers numbers;
    Complexity complexity;
    std::size_t entry, alternative;
  };

  [[nodiscard]] Query query_of(const Numbers& x) const {
    Query query{.kind = kind_, .separation = x.back()};
    std::copy_n(x.begin(), query.x.size(), query.x.begin());
    repeat_vertices(query);
    return query;
  }

  /// Tries the changes of a neighbourhood in their order. Takes each change that makes the query simpler and
  /// leaves the query failing. Asks about many changes in a batch; if no query of a batch fails, the next
  /// batch is larger.
  void explore(const Neighbourhood& changes) {
    constexpr std::size_t largest_batch = 64;
    std::size_t size = 1;
    std::size_t entry = 0;
    std::size_t alternative = 0;
    while (work_ > 0) {
      const std::vector<Candidate> batch = candidates(changes, entry, alternative, size);
      if (batch.empty()) return;
      const auto failing = ask(batch);
      size = failing ? std::max<std::size_t>(1, size / 4) : std::min(2 * size, largest_batch);
      if (!failing) continue;
      const Candidate& taken = batch[*failing];
      best_ = taken.numbers;
      complexity_ = taken.complexity;
      entry = taken.entry + 1;
      alternative = 0;
    }
  }

  /// Returns at most `size` candidates, from the place (`entry`, `alternative`) of the neighbourhood on.
  /// Moves this place behind the last candidate that it returns.
  std::vector<Candidate> candidates(const Neighbourhood& changes, std::size_t& entry,
                                    std::size_t& alternative, std::size_t size) const {
    std::vector<Candidate> batch;
    for (; entry < changes.size(); ++entry, alternative = 0)
      for (; alternative < changes[entry].size(); ++alternative) {
        if (batch.size() == size) return batch;
        Candidate candidate{best_, {}, entry, alternative};
        changes[entry][alternative](candidate.numbers);
        if (is_simpler(candidate)) batch.push_back(candidate);
      }
    return batch;
  }

  /// Whether a candidate is simpler than the best query so far. Sets the candidate's complexity. If two
  /// queries are equally complex, the query whose numbers come first in lexicographic order counts as
  /// simpler, so that no step undoes another step.
  bool is_simpler(Candidate& candidate) const {
    Numbers& x = candidate.numbers;
    for (double& c : x) c += 0.0;  // turns -0 into 0
    x.back() = std::abs(x.back());
    if (!std::all_of(x.begin(), x.end(), [](double c) { return std::isfinite(c); })) return false;
    const Query changed = query_of(x);
    x = numbers_of(changed);
    candidate.complexity = complexity(changed);
    return candidate.complexity < complexity_ || (candidate.complexity == complexity_ && x < best_);
  }

  std::optional<std::size_t> ask(const std::vector<Candidate>& batch) {
    std::vector<Query> queries;
    for (const Candidate& each : batch) {
      work_ -= words(each.numbers);
      queries.push_back(query_of(each.numbers));
    }
    return find_failing_(queries);
  }

  Kind kind_;
  std::vector<std::function<Neighbourhood(const Numbers&)>> neighbourhoods_;
  Numbers best_;
  Complexity complexity_;
  const FindFailing& find_failing_;
  long work_ = 200000;  ///< the work that shrinking may still do, in words of exact arithmetic
};

}  // namespace

Query shrunk(const Query& query, const FindFailing& find_failing) {
  return find_failing(std::span(&query, 1)) ? Shrinker(query, find_failing).run() : query;
}

}  // namespace nearmiss

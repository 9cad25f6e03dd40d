#include "reports/statistics/factor_counts.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "reports/statistics/confidence.hpp"

namespace nearmiss {

namespace {

double ratio(std::uint64_t part, std::uint64_t of) {
  return static_cast<double>(part) / static_cast<double>(of);
}

/// Whether common_factors() prefers a to b. It prefers the larger lift; if the lifts are equal, it follows
/// the rules for ties in factor_counts.hpp.
bool is_better(const CommonFactors& a, const CommonFactors& b) {
  const auto merit = [](const CommonFactors& each) {
    const bool is_single = each.key.values.find(' ') == std::string::npos;
    return std::tuple{ratio(each.with.false_negatives, each.with.collisions), each.with.false_negatives,
                      is_single};
  };
  return merit(a) > merit(b);
}

}  // namespace

void count_answer(FactorTable& table, const FactorKey& key, std::span<const std::string> values,
                  bool collides, bool reported) {
  const auto one_if = [](bool condition) { return condition ? std::uint64_t{1} : 0; };
  const FactorCounts one{one_if(collides), one_if(collides && !reported), one_if(!collides),
                         one_if(!collides && reported)};
  FactorKey own = key;
  const auto count = [&](std::string text) {
    own.values = std::move(text);
    table[own].merge(one);
  };
  count("");
  for (std::size_t i = 0; i < values.size(); ++i) {
    count(values[i]);
    for (std::size_t j = i + 1; j < values.size(); ++j) count(values[i] + " " + values[j]);
  }
}

double CommonFactors::share() const { return ratio(with.false_negatives, all.false_negatives); }
double CommonFactors::share_of_collisions() const { return ratio(with.collisions, all.collisions); }

namespace {

/// The parts FACTOR and x of a text "FACTOR=2^x"; nothing for any other text.
std::optional<std::pair<std::string_view, int>> power(std::string_view value) {
  constexpr std::string_view between = "=2^";
  const auto at = value.find(between);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view digits = value.substr(at + between.size());
  int x = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), x);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return std::pair{value.substr(0, at), x};
}

}  // namespace

std::vector<CommonFactors> common_factors(const FactorTable& table) {
  std::vector<CommonFactors> best;
  for (const auto& [key, with] : table) {
    // Factors whose values are powers of two are left out, because right_ranges() covers them.
    if (key.values.empty() || with.false_negatives == 0 || power(key.values)) continue;
    FactorKey all = key;
    all.values.clear();
    const auto sum = table.find(all);
    if (sum == table.end() || 2 * with.false_negatives < sum->second.false_negatives) continue;
    const CommonFactors found{key, with, sum->second};
    const bool is_first =
        best.empty() || std::tie(best.back().key.subject, best.back().key.kind, best.back().key.family) !=
                            std::tie(key.subject, key.kind, key.family);
    if (is_first)
      best.push_back(found);
    else if (is_better(found, best.back()))
      best.back() = found;
  }
  return best;
}

namespace {

/// For a factor with values 2^x: the answers by x.
using Powers = std::map<int, FactorCounts>;

double false_positive_rate(const FactorCounts& counts) {
  return counts.others == 0 ? 0 : ratio(counts.false_positives, counts.others);
}

constexpr double improbable = 1e-4;

/// The answers at one value 2^x of a factor, and whether they have misses or too many false positives.
struct Level {
  int x;
  FactorCounts counts;
  bool misses = false, reports = false;

  [[nodiscard]] bool is_right() const { return !misses && !reports; }
};

FactorCounts sum_of(std::span<const Level> levels) {
  FactorCounts sum;
  for (const Level& each : levels) sum.merge(each.counts);
  return sum;
}

/// Chooses the five successive values that have, together, the lowest rate of false positives, and returns
/// the sum of their answers. Ignores values with misses, because a CCD that misses everything has no false
/// positives. If fewer than five values remain, returns the sum over all of them.
FactorCounts best_answers(std::vector<Level> levels) {
  constexpr std::size_t most = 5;
  std::erase_if(levels, [](const Level& each) { return each.misses; });
  const std::size_t width = std::min(most, levels.size());
  FactorCounts best = sum_of(std::span(levels).first(width));
  for (std::size_t i = 1; i + width <= levels.size(); ++i) {
    const FactorCounts sum = sum_of(std::span(levels).subspan(i, width));
    if (false_positive_rate(sum) < false_positive_rate(best)) best = sum;
  }
  return best;
}

/// Whether the rate of false positives in `counts` is above three quarters (and `counts` has at least four
/// queries without a collision), or exceeds the rate in `best` by more than a quarter and by more than chance
/// explains.
bool reports_more(const FactorCounts& counts, const FactorCounts& best) {
  constexpr double more = 0.25, most = 0.75;
  const double rate = false_positive_rate(counts);
  if (counts.others >= 4 && rate > most) return true;
  return rate > false_positive_rate(best) + more &&
         fisher_test({counts.false_positives, counts.others}, {best.false_positives, best.others}).more <
             improbable;
}

std::vector<Level> levels_of(const Powers& powers) {
  std::vector<Level> levels;
  for (const auto& [x, counts] : powers) levels.push_back({x, counts, counts.false_negatives > 0});
  const FactorCounts best = best_answers(levels);
  for (Level& each : levels) each.reports = reports_more(each.counts, best);
  return levels;
}

/// The longest sequence of neighbouring values at which the subject is right; the first one if several are
/// equally long.
std::span<const Level> longest_run(std::span<const Level> levels) {
  std::span<const Level> longest;
  for (std::size_t first = 0; first < levels.size();) {
    std::size_t end = first;
    while (end < levels.size() && levels[end].is_right() &&
           (end == first || levels[end].x == levels[end - 1].x + 1))
      ++end;
    if (end - first > longest.size()) longest = levels.subspan(first, end - first);
    first = std::max(end, first + 1);
  }
  return longest;
}

/// Whether it may be chance that a subject misses none of the `collisions` at some consecutive values.
/// `outside` has the values on one side of those consecutive values, nearest first. Tries several rates of
/// misses: the rate at the nearest value of `outside`, the rate at the nearest two values together, and so
/// on. Returns true if, with one of these rates, it is not improbable that there are no misses. Returns false
/// if the nearest value has no misses.
template <class Levels>
bool may_be_chance(std::uint64_t collisions, const Levels& outside) {
  if (outside.empty() || !outside.front().misses) return false;
  FactorCounts sum;
  for (const Level& each : outside) {
    sum.merge(each.counts);
    if (sum.collisions > 0 &&
        std::pow(1 - ratio(sum.false_negatives, sum.collisions), collisions) >= improbable)
      return true;
  }
  return false;
}

RightRange range_of(const Powers& powers) {
  const std::vector<Level> levels = levels_of(powers);
  const FactorCounts all = sum_of(levels);
  const std::span<const Level> run = longest_run(levels);
  const auto start = static_cast<std::size_t>(run.empty() ? 0 : &run.front() - levels.data());
  const std::span<const Level> below = std::span(levels).first(start);
  const std::span<const Level> above = std::span(levels).subspan(start + run.size());
  FactorCounts inside = sum_of(run);
  RightRange range;
  range.too_few = all.collisions < 2 * levels.size();
  if (!run.empty() && !range.too_few && inside.collisions > 0 &&
      !may_be_chance(inside.collisions, std::vector<Level>(below.rbegin(), below.rend())) &&
      !may_be_chance(inside.collisions, above))
    range.exponents = {run.front().x, run.back().x};
  else
    inside = {};
  for_each_counter<FactorCounts>([&](const auto& counter) {
    range.elsewhere.*counter.member = all.*counter.member - inside.*counter.member;
  });
  return range;
}

}  // namespace

std::vector<RightRange> right_ranges(const FactorTable& table) {
  std::map<std::tuple<std::string, std::string, Kind>, Powers> found;
  for (const auto& [key, counts] : table)
    if (const auto value = power(key.values))
      found[{key.subject, std::string(value->first), key.kind}][value->second].merge(counts);
  std::vector<RightRange> ranges;
  for (const auto& [key, powers] : found) {
    ranges.push_back(range_of(powers));
    std::tie(ranges.back().subject, ranges.back().factor, ranges.back().kind) = key;
  }
  return ranges;
}

}  // namespace nearmiss

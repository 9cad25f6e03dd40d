#include "reports/statistics/factor_counts.hpp"

#include <charconv>
#include <cmath>
#include <string_view>

#include "reports/statistics/confidence.hpp"

namespace nearmiss {

namespace {

double ratio(std::uint64_t part, std::uint64_t of) {
  return static_cast<double>(part) / static_cast<double>(of);
}

/// Whether a comes before b: its lift is larger, or the lifts are equal and a wins the tie (see
/// common_factors).
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

std::vector<CommonFactors> common_factors(const FactorTable& table) {
  std::vector<CommonFactors> best;
  for (const auto& [key, with] : table) {
    if (key.values.empty() || with.false_negatives == 0) continue;
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

/// The answers by x, of a factor whose values are powers 2^x.
using Powers = std::map<int, FactorCounts>;

/// FACTOR and x of "FACTOR=2^x"; nothing for any other text.
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

double false_positive_rate(const FactorCounts& counts) {
  return counts.others == 0 ? 0 : ratio(counts.false_positives, counts.others);
}

constexpr double improbable = 1e-4;

/// The answers where sizes are about 1.
FactorCounts usual_answers(const Powers& powers) {
  FactorCounts usual;
  for (int x = -2; x <= 2; ++x)
    if (const auto found = powers.find(x); found != powers.end()) usual.merge(found->second);
  return usual;
}

/// Whether a quarter more of the queries that do not collide are reported than usually, and not by chance.
bool reports_more(const FactorCounts& counts, const FactorCounts& usual) {
  constexpr double more = 0.25;
  return false_positive_rate(counts) > false_positive_rate(usual) + more &&
         fisher_test({counts.false_positives, counts.others}, {usual.false_positives, usual.others}).more <
             improbable;
}

/// Whether chance may explain that all misses are outside of some of the collisions.
bool may_be_chance(std::uint64_t some, const FactorCounts& all) {
  if (all.false_negatives == 0) return false;
  return std::pow(1 - ratio(some, all.collisions), all.false_negatives) >= improbable;
}

RightRange range_of(const Powers& powers) {
  RightRange range;
  FactorCounts all, longest, run;
  int values = 0, most_values = 0, first = 0;
  const FactorCounts usual = usual_answers(powers);
  for (const auto& [x, counts] : powers) {
    all.merge(counts);
    if (counts.false_negatives > 0 || reports_more(counts, usual)) {
      values = 0;
      continue;
    }
    if (values++ == 0) {
      first = x;
      run = {};
    }
    run.merge(counts);
    if (values <= most_values) continue;
    most_values = values;
    longest = run;
    range.exponents = {first, x};
  }
  if (may_be_chance(longest.collisions, all)) {
    range.exponents.reset();
    longest = {};
  }
  for_each_counter<FactorCounts>([&](const auto& counter) {
    range.elsewhere.*counter.member = all.*counter.member - longest.*counter.member;
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

#include "reports/statistics/factor_counts.hpp"

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

void count_collision(FactorTable& table, const FactorKey& key, std::span<const std::string> values,
                     bool missed) {
  const FactorCounts one{1, missed ? std::uint64_t{1} : 0};
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

}  // namespace nearmiss

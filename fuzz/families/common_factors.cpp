#include "fuzz/families/common_factors.hpp"

#include <fmt/format.h>

namespace nearmiss::crossed {

void FactorCounts::add(const Levels& levels, bool missed) {
  const Count one{1, missed ? std::uint64_t{1} : 0};
  all_.add(one);
  for (std::size_t i = 0; i < factor_count; ++i)
    for (std::size_t j = i; j < factor_count; ++j)
      counts_[{Value{i, levels[i]}, Value{j, levels[j]}}].add(one);
}

void FactorCounts::merge(const FactorCounts& other) {
  all_.add(other.all_);
  for (const auto& [values, count] : other.counts_) counts_[values].add(count);
}

bool FactorCounts::is_better(const Count& a, const Count& b) {
  const auto lift = [](const Count& count) {
    return static_cast<double>(count.misses) / static_cast<double>(count.collisions);
  };
  return lift(a) > lift(b) || (lift(a) == lift(b) && a.misses > b.misses);
}

std::optional<CommonFactors> FactorCounts::common() const {
  if (all_.misses == 0) return std::nullopt;
  const auto* best = &*counts_.begin();
  bool found = false;
  // Single values first, so that a pair has to be better than them.
  for (const bool single : {true, false})
    for (const auto& each : counts_) {
      const auto& [values, count] = each;
      if ((values.first == values.second) != single || 2 * count.misses < all_.misses) continue;
      if (found && !is_better(count, best->second)) continue;
      best = &each;
      found = true;
    }
  if (!found) return std::nullopt;
  const auto text = [](const Value& value) {
    return fmt::format("{}={}", factors()[value.first].name, factors()[value.first].values[value.second]);
  };
  const auto& [values, count] = *best;
  const auto share = [](std::uint64_t part, std::uint64_t of) {
    return static_cast<double>(part) / static_cast<double>(of);
  };
  const std::string first = text(values.first);
  return CommonFactors{
      values.first == values.second ? first : fmt::format("{} {}", first, text(values.second)), count.misses,
      share(count.misses, all_.misses), share(count.collisions, all_.collisions)};
}

}  // namespace nearmiss::crossed

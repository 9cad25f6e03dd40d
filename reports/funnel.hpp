// What became of the pairs of a scene: which were left out, why, and which were asked.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <numeric>
#include <string>
#include <string_view>

#include "ccd/query.hpp"

namespace nearmiss {

struct Statistics;

/// What becomes of a pair. All but the last are left out: a subject is not asked.
enum class PairFate : std::uint8_t {
  boxes_apart,     ///< the boxes that the primitives sweep do not meet
  share_vertex,    ///< the primitives have a vertex in common
  at_rest,         ///< relative to each other: a static test decides
  in_translation,  ///< relative to each other: a linear test decides
  asked,
};

inline constexpr std::size_t pair_fate_count = 5;

/// Names of the fates, in their order; they stand in files.
inline constexpr std::array<std::string_view, pair_fate_count> pair_fate_names{
    "boxes_apart", "share_vertex", "at_rest", "in_translation", "asked"};

/// Pairs of one kind in one step of a scene.
struct Funnel {
  std::array<std::uint64_t, pair_fate_count> pairs{};  ///< by their fate
  std::uint64_t touching = 0;                          ///< of those at rest or in translation: they collide
  std::uint64_t finding_ns = 0;                        ///< time to find the pairs whose boxes meet
  std::uint64_t deciding_ns = 0;  ///< time to tell fates, and to decide those at rest or in translation

  [[nodiscard]] std::uint64_t all() const {
    return std::accumulate(pairs.begin(), pairs.end(), std::uint64_t{0});
  }
  std::uint64_t& operator[](PairFate fate) { return pairs[static_cast<std::size_t>(fate)]; }
  std::uint64_t operator[](PairFate fate) const { return pairs[static_cast<std::size_t>(fate)]; }
  void merge(const Funnel& other) {
    for (std::size_t i = 0; i < pair_fate_count; ++i) pairs[i] += other.pairs[i];
    touching += other.touching;
    finding_ns += other.finding_ns;
    deciding_ns += other.deciding_ns;
  }

  bool operator==(const Funnel&) const = default;
};

/// The scene of "scene:NAME#STEP": "scene:NAME".
std::string scene_of(const std::string& step);

/// A line for each fate, a column for each kind, over all steps of each scene; "" where there is none.
std::string funnel_tables(const Statistics& statistics);

/// By step and kind: all, the fates by their names, touching, finding_ns and deciding_ns.
nlohmann::ordered_json funnels_json(const Statistics& statistics);

}  // namespace nearmiss

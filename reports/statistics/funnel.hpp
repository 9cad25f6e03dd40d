// Counts the pairs of a scene: the pairs that were left out, for each reason, and the pairs about which
// subjects were asked.
#pragma once

#include <array>
#include <cstdint>
#include <numeric>
#include <string_view>
#include <tuple>

#include "reports/statistics/counter.hpp"

namespace nearmiss {

/// The fate of a pair. Subjects are asked only about pairs with the fate `asked`. For every other pair, the
/// fate says why the pair is left out.
enum class PairFate : std::uint8_t {
  boxes_apart,     ///< the swept boxes of the primitives do not meet
  share_vertex,    ///< the primitives have a vertex in common
  at_rest,         ///< the primitives are at rest relative to each other; a static test decides
  in_translation,  ///< the primitives are in translation relative to each other; a linear test decides
  asked,
};

inline constexpr std::size_t pair_fate_count = 5;

/// The names of the fates, as files write them, in the order of the enumeration.
inline constexpr std::array<std::string_view, pair_fate_count> pair_fate_names{
    "boxes_apart", "share_vertex", "at_rest", "in_translation", "asked"};

/// Counts the pairs of one kind in one step of a scene.
struct Funnel {
  std::array<std::uint64_t, pair_fate_count> pairs{};  ///< number of pairs with each PairFate
  std::uint64_t touching = 0;                          ///< pairs at rest or in translation that collide
  std::uint64_t finding_ns = 0;                        ///< time to find the pairs whose boxes meet
  /// Time to determine the fates of the pairs, and to decide pairs at rest or in translation.
  std::uint64_t deciding_ns = 0;

  static constexpr auto counters() {
    return std::tuple{NamedCounts<Funnel, pair_fate_count>{.name = "pairs",
                                                           .member = &Funnel::pairs,
                                                           .names = pair_fate_names,
                                                           .json_key = "",
                                                           .shows_zeros = true},
                      Counter{"touching", &Funnel::touching},
                      Counter{"finding_ns", &Funnel::finding_ns, "finding_ns", "times"},
                      Counter{"deciding_ns", &Funnel::deciding_ns, "deciding_ns", "times"}};
  }

  [[nodiscard]] std::uint64_t all() const {
    return std::accumulate(pairs.begin(), pairs.end(), std::uint64_t{0});
  }
  std::uint64_t& operator[](PairFate fate) { return pairs[static_cast<std::size_t>(fate)]; }
  std::uint64_t operator[](PairFate fate) const { return pairs[static_cast<std::size_t>(fate)]; }
  void merge(const Funnel& other) { merge_counters(*this, other); }

  bool operator==(const Funnel&) const = default;
};
static_assert(declares_all_members<Funnel>());

}  // namespace nearmiss

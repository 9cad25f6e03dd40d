#include "fuzz/scenes/pair_sample.hpp"

#include <algorithm>

namespace nearmiss {

const Query& drawn(Random& random, const PairsByKind& pairs, Kind kind) {
  const auto& all = pairs.at(kind);
  return all[static_cast<std::size_t>(random.integer(0, static_cast<int>(all.size()) - 1))];
}

void PairSample::add(const MovingMesh& motion, const Candidate& pair, std::uint64_t number_of_motion) {
  const auto vertex = [&](std::size_t i) { return static_cast<std::uint64_t>(pair.vertices[i]); };
  Random random(number_of_motion << 32 | vertex(0), vertex(1), vertex(2) << 32 | vertex(3));
  const std::uint64_t number = random.bits();
  auto& kept = kept_[pair.kind];
  if (kept.size() == most_) {
    if (number > kept.front().number) return;
    std::pop_heap(kept.begin(), kept.end());
    kept.pop_back();
  }
  kept.push_back({number, make_query(motion, pair)});
  std::push_heap(kept.begin(), kept.end());
}

PairsByKind PairSample::pairs() && {
  PairsByKind made;
  for (auto& [kind, kept] : kept_) {
    std::sort_heap(kept.begin(), kept.end());
    for (const Kept& each : kept) made[kind].push_back(each.query);
  }
  return made;
}

}  // namespace nearmiss

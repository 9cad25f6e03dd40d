// The sign of (distance - h), where h is the separation, only changes at the times of Nearness::candidates().
// So the sign is constant between two neighbouring candidates, and the distance falls below h at the first
// candidate after which the sign is -1.
#include "oracle/exact/first_approach.hpp"

#include <algorithm>
#include <vector>

#include "oracle/exact/nearness.hpp"

namespace nearmiss::exact {

namespace {

/// Sorts times and removes duplicates.
void sort_out(std::vector<Root>& times) {
  // std::sort cannot be used, because a comparison of two times may refine, and so change, both of them.
  std::vector<Root> sorted;
  for (Root& each : times) {
    const auto place =
        std::find_if(sorted.begin(), sorted.end(), [&](Root& other) { return !other.is_below(each); });
    if (place == sorted.end() || each.is_below(*place)) sorted.insert(place, std::move(each));
  }
  times = std::move(sorted);
}

/// A number between two different times. `first` must be the earlier one.
Number between(Root& first, Root& second) {
  while (true) {
    const Number middle = Number(0.5) * (first.hi() + second.lo());
    if (first.hi() <= second.lo() && !first.is(middle) && !second.is(middle)) return middle;
    (first.hi() - first.lo() < second.hi() - second.lo() ? second : first).refine();
  }
}

}  // namespace

std::optional<FirstApproach> first_approach(const Query& query) {
  const Nearness nearness(query, query.separation);
  std::vector<Root> times = nearness.candidates();
  sort_out(times);
  std::optional<FirstApproach> approach;
  for (std::size_t i = 0; i < times.size(); ++i) {
    Root& time = times[i];
    if (!approach && nearness.holds_at(time)) approach = FirstApproach{time, std::nullopt};
    Root end{Number(1)};
    Root& next = i + 1 < times.size() ? times[i + 1] : end;
    if (!approach || !time.is_below(next)) continue;  // before the approach, the distance is above h
    Root after{between(time, next)};
    if (!nearness.holds_strictly_at(after)) continue;
    approach->below = time;
    break;
  }
  return approach;
}

}  // namespace nearmiss::exact

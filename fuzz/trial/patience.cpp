#include "fuzz/trial/patience.hpp"

#include <algorithm>
#include <iterator>

namespace nearmiss {

void Patience::know(const Statistics& before) {
  for (const auto& [key, counts] : before.counts)
    settled_[key] += counts.faults[static_cast<std::size_t>(Fault::time)];
}

bool Patience::asks(const CountsKey& key, std::uint64_t number) const {
  const std::lock_guard lock(mutex_);
  std::uint64_t late = 0;
  if (const auto settled = settled_.find(key); settled != settled_.end()) late += settled->second;
  if (const auto others = on_their_way_.find(key); others != on_their_way_.end())
    late +=
        static_cast<std::uint64_t>(std::distance(others->second.begin(), others->second.lower_bound(number)));
  return late < most_late;
}

void Patience::ask(Trial& trial, std::uint64_t number) {
  trial.ask([&](std::size_t s) { return asks(trial.key(s), number); });
  for (std::size_t s = 0; s < trial.subjects(); ++s)
    for (const Verdict& answer : trial.answers(s))
      if (answer.fault == Fault::time) {
        const std::lock_guard lock(mutex_);
        on_their_way_[trial.key(s)].insert(number);
      }
}

bool Patience::settle(Trial& trial, std::uint64_t number) {
  bool has_changed = false;
  for (std::size_t s = 0; s < trial.subjects(); ++s) {
    const std::lock_guard lock(mutex_);
    const CountsKey key = trial.key(s);
    std::uint64_t& late = settled_[key];
    for (Verdict& answer : trial.answers(s)) {
      if (late < most_late) {
        late += answer.fault == Fault::time ? 1 : 0;
      } else if (answer.fault != Fault::not_asked && answer.fault != Fault::contract) {
        answer = {.fault = Fault::not_asked};
        has_changed = true;
      }
    }
    if (const auto others = on_their_way_.find(key); others != on_their_way_.end())
      others->second.erase(number);
  }
  return has_changed;
}

}  // namespace nearmiss

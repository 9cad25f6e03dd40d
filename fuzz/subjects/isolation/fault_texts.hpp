// The texts of faults.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

namespace nearmiss {

/// Keeps the messages of exceptions, and the reasons why a plug-in could not be loaded, and gives each text a
/// number that fits into a verdict. Many threads may use a FaultTexts at once.
class FaultTexts {
 public:
  /// The number of a text. Texts beyond the first 999 share the last number.
  std::int32_t number(const std::string& text) {
    const std::lock_guard lock(mutex_);
    const auto place =
        static_cast<std::size_t>(std::find(texts_.begin(), texts_.end(), text) - texts_.begin());
    if (place == texts_.size() && place < most)
      texts_.push_back(place + 1 < most ? text : "one of more than a thousand texts");
    return static_cast<std::int32_t>(std::min(place, texts_.size() - 1));
  }

  [[nodiscard]] std::string text(std::int32_t number) const {
    const std::lock_guard lock(mutex_);
    return texts_.at(static_cast<std::size_t>(number));
  }

 private:
  static constexpr std::size_t most = 1000;
  mutable std::mutex mutex_;
  std::vector<std::string> texts_;
};

}  // namespace nearmiss

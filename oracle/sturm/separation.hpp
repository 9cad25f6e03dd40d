// The second exact method for queries with a separation h > 0.
#pragma once

#include <memory>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// How near two primitives come in a part of the step. The answers are exact for every finite query with
/// h > 0, and found without the code of the first method: roots are isolated by Sturm's theorem, `SturmRoot`
/// gives signs at them, and derivatives give signs right after them. Roots are isolated when a question needs
/// them, and kept for the next question.
class SturmApproach {
 public:
  explicit SturmApproach(const Query& query);
  ~SturmApproach();
  SturmApproach(const SturmApproach&) = delete;
  SturmApproach& operator=(const SturmApproach&) = delete;

  static constexpr double step_is_over = 2;  ///< a time after all of [0, 1]

  /// Whether the distance is at most h at some t in [0, 1] with t < time.
  bool is_at_most_before(double time);
  /// Whether the distance is less than h at some t in [0, 1] with t < time.
  bool is_below_before(double time);

 private:
  struct Pairs;
  std::unique_ptr<Pairs> pairs_;
};

}  // namespace nearmiss

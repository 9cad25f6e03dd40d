// The second opinion on the earliest time.
#pragma once

#include <optional>

#include "oracle/sturm/separation.hpp"
#include "oracle/sturm/sturm.hpp"

namespace nearmiss {

/// Answers the questions of EarliestTime by the second exact method, also for primitives that never touch or
/// come within h.
class SturmTimes {
 public:
  explicit SturmTimes(const Query& query) {
    if (query.separation > 0)
      approach_.emplace(query);
    else
      contact_.emplace(query);
  }

  bool is_before(double time) {
    return contact_ ? contact_->is_before(time) : approach_->is_at_most_before(time);
  }
  bool makes_late(double time) {
    return contact_ ? contact_->is_before(time) : approach_->is_below_before(time);
  }

 private:
  std::optional<SturmContact> contact_;
  std::optional<SturmApproach> approach_;
};

}  // namespace nearmiss

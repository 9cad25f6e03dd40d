// Subjects whose properties a detector states.
#pragma once

#include <string>
#include <utility>

#include "ccd/subjects/batch_subject.hpp"
#include "ccd/subjects/detector.hpp"

namespace nearmiss {

/// A subject with the properties that a detector states in its nearmiss_subject.
class DescribedSubject : public BatchSubject {
 public:
  explicit DescribedSubject(DetectorInfo info) : BatchSubject(info.name), info_(std::move(info)) {}

  [[nodiscard]] const DetectorInfo& info() const { return info_; }
  [[nodiscard]] bool claims_bound() const final { return info_.claims_bound; }
  [[nodiscard]] bool decides(Kind kind) const final { return nearmiss::decides(info_, kind); }
  [[nodiscard]] bool takes_separation(Kind kind) const final {
    return nearmiss::takes_separation(info_, kind);
  }
  [[nodiscard]] bool gives_distance(Kind kind) const final { return nearmiss::gives_distance(info_, kind); }
  [[nodiscard]] bool filters_step(Kind kind) const final { return nearmiss::filters_step(info_, kind); }
  [[nodiscard]] TimeSort time_sort() const final { return info_.time_sort; }
  [[nodiscard]] Contract contract() const final { return info_.contract; }
  [[nodiscard]] bool rounds() const final { return info_.is_narrow; }
  [[nodiscard]] Query rounded(const Query& query) const final { return rounded_for(info_, query); }
  [[nodiscard]] double distance_bound(const Query& query) const final {
    return ask_bound(query).bound_or_nan();
  }
  [[nodiscard]] BoundAnswer ask_bound(const Query& query) const override = 0;

 private:
  DetectorInfo info_;
};

}  // namespace nearmiss

// A subject that passes all questions on to another subject.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>

#include "ccd/subjects/batch_subject.hpp"

namespace nearmiss {

/// Passes all questions on to another subject, which must outlive this object. A derived class that changes
/// how that subject is asked overrides three functions, because none of them calls another: decide() for
/// batches, which also decides single queries; decide_timed(); and time_each().
class ForwardingSubject : public BatchSubject {
 public:
  ForwardingSubject(std::string name, const Subject& to) : BatchSubject(std::move(name)), to_(to) {}

  [[nodiscard]] const Subject& to() const { return to_; }

  using BatchSubject::decide;
  void decide(std::span<const Query> queries, std::span<Verdict> verdicts) const override {
    to_.decide(queries, verdicts);
  }
  BatchTime decide_timed(std::span<const Query> queries, std::span<Verdict> verdicts) const override {
    return to_.decide_timed(queries, verdicts);
  }
  void time_each(std::span<const Query> queries,
                 std::span<std::optional<std::uint64_t>> nanoseconds) const override {
    to_.time_each(queries, nanoseconds);
  }
  [[nodiscard]] double distance_bound(const Query& query) const override { return to_.distance_bound(query); }
  [[nodiscard]] BoundAnswer ask_bound(const Query& query) const override { return to_.ask_bound(query); }
  void ask_bounds(std::span<const Query> queries, std::span<BoundAnswer> bounds) const override {
    to_.ask_bounds(queries, bounds);
  }
  [[nodiscard]] bool claims_bound() const override { return to_.claims_bound(); }
  [[nodiscard]] bool gives_distance(Kind kind) const override { return to_.gives_distance(kind); }
  [[nodiscard]] DistanceAnswer ask_distance(const Query& query) const override {
    return to_.ask_distance(query);
  }
  [[nodiscard]] bool filters_step(Kind kind) const override { return to_.filters_step(kind); }
  [[nodiscard]] StepAnswer ask_step(const Query& query) const override { return to_.ask_step(query); }
  [[nodiscard]] bool decides(Kind kind) const override { return to_.decides(kind); }
  [[nodiscard]] bool takes_separation(Kind kind) const override { return to_.takes_separation(kind); }
  [[nodiscard]] TimeSort time_sort() const override { return to_.time_sort(); }
  [[nodiscard]] Contract contract() const override { return to_.contract(); }
  [[nodiscard]] bool rounds() const override { return to_.rounds(); }
  [[nodiscard]] Query rounded(const Query& query) const override { return to_.rounded(query); }
  [[nodiscard]] std::string fault_text(const Verdict& verdict) const override {
    return to_.fault_text(verdict);
  }
  [[nodiscard]] std::string fault_errors(const Verdict& verdict) const override {
    return to_.fault_errors(verdict);
  }
  [[nodiscard]] double needed_tolerance(const Query& query) const override {
    return to_.needed_tolerance(query);
  }

 private:
  const Subject& to_;
};

/// The subject at the end of a chain of forwarding subjects; `subject` itself if `subject` is not a
/// forwarding subject.
inline const Subject& innermost(const Subject& subject) {
  const auto* const forwarding = dynamic_cast<const ForwardingSubject*>(&subject);
  return forwarding == nullptr ? subject : innermost(forwarding->to());
}

}  // namespace nearmiss

// Subjects whose answers a test makes up.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "fuzz/subjects/forwarding_subject.hpp"

namespace nearmiss::testing {

struct Claims {
  double bound = 0;
  bool claims_bound = true;
  TimeSort time_sort = TimeSort::none;
  bool takes_separation = false;
  Contract contract = {};
  bool rounds = false;  ///< whether the subject rounds coordinates to float
};

class MadeUpSubject final : public Subject {
 public:
  using Answer = std::function<Verdict(const Query&)>;

  MadeUpSubject(std::string name, Answer answer, const Claims& claims = {})
      : name_(std::move(name)), answer_(std::move(answer)), claims_(claims) {}

  using Subject::decide;
  [[nodiscard]] Verdict decide(const Query& query) const override { return answer_(query); }
  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] double distance_bound(const Query& /*query*/) const override { return claims_.bound; }
  [[nodiscard]] bool claims_bound() const override { return claims_.claims_bound; }
  [[nodiscard]] TimeSort time_sort() const override { return claims_.time_sort; }
  [[nodiscard]] bool takes_separation(Kind /*kind*/) const override { return claims_.takes_separation; }
  [[nodiscard]] Contract contract() const override { return claims_.contract; }
  [[nodiscard]] bool rounds() const override { return claims_.rounds; }
  [[nodiscard]] Query rounded(const Query& query) const override {
    Query result = query;
    if (claims_.rounds)
      for (double& x : result.x) x = static_cast<float>(x);
    return result;
  }

 private:
  std::string name_;
  Answer answer_;
  Claims claims_;
};

/// Passes queries on to another subject, which must outlive this one. Then calls `watch` with each batch and
/// its answers, which `watch` may change.
class WatchedSubject final : public ForwardingSubject {
 public:
  using Watch = std::function<void(std::span<const Query>, std::span<Verdict>)>;

  WatchedSubject(const Subject& to, Watch watch)
      : ForwardingSubject(to.name(), to), watch_(std::move(watch)) {}

  using ForwardingSubject::decide;
  void decide(std::span<const Query> queries, std::span<Verdict> verdicts) const override {
    ForwardingSubject::decide(queries, verdicts);
    watch_(queries, verdicts);
  }

 private:
  Watch watch_;
};

}  // namespace nearmiss::testing

#include "oracle/subjects.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "oracle/filter/filter.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {

namespace {

constexpr std::array infos{
    SubjectInfo{"exact", "the oracle itself: the certified filter, then exact arithmetic"},
    SubjectInfo{"exact-scalar", "the same, one query at a time"},
};

/// The oracle as a subject. It omits the box test, because subjects only get pairs whose boxes meet.
class ExactSubject : public Subject {
 public:
  explicit ExactSubject(std::string_view name) : name_(name) {}

  [[nodiscard]] const std::string& name() const override { return name_; }

  using Subject::decide;
  [[nodiscard]] Verdict decide(const Query& query) const override { return verdict(query, filter(query)); }

  [[nodiscard]] double distance_bound(const Query& /*query*/) const override { return 0; }

 protected:
  static Verdict verdict(const Query& query, FilterStage stage) {
    if (stage == FilterStage::undecided && !is_finite(query)) refuse_coordinates(infos[0].name);
    const bool hit = settle(query, stage);
    const bool filtered = stage != FilterStage::undecided;
    if (!hit) return Verdict::rejected(filtered ? Rejection::filter : Rejection::exact);
    return {.hit = true, .stage = filtered ? Stage::filter : Stage::exact};
  }

 private:
  std::string name_;
};

/// The same, but decides many queries side by side.
class BatchedExactSubject final : public ExactSubject {
 public:
  using ExactSubject::ExactSubject;

  using ExactSubject::decide;
  void decide(std::span<const Query> queries, std::span<Verdict> verdicts) const override {
    std::array<FilterStage, 256> stages;
    for (std::size_t first = 0; first < queries.size(); first += stages.size()) {
      const auto some = queries.subspan(first, std::min(stages.size(), queries.size() - first));
      filter(some, stages);
      for (std::size_t i = 0; i < some.size(); ++i) verdicts[first + i] = verdict(some[i], stages[i]);
    }
  }
};

}  // namespace

std::span<const SubjectInfo> exact_subjects() { return infos; }

std::unique_ptr<Subject> try_make_exact(std::string_view name) {
  if (name == infos[0].name) return std::make_unique<BatchedExactSubject>(name);
  if (name == infos[1].name) return std::make_unique<ExactSubject>(name);
  return nullptr;
}

}  // namespace nearmiss

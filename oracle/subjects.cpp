#include "oracle/subjects.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "ccd/error.hpp"
#include "oracle/filter.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {

namespace {

/// The oracle as a subject, but for the swept boxes: a subject is asked where they meet.
class Exact : public Subject {
 public:
  explicit Exact(std::string_view name) : name_(name) {}

  [[nodiscard]] const std::string& name() const override { return name_; }

  using Subject::decide;
  [[nodiscard]] Verdict decide(const Query& query) const override { return verdict(query, filter(query)); }

  [[nodiscard]] double distance_bound(const Query& /*query*/) const override { return 0; }

 protected:
  static Verdict verdict(const Query& query, FilterStage stage) {
    if (stage == FilterStage::undecided && !is_finite(query))
      throw Error("exact: found a coordinate that is not finite, expected 24 finite numbers");
    const bool hit = settle(query, stage);
    return {.hit = hit, .stage = hit ? Stage::unspecified : Stage::none};
  }

 private:
  std::string name_;
};

/// The same, with many queries side by side where many are given.
class ExactBatch final : public Exact {
 public:
  using Exact::Exact;

  using Exact::decide;
  void decide(std::span<const Query> queries, std::span<Verdict> verdicts) const override {
    std::array<FilterStage, 256> stages;
    for (std::size_t first = 0; first < queries.size(); first += stages.size()) {
      const auto some = queries.subspan(first, std::min(stages.size(), queries.size() - first));
      filter(some, stages);
      for (std::size_t i = 0; i < some.size(); ++i) verdicts[first + i] = verdict(some[i], stages[i]);
    }
  }
};

constexpr SubjectInfo batch_info{"exact",
                                 "the oracle itself: certified filter, exact arithmetic for what it leaves"};
constexpr SubjectInfo scalar_info{"exact-scalar", "the same, one query at a time"};

}  // namespace

std::vector<SubjectInfo> all_subjects() {
  auto infos = subjects();
  infos.push_back(batch_info);
  infos.push_back(scalar_info);
  return infos;
}

std::unique_ptr<Subject> make_any_subject(std::string_view name_or_path, std::optional<double> given_bound) {
  if (name_or_path == batch_info.name) return std::make_unique<ExactBatch>(name_or_path);
  if (name_or_path == scalar_info.name) return std::make_unique<Exact>(name_or_path);
  auto subject = try_make_subject(name_or_path, given_bound);
  if (!subject) refuse_subject(name_or_path, all_subjects());
  return subject;
}

}  // namespace nearmiss

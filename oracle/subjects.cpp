#include "oracle/subjects.hpp"

#include <string>

#include "ccd/error.hpp"
#include "oracle/filter.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {

namespace {

class Exact final : public Subject {
 public:
  [[nodiscard]] const std::string& name() const override { return name_; }

  using Subject::decide;
  [[nodiscard]] Verdict decide(const Query& query) const override {
    if (!is_finite(query))
      throw Error("exact: found a coordinate that is not finite, expected 24 finite numbers");
    const FilterStage stage = filter(query);
    const bool hit = stage == FilterStage::undecided ? collides_exactly(query) : is_collision(stage);
    return {.hit = hit, .stage = hit ? Stage::unspecified : Stage::none};
  }

  [[nodiscard]] double distance_bound(const Query& /*query*/) const override { return 0; }

 private:
  std::string name_ = "exact";
};

constexpr SubjectInfo exact_info{"exact",
                                 "the oracle itself: certified filter, exact arithmetic for what it leaves"};

}  // namespace

std::vector<SubjectInfo> all_subjects() {
  auto infos = subjects();
  infos.push_back(exact_info);
  return infos;
}

std::unique_ptr<Subject> make_any_subject(std::string_view name_or_path, std::optional<double> given_bound) {
  if (name_or_path == exact_info.name) return std::make_unique<Exact>();
  auto subject = try_make_subject(name_or_path, given_bound);
  if (!subject) refuse_subject(name_or_path, all_subjects());
  return subject;
}

}  // namespace nearmiss

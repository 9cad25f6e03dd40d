#include "fuzz/subjects/ladder/adaptive.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "ccd/subjects/batch_subject.hpp"
#include "fuzz/subjects/ladder/scalars.hpp"
#include "oracle/filter/filter.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {

namespace {

class Adaptive final : public BatchSubject {
 public:
  Adaptive()
      : BatchSubject(std::string(adaptive_info.name)),
        wang_(make_subject("wang")),
        finer_(try_make_scaled("wang:dd", std::nullopt)) {}

  using BatchSubject::decide;
  void decide(std::span<const Query> queries, std::span<Verdict> verdicts) const override {
    for (std::size_t first = 0; first < queries.size(); first += at_once)
      decide_some(queries.subspan(first, std::min(at_once, queries.size() - first)), verdicts.subspan(first));
  }

  [[nodiscard]] double distance_bound(const Query& /*query*/) const override { return 0; }

 private:
  static constexpr std::size_t at_once = 256;

  void decide_some(std::span<const Query> queries, std::span<Verdict> verdicts) const {
    wang_->decide(queries, verdicts.first(queries.size()));
    std::array<std::size_t, at_once> reported;
    std::size_t count = 0;
    for (std::size_t i = 0; i < queries.size(); ++i)
      if (verdicts[i].hit) reported[count++] = i;
    if (count == 0) return;
    // `again` is a vector, because it takes longer to make an array of `at_once` queries than to run wang.
    std::vector<Query> again;
    again.reserve(count);
    for (std::size_t i = 0; i < count; ++i) again.push_back(queries[reported[i]]);
    std::array<FilterStage, at_once> stages;
    filter(again, stages);
    for (std::size_t i = 0; i < count; ++i) {
      Verdict& verdict = verdicts[reported[i]];
      verdict = decide_again(again[i], stages[i], verdict.time);
    }
  }

  [[nodiscard]] Verdict decide_again(const Query& query, FilterStage stage, double time) const {
    if (stage != FilterStage::undecided)
      return is_collision(stage) ? Verdict::accepted(Stage::filter, time)
                                 : Verdict::rejected(Rejection::filter);
    if (!finer_->decide(query).hit) return Verdict::rejected(Rejection::finer);
    return settle(query, stage).collision ? Verdict::accepted(Stage::exact, time)
                                          : Verdict::rejected(Rejection::exact);
  }

  std::unique_ptr<Subject> wang_, finer_;
};

}  // namespace

std::unique_ptr<Subject> try_make_adaptive(std::string_view name) {
  return name == adaptive_info.name ? std::make_unique<Adaptive>() : nullptr;
}

}  // namespace nearmiss

#include "fuzz/subjects/contracted.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <span>

#include "fuzz/subjects/forwarding_subject.hpp"
#include "reports/statistics/failure.hpp"

namespace nearmiss {

namespace {

constexpr Verdict not_asked{.fault = Fault::contract};

/// A subject that is asked only queries that keep its contract, or only queries that break it.
class Contracted final : public ForwardingSubject {
 public:
  Contracted(std::shared_ptr<const Subject> subject, bool keeps)
      : ForwardingSubject(subject->name() + std::string(keeps ? "" : beyond_contract), *subject),
        subject_(std::move(subject)),
        keeps_(keeps) {}

  using ForwardingSubject::decide;
  void decide(std::span<const Query> queries, std::span<Verdict> verdicts) const override {
    const Part part = asked(queries);
    std::vector<Verdict> answers(part.queries.size());
    subject_->decide(part.queries, answers);
    part.spread(answers, verdicts, not_asked);
  }
  BatchTime decide_timed(std::span<const Query> queries, std::span<Verdict> verdicts) const override {
    const Part part = asked(queries);
    std::vector<Verdict> answers(part.queries.size());
    const BatchTime time = part.queries.empty() ? BatchTime{} : subject_->decide_timed(part.queries, answers);
    part.spread(answers, verdicts, not_asked);
    return time;
  }
  void time_each(std::span<const Query> queries,
                 std::span<std::optional<std::uint64_t>> nanoseconds) const override {
    const Part part = asked(queries);
    std::vector<std::optional<std::uint64_t>> times(part.queries.size());
    subject_->time_each(part.queries, times);
    part.spread(times, nanoseconds, std::optional<std::uint64_t>());
  }

  [[nodiscard]] DistanceAnswer ask_distance(const Query& query) const override {
    return asks(query) ? subject_->ask_distance(query) : DistanceAnswer{.fault = Fault::contract};
  }

  [[nodiscard]] StepAnswer ask_step(const Query& query) const override {
    return asks(query) ? subject_->ask_step(query) : StepAnswer{.fault = Fault::contract};
  }

  [[nodiscard]] double needed_tolerance(const Query& query) const override {
    return asks(query) ? subject_->needed_tolerance(query) : ForwardingSubject::needed_tolerance(query);
  }

 private:
  /// The part of a batch that the subject is asked.
  struct Part {
    std::vector<std::size_t> places;  ///< in the batch
    std::vector<Query> queries;

    /// Sets each all[places[i]] to own[i], and all other elements of `all` to `other`.
    template <class Each>
    void spread(const std::vector<Each>& own, std::span<Each> all, const Each& other) const {
      std::fill(all.begin(), all.end(), other);
      for (std::size_t i = 0; i < own.size(); ++i) all[places[i]] = own[i];
    }
  };

  /// Whether the subject is asked this query. The contract is tested on the query as the subject rounds it.
  [[nodiscard]] bool asks(const Query& query) const {
    return keeps_contract(subject_->rounded(query), subject_->contract()) == keeps_;
  }

  [[nodiscard]] Part asked(std::span<const Query> queries) const {
    Part part;
    for (std::size_t i = 0; i < queries.size(); ++i) {
      if (!asks(queries[i])) continue;
      part.places.push_back(i);
      part.queries.push_back(queries[i]);
    }
    return part;
  }

  std::shared_ptr<const Subject> subject_;
  bool keeps_;
};

}  // namespace

std::vector<std::unique_ptr<Subject>> keep_contract(std::unique_ptr<Subject> subject, bool asks_beyond) {
  std::vector<std::unique_ptr<Subject>> made;
  if (subject->contract() == Contract{}) {
    made.push_back(std::move(subject));
    return made;
  }
  const std::shared_ptr<const Subject> shared = std::move(subject);
  made.push_back(std::make_unique<Contracted>(shared, true));
  if (asks_beyond) made.push_back(std::make_unique<Contracted>(shared, false));
  return made;
}

std::string in_words(const Contract& contract) {
  std::vector<std::string> terms;
  if (contract.apart_at_start)
    terms.push_back(contract.apart_by == 0
                        ? "the primitives are apart at t = 0"
                        : fmt::format("the distance at t = 0 is more than {}", contract.apart_by));
  if (contract.one_root) terms.emplace_back("the vertices' volume has one root at most, a simple one");
  if (contract.grid != 0) terms.push_back(fmt::format("coordinates are multiples of {}", contract.grid));
  if (contract.shortest != 0) terms.push_back(fmt::format("edges are at least {} long", contract.shortest));
  if (contract.longest != 0)
    terms.push_back(fmt::format("edges and paths are at most {} long", contract.longest));
  return fmt::format("{}", fmt::join(terms, "; "));
}

}  // namespace nearmiss

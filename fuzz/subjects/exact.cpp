#include "fuzz/subjects/exact.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "fuzz/subjects/forwarding_subject.hpp"
#include "oracle/filter/filter.hpp"
#include "oracle/oracle.hpp"
#include "oracle/parity/parity.hpp"
#include "oracle/within_separation.hpp"

namespace nearmiss {

namespace {

struct Entry {
  SubjectInfo info;
  bool is_batched, is_timed;
};

constexpr std::array entries{
    Entry{{"exact", "the oracle itself, with the time: the certified filter, then exact arithmetic"},
          true,
          true},
    Entry{{"exact-scalar", "the same, one query at a time"}, false, true},
    Entry{{"exact-decision", "the same as exact, without the time"}, true, false},
};

/// The oracle as a subject. For a single query, this subject omits the box test, because a simulation makes
/// this test before it asks a CCD.
class ExactSubject final : public Subject {
 public:
  explicit ExactSubject(const Entry& entry) : entry_(entry), name_(entry.info.name) {}

  [[nodiscard]] const std::string& name() const override { return name_; }

  [[nodiscard]] Verdict decide(const Query& query) const override {
    if (query.separation > 0) return verdict(query, filter_with_separation(query), unknown_time);
    if (!entry_.is_timed) return verdict(query, filter(query), unknown_time);
    KnownTime time;
    const FilterStage stage = filter_for_time(query, time);
    return verdict(query, stage, time);
  }

  void decide(std::span<const Query> queries, std::span<Verdict> verdicts) const override {
    const bool any_separation =
        std::any_of(queries.begin(), queries.end(), [](const Query& query) { return query.separation > 0; });
    if (any_separation || !entry_.is_batched) {
      Subject::decide(queries, verdicts);
      return;
    }
    constexpr std::size_t at_once = 256;
    std::array<FilterStage, at_once> stages;
    std::array<KnownTime, at_once> times;
    for (std::size_t first = 0; first < queries.size(); first += at_once) {
      const auto some = queries.subspan(first, std::min(at_once, queries.size() - first));
      if (entry_.is_timed)
        filter_for_times(QueryRows(some), stages, times);
      else
        filter(some, stages);
      for (std::size_t i = 0; i < some.size(); ++i)
        verdicts[first + i] = verdict(some[i], stages[i], times[i]);
    }
  }

  [[nodiscard]] double distance_bound(const Query& /*query*/) const override { return 0; }
  [[nodiscard]] bool decides(Kind /*kind*/) const override { return true; }
  [[nodiscard]] bool takes_separation(Kind /*kind*/) const override { return true; }
  [[nodiscard]] TimeSort time_sort() const override {
    return entry_.is_timed ? TimeSort::lower_bound : TimeSort::none;
  }

 private:
  static constexpr KnownTime unknown_time{{0, 1}};

  /// The verdict on a query, made from the stage at which the filter decided the query and the time that the
  /// filter found. If the smallest distance is exactly the separation, the verdict is a collision.
  [[nodiscard]] Verdict verdict(const Query& query, FilterStage stage, const KnownTime& time) const {
    if (stage == FilterStage::undecided && !is_finite(query)) refuse_coordinates(name_);
    const bool filtered = stage != FilterStage::undecided;
    if (filtered && !is_collision(stage)) return Verdict::rejected(Rejection::filter);
    const Decision decision = settle(query, stage);
    if (!decision.collision && !decision.is_tie) return Verdict::rejected(Rejection::exact);
    Verdict hit{.hit = true, .stage = filtered ? Stage::filter : Stage::exact};
    if (entry_.is_timed)
      hit.time = time.is_known_to(0) ? time.time.lo : EarliestTime(query, decision.known).enclosure().lo;
    return hit;
  }

  Entry entry_;
  std::string name_;
};

class ParitySubject final : public Subject {
 public:
  [[nodiscard]] const std::string& name() const override { return name_; }

  [[nodiscard]] Verdict decide(const Query& query) const override {
    const PlainArithmetic guard;
    if (!is_finite(query)) refuse_coordinates(name_);
    if (!root_parity(query).collision()) return Verdict::rejected(Rejection::exact);
    return {.hit = true, .stage = Stage::exact};
  }

  [[nodiscard]] double distance_bound(const Query& /*query*/) const override { return 0; }
  [[nodiscard]] Contract contract() const override { return {.one_root = true}; }

 private:
  std::string name_{parity_info.name};
};

}  // namespace

std::span<const SubjectInfo> exact_subjects() {
  static const auto infos = [] {
    std::array<SubjectInfo, entries.size()> all;
    std::transform(entries.begin(), entries.end(), all.begin(),
                   [](const Entry& entry) { return entry.info; });
    return all;
  }();
  return infos;
}

std::vector<Kind> kinds_to_ask(std::span<const std::unique_ptr<Subject>> subjects,
                               const std::function<bool(Kind)>& has_separations) {
  const auto decides = [&](const Subject& subject, Kind kind) {
    return dynamic_cast<const ExactSubject*>(&innermost(subject)) == nullptr &&
           subject.is_asked(kind, has_separations(kind));
  };
  std::vector<Kind> asked;
  for (const Kind kind : kinds)
    if (std::ranges::any_of(subjects, [&](const auto& each) { return decides(*each, kind); }))
      asked.push_back(kind);
  return asked.empty() ? std::vector<Kind>(kinds_of_meshes.begin(), kinds_of_meshes.end()) : asked;
}

std::unique_ptr<Subject> try_make_exact(std::string_view name) {
  if (name == parity_info.name) return std::make_unique<ParitySubject>();
  const auto entry =
      std::find_if(entries.begin(), entries.end(), [&](const Entry& each) { return each.info.name == name; });
  return entry == entries.end() ? nullptr : std::make_unique<ExactSubject>(*entry);
}

}  // namespace nearmiss

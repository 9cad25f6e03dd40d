// Trials that ask two questions other than whether primitives collide: the distance of primitives at rest
// (distance.hpp), and the step that a filter permits (step.hpp).
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <ranges>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "fuzz/families/classify.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/parallel.hpp"
#include "fuzz/stop.hpp"
#include "fuzz/trial/sample.hpp"
#include "fuzz/trial/shrink.hpp"
#include "fuzz/trial/trial.hpp"
#include "reports/statistics/factor_counts.hpp"
#include "reports/statistics/query_class.hpp"

namespace nearmiss {

/// A query on which a subject fails.
struct QuestionFinding {
  std::string_view what;  ///< the failure, such as "over-reported"
  std::string subject;
  std::string signature;  ///< the way to fail, such as "ee edge-edge"
  QueryClass query_class{};
  std::string provenance;        ///< "family:seed:index" of the query before shrinking
  Query query;                   ///< the query after shrinking, rounded as the subject rounds it
  std::string answer;            ///< the numbers that the subject gave, exactly
  std::string text;              ///< what is wrong with the subject's answer, in words
  std::string certificate = {};  ///< a text that proves the failure; "" for a fault or wrong weights
};

/// The results of a trial. `Question` is DistanceQuestion or StepQuestion: it defines what is asked, and how
/// answers are judged and counted.
template <class Question>
struct QuestionResults {
  std::map<std::pair<std::string, Kind>, typename Question::Counts> counts;  ///< by subject and kind
  /// Answers by the value of a factor (a property that a family varies, such as the angle). In this table,
  /// every answer counts as a collision, and an unsafe answer as a missed collision.
  FactorTable factors;
  /// The findings without repetitions (see take()); findings of ordinary queries come first.
  std::vector<QuestionFinding> findings;

  void merge(QuestionResults&& other) {
    for (const auto& [key, each] : other.counts) counts[key].merge(each);
    for (const auto& [key, each] : other.factors) factors[key].merge(each);
    std::ranges::move(other.findings, std::back_inserter(findings));
  }
  /// Whether a subject fails on a query, or no query was asked at all.
  [[nodiscard]] bool has_failed() const {
    return counts.empty() ||
           std::ranges::any_of(counts, [](const auto& each) { return each.second.failures() > 0; });
  }
};

struct QuestionPlan {
  std::vector<Family> families = {};
  std::set<Kind> kinds = {};
  bool search = true;       ///< whether to add directed search against each subject
  std::uint64_t cases = 0;  ///< approximate number of queries; 0: no limit
  std::uint64_t seed = 1;
  int jobs = 1;
};

/// How long findings may still be shrunk after the time limit has passed.
inline constexpr std::chrono::seconds question_grace(5);

/// Puts subjects on trial. In each round, asks the subjects about some queries of every family. At the end,
/// shrinks the findings.
template <class Question>
class QuestionTrial {
 public:
  using Results = QuestionResults<Question>;
  using Judged = typename Question::Judged;

  /// The subjects, the plan and `stop` must outlive the trial.
  QuestionTrial(const Subjects& subjects, const QuestionPlan& plan, const Stop& stop)
      : subjects_(subjects), plan_(plan), stop_(stop) {
    for (const Family& family : plan.families) sources_.push_back({family, nullptr});
    if (!plan.search) return;
    for (const auto& subject : subjects)
      for (Family& family : Question::searches(*subject, stop))
        sources_.push_back({std::move(family), subject.get()});
  }

  /// Runs until the number of cases is reached or the stop is due. Calls `show` again and again, with the
  /// number of queries asked so far.
  Results run(const std::function<void(std::uint64_t)>& show) {
    in_order<Work>(
        plan_.jobs, [&] { return next(); }, [&](Work& work) { perform(work); },
        [&](Work& work) {
          take(std::move(work.results));
          show(asked_);
        });
    sort_findings();
    in_parallel(plan_.jobs, results_.findings.size(), [&](std::size_t i) { shrink(results_.findings[i]); });
    sort_findings();
    return std::move(results_);
  }

 private:
  static constexpr std::uint64_t one_in_asked_twice = 256;

  /// A family. If `only` is not null, the subject `only` is the only one that is asked about the family's
  /// queries.
  struct Source {
    Family family;
    const Subject* only;
  };

  /// The queries [first, last) of a family.
  struct Work {
    const Source* source;
    std::uint64_t first, last;
    Results results = {};
  };

  void sort_findings() {
    std::ranges::stable_sort(results_.findings, {}, [](const QuestionFinding& each) {
      return std::tuple(exoticness(each.query, each.query_class), each.what, each.subject);
    });
  }

  [[nodiscard]] bool can_ask(const Source& source, const Subject& subject, Kind kind) const {
    return plan_.kinds.contains(kind) && Question::is_answered(subject, kind) &&
           (source.only == nullptr || source.only == &subject);
  }

  [[nodiscard]] bool can_ask(const Source& source, Kind kind) const {
    return std::ranges::any_of(subjects_,
                               [&](const auto& subject) { return can_ask(source, *subject, kind); });
  }

  /// The next piece of work: a block of the next family. After the last family, a new round begins.
  std::optional<Work> next() {
    for (std::size_t passed = 0; passed <= sources_.size(); ++passed) {
      if (stop_.is_due() || (plan_.cases != 0 && planned_ >= plan_.cases)) return std::nullopt;
      if (at_ == sources_.size()) {
        at_ = 0;
        ++round_;
      }
      const Source& source = sources_[at_++];
      const auto of_kinds = static_cast<std::uint64_t>(
          std::ranges::count_if(source.family.kinds, [&](Kind kind) { return can_ask(source, kind); }));
      if (of_kinds == 0) continue;
      // A family has queries of two kinds, and each kind has half of the queries of a block.
      const std::uint64_t block = source.only != nullptr ? 2 : 4 * source.family.block_cases;
      const std::uint64_t first = block * round_;
      planned_ += of_kinds * block / 2;
      return Work{.source = &source, .first = first, .last = first + block};
    }
    return std::nullopt;
  }

  void perform(Work& work) const {
    const Family& family = work.source->family;
    try {
      for (std::uint64_t index = work.first; index < work.last; ++index) {
        stop_.check();
        const Kind kind = kind_of(family, index);
        if (!can_ask(*work.source, kind)) continue;
        const Query query = make_query(family, plan_.seed, index);
        if (!is_finite(query)) continue;
        std::vector<std::string> factors;
        if (family.factors) factors = factors_of(family, plan_.seed, index);
        for (const auto& subject : subjects_)
          if (can_ask(*work.source, *subject, kind)) count(*subject, query, index, factors, work);
      }
    } catch (const Stopped&) {  // the answers that the subjects gave before the stop still count
    }
  }

  /// Asks again about a query. If the second answer differs, replaces the first one by a fault.
  static void expect_the_same(const Subject& subject, const Query& query, Judged& judged) {
    const std::optional<Judged> again = Question::ask(subject, query);
    if (!again || again->answer_text() != judged.answer_text())
      judged = {.query = judged.query, .answer = {.fault = Fault::inconsistent}};
  }

  void count(const Subject& subject, const Query& query, std::uint64_t index,
             const std::vector<std::string>& factors, Work& work) const {
    const auto provenance = [&] {
      return fmt::format("{}:{}:{}", work.source->family.name, plan_.seed, index);
    };
    std::optional<Judged> judged = Question::ask(subject, query);
    if (!judged) return;
    if (judged->failure() || is_sampled(index, one_in_asked_twice)) expect_the_same(subject, query, *judged);
    const auto failure = judged->failure();
    const QueryClass of = judged->is_counted_by_class() ? classify(judged->query) : QueryClass::unclassified;
    work.results.counts[{subject.name(), query.kind}].add(*judged, of, provenance);
    if (!factors.empty() && judged->answer.fault == Fault::none)
      count_answer(work.results.factors, {subject.name(), query.kind, work.source->family.name, ""}, factors,
                   true, !judged->is_unsafe());
    if (!failure) return;
    QuestionFinding finding{.what = *failure,
                            .subject = subject.name(),
                            .signature = Question::signature(subject, *judged),
                            .query_class = of,
                            .provenance = provenance(),
                            .query = judged->query,
                            .answer = judged->answer_text(),
                            .text = judged->text()};
    work.results.findings.push_back(std::move(finding));
  }

  /// Adds results. Leaves out a finding if an earlier finding has the same failure, subject, signature and
  /// class.
  void take(Results&& results) {
    for (const auto& [key, each] : results.counts) asked_ += each.queries;
    std::erase_if(results.findings, [&](const QuestionFinding& each) {
      return !seen_.emplace(each.what, each.subject, each.signature, each.query_class).second;
    });
    results_.merge(std::move(results));
  }

  /// Replaces the finding's query by the simplest query that it finds in time. That query fails in the same
  /// way, has the same class, and is not more exotic (NoMoreExotic).
  void shrink(QuestionFinding& finding) const {
    try {
      shrink_within(finding, question_grace);
    } catch (const Stopped&) {  // the finding stays as it is
    }
  }

  void shrink_within(QuestionFinding& finding, std::chrono::seconds grace) const {
    const Subject& subject =
        **std::ranges::find_if(subjects_, [&](const auto& each) { return each->name() == finding.subject; });
    const NoMoreExotic allowed{finding.query_class, exoticness(finding.query, finding.query_class)};
    const auto fails = [&](const Query& query) {
      if (stop_.is_due(grace)) return false;
      const std::optional<Judged> judged = Question::ask(subject, query);
      return judged && judged->failure() == finding.what && allowed(judged->query) &&
             Question::signature(subject, *judged) == finding.signature;
    };
    const Query shrunk = nearmiss::shrunk(finding.query, [&](std::span<const Query> queries) {
      const auto found = std::ranges::find_if(queries, fails);
      return found == queries.end() ? std::nullopt : std::optional<std::size_t>(found - queries.begin());
    });
    const std::optional<Judged> judged = Question::ask(subject, shrunk);
    if (!judged || judged->failure() != finding.what) return;  // the subject answers otherwise this time
    finding.query = judged->query;
    finding.answer = judged->answer_text();
    finding.text = judged->text();
    finding.certificate = judged->certificate();
  }

  const Subjects& subjects_;
  const QuestionPlan& plan_;
  const Stop& stop_;
  std::vector<Source> sources_;
  std::size_t at_ = 0;
  std::uint64_t round_ = 0, planned_ = 0, asked_ = 0;
  std::set<std::tuple<std::string_view, std::string, std::string, QueryClass>> seen_;
  Results results_;
};

/// The sum of the counts of all classes.
std::uint64_t sum(const QueryClassCounts& counts);
/// The sum of the counts of all classes except extreme. Failures in extreme queries are shown, but do not set
/// the exit code.
std::uint64_t sum_that_counts(const QueryClassCounts& counts);

/// A directed search as two families: NAME for vt and ee queries, v-NAME for vv and ve queries. Each block
/// has one query.
std::vector<Family> search_families(std::string name, std::string about,
                                    std::function<Query(Random&, Kind)> make);

/// The families among which a user can choose. These are the families of campaigns; if `at_rest` is true, the
/// families at rest come before them.
std::vector<Family> families_of_questions(bool at_rest);
/// The families whose queries a trial asks by default. These are all families of families_of_questions()
/// except the extreme families, in whose queries even careful functions overflow.
std::vector<Family> usual_families_of_questions(bool at_rest);

}  // namespace nearmiss

// The functions of trial.h.
#include "fuzz/interface/trial.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <deque>
#include <memory>
#include <new>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "ccd/query/arithmetic.hpp"
#include "ccd/query/error.hpp"
#include "fuzz/interface/called_detector.hpp"
#include "fuzz/interface/trial_text.hpp"
#include "fuzz/subjects/contracted.hpp"
#include "fuzz/trial/campaign.hpp"
#include "fuzz/trial/certified.hpp"
#include "fuzz/trial/families_asked.hpp"
#include "fuzz/trial/shrunk_finding.hpp"
#include "oracle/explanation.hpp"
#include "reports/campaign/campaign.hpp"
#include "reports/statistics/failure.hpp"
#include "reports/statistics/sums.hpp"

namespace nearmiss {
namespace {

/// A result, with the memory that its pointers point to.
struct Result : nearmiss_trial_result {
  std::string lines;
  std::deque<std::string> texts;
  std::vector<nearmiss_trial_finding> list;

  const char* keep(std::string added) { return texts.emplace_back(std::move(added)).c_str(); }
};

std::string text_or(const char* text, const char* otherwise) {
  return text == nullptr || text[0] == '\0' ? otherwise : text;
}

std::vector<std::string> split(const std::string& names) {
  std::vector<std::string> parts;
  std::istringstream from(names);
  for (std::string part; std::getline(from, part, ',');) {
    const std::size_t first = part.find_first_not_of(" \t\n");
    if (first == std::string::npos) continue;
    parts.push_back(part.substr(first, part.find_last_not_of(" \t\n") + 1 - first));
  }
  return parts;
}

/// The caller's options, with defaults for fields that an older version of the structure lacks.
nearmiss_trial_options complete(const nearmiss_trial_options& given) {
  if (given.size == 0) throw Error("size: found 0, expected sizeof(nearmiss_trial_options)");
  nearmiss_trial_options options{};
  std::memcpy(&options, &given, std::min(given.size, sizeof options));
  return options;
}

std::vector<Kind> kinds_asked(const Subject& subject, int sum) {
  std::vector<Kind> asked;
  for (const Kind kind : kinds)
    if (subject.decides(kind) && (sum == 0 || (sum & bit_of(kind)) != 0)) asked.push_back(kind);
  if (asked.empty() || sum < 0 || sum > bits_of_all_kinds)
    throw Error("kinds: found " + std::to_string(sum) +
                ", expected a sum of kinds that the detector decides");
  return asked;
}

CampaignPlan plan_of(const nearmiss_trial_options& options, const Subject& subject) {
  CampaignPlan plan;
  const std::string names = text_or(options.families, "all");
  const std::string separation = text_or(options.separation, "");
  if (!(options.seconds >= 0))
    throw Error("seconds: found " + std::to_string(options.seconds) + ", expected at least 0");
  if (options.cases == 0 && options.seconds == 0)
    throw Error("cases: found 0, without a time, expected a number of queries or of seconds");
  if (options.threads < 0)
    throw Error("threads: found " + std::to_string(options.threads) + ", expected at least 1");
  plan.families = families_asked(names == "all" ? std::vector<std::string>() : split(names),
                                 kinds_asked(subject, options.kinds), separation);
  plan.seed = options.seed;
  plan.cases = options.cases;
  plan.jobs = std::max(options.threads, 1);
  plan.shrink = false;
  return plan;
}

nearmiss_trial_counts counts_of(const Counts& from) {
  nearmiss_trial_counts to{};
  to.queries = from.queries;
  to.collisions = from.collisions;
  to.missed = from.false_negatives;
  std::copy_n(from.missed_by_class.begin(), std::size(to.missed_class), to.missed_class);
  to.false_positives = from.false_positives;
  to.unknown = from.unknown();
  to.late = from.late;
  to.unsafe_steps = from.unsafe_steps;
  to.beyond_bound = from.refuted_bounds;
  to.beyond_contract = from.without_answer(Fault::contract);
  to.no_answer = from.faults_total() - to.beyond_contract;
  return to;
}

void add_counts(const Statistics& statistics, nearmiss_trial_result& result) {
  Counts all;
  std::array<Counts, kinds.size()> of_kind;
  for (const auto& [key, counts] : statistics.counts) {
    all.merge(counts);
    of_kind[static_cast<std::size_t>(key.kind)].merge(counts);
  }
  result.all = counts_of(all);
  std::transform(of_kind.begin(), of_kind.end(), result.of_kind, counts_of);
}

void add_finding(const Finding& finding, Result& result) {
  nearmiss_trial_finding& added = result.list.emplace_back();
  added.what = result.keep(std::string(name(finding.what)));
  added.query_class = result.keep(std::string(name(finding.query_class)));
  added.family = result.keep(finding.family);
  added.explanation = result.keep(to_text(explain(finding.shrunk)));
  added.certificate = result.keep(finding.certificate);
  added.kind = bit_of(finding.shrunk.kind);
  copy_coordinates(finding.shrunk.kind, finding.shrunk.x.data(), added.x);
  added.separation = finding.shrunk.separation;
}

/// The findings in the order in which the report's text chooses an example: the most ordinary class comes
/// first and, within a class, the gravest failure.
std::vector<Finding> in_order(const Campaign& campaign) {
  std::vector<Finding> findings = campaign.findings();
  std::ranges::stable_sort(findings, {}, [](const Finding& each) {
    return std::pair(each.query_class, failure_of(signature_of(each)));
  });
  return findings;
}

/// Shrinks the first finding of each way to fail, for at most three ways. Leaves all other findings as they
/// are, so that a test ends soon.
void shrink_first(Campaign& campaign, const Subjects& subjects, const Stop& stop) {
  constexpr std::size_t most = 3;
  constexpr ShrinkLimits limits{.work = limits_in_campaign.work, .time = std::chrono::seconds(2)};
  const FindingShrinker shrinker(pointers_to(subjects), stop, limits);
  std::set<Signature> shrunk;
  std::vector<Finding>& found = campaign.runs.front().findings;
  for (const Finding& each : in_order(campaign)) {
    if (shrunk.size() == most) return;
    if (!shrunk.insert(signature_of(each)).second) continue;
    Finding& finding = *std::ranges::find(found, each);
    try {
      shrinker.shrink(finding);
    } catch (const Stopped&) {
      return;
    }
    finding.certificate = certificate_of(finding);
  }
}

/// Asks the detector about the queries, and simplifies some of the queries on which the detector fails.
Campaign campaign_of(const CampaignPlan& plan, const Subjects& subjects, double seconds) {
  Stop stop = Stop::never();
  if (seconds > 0) stop.limit(std::chrono::duration<double>(seconds));
  Campaign campaign{.runs = std::vector<Run>(1), .statistics = {}};
  std::vector<Finding>& found = campaign.runs.front().findings;
  run_campaign(
      plan, subjects,
      [&](TrialResult&& result, const CampaignProgress& /*now*/) {
        campaign.statistics.merge(result.statistics);
        std::move(result.findings.begin(), result.findings.end(), std::back_inserter(found));
        return true;
      },
      stop);
  std::erase_if(found, [](const Finding& each) { return is_only_shown(each.what); });
  shrink_first(campaign, subjects, stop);
  return campaign;
}

std::unique_ptr<Result> hold(const nearmiss_subject& detector, void* state,
                             const nearmiss_trial_options& options) {
  expect_usable("trial", detector);
  const Subjects subjects =
      keep_contract(std::make_unique<CalledDetector>(detector, state, options.threads > 1), false);
  const CampaignPlan plan = plan_of(options, *subjects.front());
  expect_all_asked(subjects, plan.families);
  const Campaign campaign = campaign_of(plan, subjects, options.seconds);
  const std::vector<Finding> findings = in_order(campaign);
  auto result = std::make_unique<Result>();
  result->lines = trial_text({subjects.front()->name(), text_or(options.check, "assert"), options.seed},
                             campaign.statistics, findings);
  result->text = result->lines.c_str();
  add_counts(campaign.statistics, *result);
  result->is_clean = result->all.queries > 0 && !has_failed(campaign.statistics) ? 1 : 0;
  for (const Finding& each : findings) add_finding(each, *result);
  result->finding_count = result->list.size();
  result->findings = result->list.data();
  return result;
}

/// Does the work of a C function. Returns whether the work succeeded. If the work throws an exception, writes
/// the exception's text to `message`.
template <class Work>
bool told(char* message, std::size_t size, const Work& work) {
  const PlainArithmetic guard;
  try {
    work();
    return true;
  } catch (const std::bad_alloc&) {
    std::snprintf(message, size, "out of memory");
  } catch (const std::exception& error) {
    std::snprintf(message, size, "%s", error.what());
  }
  return false;
}

void write_queries(const std::string& name, Kind kind, std::uint64_t seed, std::uint64_t first, std::size_t n,
                   double* x, double* separation) {
  const std::vector<Family> families = families_asked({name}, std::span(&kind, 1));
  const Family& family = families.front();
  if (family.has_separation && separation == nullptr)
    throw Error("separation: found NULL, expected an array, because queries of " + name +
                " have separations");
  const QueryMaker make(family, seed);
  const std::uint64_t place = family.kinds[0] == kind ? 0 : 1;
  for (std::size_t i = 0; i < n; ++i) {
    const Query query = make(2 * (first + i) + place);
    copy_coordinates(kind, query.x.data(), x + i * coordinate_count(kind));
    if (separation != nullptr) separation[i] = query.separation;
  }
}

}  // namespace
}  // namespace nearmiss

nearmiss_trial_result* nearmiss_hold_trial(const nearmiss_subject* detector, void* state,
                                           const nearmiss_trial_options* options, char* message,
                                           size_t size) {
  std::unique_ptr<nearmiss::Result> result;
  nearmiss::told(message, size, [&] {
    if (detector == nullptr || options == nullptr)
      throw nearmiss::Error("trial: found NULL, expected a detector and options");
    result = nearmiss::hold(*detector, state, nearmiss::complete(*options));
  });
  return result.release();
}

void nearmiss_free_trial(nearmiss_trial_result* result) { delete static_cast<nearmiss::Result*>(result); }

int nearmiss_hard_queries(const char* family, int kind, uint64_t seed, uint64_t first, size_t n, double* x,
                          double* separation, char* message, size_t size) {
  return nearmiss::told(message, size, [&] {
    const auto one = nearmiss::kind_of_bit(kind);
    if (!one) throw nearmiss::Error("kind: found " + std::to_string(kind) + ", expected one kind of queries");
    nearmiss::write_queries(family, *one, seed, first, n, x, separation);
  });
}

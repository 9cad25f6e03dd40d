#include "reports/sections/changed_signatures.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "reports/statistics/confidence.hpp"
#include "reports/statistics/family.hpp"

namespace nearmiss {

namespace {

using What = Finding::What;

/// A sort of failure, and the subject that fails.
using Sort = std::pair<What, std::string>;

/// The level of each of several tests that share a risk.
double level_of(double risk, std::size_t tests) {
  return risk / static_cast<double>(std::max<std::size_t>(1, tests));
}

/// The number of queries with this signature, among all queries of its subject.
Proportion proportion_of(const Statistics& statistics, const Signature& signature) {
  const std::uint64_t seen = statistics.times_seen(signature);
  return {seen, std::max(seen, statistics.queries_of(signature.subject))};
}

/// The expected number of new signatures in a campaign with `ratio` times as many queries. This number is
/// computed from the number of times that each known signature was seen, with the series of Good and Toulmin
/// 1956, or with its first term for a larger campaign.
double expected_unseen(const std::vector<std::uint64_t>& seen, double ratio) {
  double expected = 0;
  for (const std::uint64_t times : seen) {
    if (ratio > 1)
      expected += times == 1 ? ratio : 0;
    else
      expected -= std::pow(-ratio, static_cast<double>(times));
  }
  return std::max(expected, 0.0);
}

/// The subjects that were asked now, but not in the baseline.
std::vector<std::string> absent_subjects(const Statistics& now, const Statistics& before) {
  std::vector<std::string> absent;
  for (const auto& [key, sum] : now.by_subject_and_kind())
    if ((absent.empty() || absent.back() != key.subject) && now.queries_of(key.subject) != 0 &&
        before.queries_of(key.subject) == 0)
      absent.push_back(key.subject);
  return absent;
}

/// The date of a campaign: the earliest start of a shard; "" if it is not known.
std::string date_of(const Campaign& campaign) {
  std::string date;
  for (const Run& run : campaign.runs)
    for (const Shard& shard : run.shards)
      if (date.empty() || (!shard.started.empty() && shard.started < date)) date = shard.started;
  return date;
}

std::map<Signature, Sightings> sightings_in(std::span<const Campaign> campaigns) {
  std::map<Signature, Sightings> all;
  for (const Campaign& each : campaigns) {
    const std::string date = date_of(each);
    std::map<std::string, SubjectCode> codes;
    for (const auto& [signature, times] : each.statistics.seen) {
      const auto [of_subject, is_unknown] = codes.try_emplace(signature.subject);
      if (is_unknown) of_subject->second = code_of(each, signature.subject);
      const SubjectCode& code = of_subject->second;
      const auto [place, is_first] = all.try_emplace(signature, Sightings{date, date, 0, code, code});
      place->second.last = date;
      place->second.last_code = code;
      ++place->second.campaigns;
    }
  }
  return all;
}

/// Finds out which of the signatures that were seen now are new.
void find_new(const Statistics& now, const Statistics& before, double risk, ChangedSignatures& changes) {
  // The numbers of times that signatures were seen before, by sort of failure.
  std::map<Sort, std::vector<std::uint64_t>> seen_before;
  for (const auto& [signature, count] : before.seen)
    seen_before[{signature.what, signature.subject}].push_back(count);
  const auto is_only_before = [&](const auto& each) { return now.times_seen(each.first) == 0; };
  const auto only_before = std::count_if(before.seen.begin(), before.seen.end(), is_only_before);
  const double level = level_of(risk, now.seen.size() + static_cast<std::size_t>(only_before));
  for (const auto& [signature, count] : now.seen) {
    if (std::binary_search(changes.absent_subjects.begin(), changes.absent_subjects.end(), signature.subject))
      continue;
    const bool is_unseen = before.times_seen(signature) == 0;
    const bool fails_anyway =
        !signature.subject.empty() && seen_before.contains({signature.what, signature.subject});
    const bool is_new =
        fails_anyway
            ? fisher_test(proportion_of(now, signature), proportion_of(before, signature)).more < level
            : is_unseen;
    if (is_new)
      changes.new_signatures.push_back(signature);
    else if (is_unseen)
      changes.unseen_signatures.push_back(signature);
    else
      changes.lasting_signatures.push_back(signature);
  }
  for (const auto& [sort, seen] : seen_before) {
    const Proportion queries{now.queries_of(sort.second), before.queries_of(sort.second)};
    if (queries.total != 0) changes.expected_unseen += expected_unseen(seen, queries.rate());
  }
}

std::uint64_t faults(const Counts& counts, Fault fault) {
  return counts.faults[static_cast<std::size_t>(fault)];
}

/// The number of queries that a subject was not asked.
std::uint64_t unasked(const Counts& counts) {
  return faults(counts, Fault::not_asked) + faults(counts, Fault::contract);
}

/// The number of queries that could have failed in a sort: a miss needs an answer, a fault only a question.
std::uint64_t chances(const Counts& counts, What what) {
  return counts.queries - (what == What::fault ? unasked(counts) : counts.faults_total());
}

/// The number of failures of a sort; 0 for the oracle's.
std::uint64_t failures(const Counts& counts, What what) {
  if (what == What::false_negative) return counts.false_negatives;
  if (what == What::refuted_bound) return counts.refuted_bounds;
  if (what == What::late) return counts.late;
  return what == What::fault ? counts.faults_total() - unasked(counts) : 0;
}

/// How often a subject could fail in a sort, before and now.
struct Chances {
  std::uint64_t before = 0;     ///< in random queries
  std::uint64_t unsampled = 0;  ///< failures in cases and meshes before
  double share = 0;             ///< the smallest fraction now / before over its families and kinds

  [[nodiscard]] std::uint64_t now() const {
    return static_cast<std::uint64_t>(share * static_cast<double>(before));
  }
};

Chances chances(const Statistics& now, const Statistics& before, const Sort& sort) {
  Chances sum;
  std::optional<double> share;
  for (const auto& [key, counts] : before.counts) {
    if (key.subject != sort.second) continue;
    if (!is_random(key.family)) {
      sum.unsampled += failures(counts, sort.first);
      continue;
    }
    const std::uint64_t earlier = chances(counts, sort.first);
    if (earlier == 0) continue;
    const auto same = now.counts.find(key);
    const std::uint64_t again = same == now.counts.end() ? 0 : chances(same->second, sort.first);
    sum.before += earlier;
    share = std::min(share.value_or(HUGE_VAL), static_cast<double>(again) / static_cast<double>(earlier));
  }
  sum.share = share.value_or(0);
  return sum;
}

/// The probability that a failure seen `times` before is not seen now, if nothing has changed.
double chance_of_none(std::uint64_t times, const Chances& chances) {
  const std::uint64_t random = times - std::min(times, chances.unsampled);
  return fisher_test({0, chances.now()}, {std::min(random, chances.before), chances.before}).less;
}

/// Finds out which of the signatures that were seen before are gone.
void find_gone(const Statistics& now, const Statistics& before, double risk, ChangedSignatures& changes) {
  std::set<Sort> still_fail;
  for (const auto& [signature, count] : now.seen) still_fail.emplace(signature.what, signature.subject);
  std::map<Sort, std::uint64_t> seen_before;
  std::vector<Signature> candidates;
  for (const auto& [signature, count] : before.seen) {
    seen_before[{signature.what, signature.subject}] += count;
    if (now.times_seen(signature) == 0) candidates.push_back(signature);
  }
  const double level = level_of(risk, candidates.size() + seen_before.size());
  for (const Signature& each : candidates) {
    const Sort sort{each.what, each.subject};
    const Chances of_sort = chances(now, before, sort);
    const bool is_gone =
        !each.subject.empty() &&
        (chance_of_none(before.times_seen(each), of_sort) < level ||
         (!still_fail.contains(sort) && chance_of_none(seen_before.at(sort), of_sort) < level));
    (is_gone ? changes.gone_signatures : changes.unrepeated_signatures).push_back(each);
  }
}

/// "in version 2" or "since sha256 0123456789ab", if the code is another; "" otherwise.
std::string fixed_text(const SubjectCode& then, const SubjectCode& now) {
  if (now == then || now.text().empty() || then.text().empty()) return "";
  return now.version != then.version && !now.version.empty() ? "in version " + now.version
                                                             : "since " + now.build;
}

}  // namespace

SubjectCode code_of(const Campaign& campaign, const std::string& subject) {
  constexpr std::size_t shown_digits = 12;
  const auto values = [&](const std::string& fact) {
    std::set<std::string> found;
    for (const Run& run : campaign.runs)
      if (const auto value = run.info.find(fact); value != run.info.end() && !value->second.empty())
        found.insert(value->second);
    return found;
  };
  const auto joined = [](const std::set<std::string>& texts) {
    return fmt::format("{}", fmt::join(texts, " | "));
  };
  const std::string plugin = std::string(about_plugin) + subject;
  const std::set<std::string> digests = values(plugin + " sha256");
  std::set<std::string> builds;
  for (const std::string& digest : digests) builds.insert("sha256 " + digest.substr(0, shown_digits));
  if (!digests.empty()) return {joined(values(plugin + " version")), joined(builds)};
  for (const std::string& commit : values("commit")) builds.insert("commit " + commit);
  return {joined(values("version")), joined(builds)};
}

ChangedSignatures compare_signatures(const Campaign& now, std::span<const Campaign> baseline,
                                     const Statistics& before, double risk) {
  ChangedSignatures changes{.sightings = sightings_in(baseline),
                            .absent_subjects = absent_subjects(now.statistics, before)};
  find_new(now.statistics, before, risk, changes);
  find_gone(now.statistics, before, risk, changes);
  for (const Signature& each : changes.gone_signatures)
    if (const std::string text = fixed_text(changes.sightings.at(each).last_code, code_of(now, each.subject));
        !text.empty())
      changes.fixed.emplace(each, text);
  return changes;
}

}  // namespace nearmiss

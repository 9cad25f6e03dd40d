#include "reports/sections/baseline.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "reports/statistics/confidence.hpp"
#include "reports/statistics/failure.hpp"
#include "reports/statistics/family.hpp"

namespace nearmiss {

namespace {

using What = Finding::What;

/// A sort of failure, and the subject that fails.
using Sort = std::pair<What, std::string>;

/// The expected number of signatures that the baseline does not have, in a campaign with `ratio` times as
/// many queries as the baseline. Uses the series of Good and Toulmin (1956), or only its first term if the
/// campaign is larger than the baseline. `seen` says how often each known signature was seen in the baseline.
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

std::vector<std::string> absent_subjects(const Statistics& now, const Statistics& before) {
  std::vector<std::string> absent;
  for (const auto& [key, sum] : now.by_subject_and_kind())
    if ((absent.empty() || absent.back() != key.subject) && now.queries_of(key.subject) != 0 &&
        before.queries_of(key.subject) == 0)
      absent.push_back(key.subject);
  return absent;
}

/// The date of a campaign: the start of the shard that began first; "" if it is not known.
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
    const auto code = [&](const std::string& subject) -> const SubjectCode& {
      const auto [of_subject, is_unknown] = codes.try_emplace(subject);
      if (is_unknown) of_subject->second = code_of(each, subject);
      return of_subject->second;
    };
    for (auto& [signature, sightings] : all)
      if (sightings.next_code == SubjectCode{} && each.statistics.queries_of(signature.subject) != 0 &&
          code(signature.subject) != sightings.last_code)
        sightings.next_code = code(signature.subject);
    for (const auto& [signature, times] : each.statistics.seen) {
      Sightings& sightings =
          all.try_emplace(signature, Sightings{date, date, 0, code(signature.subject)}).first->second;
      sightings.last = date;
      sightings.last_code = code(signature.subject);
      sightings.next_code = {};
      ++sightings.campaigns;
    }
  }
  return all;
}

std::uint64_t unasked(const Counts& counts) {
  return counts.without_answer(Fault::not_asked) + counts.without_answer(Fault::contract);
}

/// The number of queries that could have shown a failure of the sort `what`. For a fault, these are the
/// queries that the subject was asked; for any other sort, the queries that it answered.
std::uint64_t chances(const Counts& counts, What what) {
  return counts.queries - (what == What::fault ? unasked(counts) : counts.faults_total());
}

/// The number of failures of a sort; 0 for failures of the oracle.
std::uint64_t failures(const Counts& counts, What what) {
  if (what == What::fault) return counts.faults_total() - unasked(counts);
  std::uint64_t sum = 0;
  for (const FailureKind each : all_failures())
    if (finding_of(each) == what) sum += failure_info(each).count(counts);
  return sum;
}

/// How many queries could have shown a sort of failure: their number in the baseline (`before`), and their
/// number in the campaign divided by `before`, which is called the ratio. The ratio differs between families,
/// and the counters do not say in which families a signature was seen, so only the range of the ratio is
/// known.
struct Chances {
  std::uint64_t before = 0;  ///< number of random queries in the baseline that could have shown the failure
  double least = HUGE_VAL;   ///< the smallest ratio now / before over the families and kinds of the baseline
  double most = 0;           ///< the largest such ratio
  /// The largest number of queries that share one random draw. The steps of a sweep (a family with different
  /// values of its parameter) share their draws: a failure that was seen 40 times in 20 steps may come from
  /// two draws. To be safe, the tests count draws instead of queries.
  std::uint64_t repeats = 1;

  [[nodiscard]] bool known() const { return before != 0; }
  [[nodiscard]] std::uint64_t now(double ratio) const {
    return static_cast<std::uint64_t>(ratio * static_cast<double>(before));
  }
  /// A lower bound of the number of random draws that made `queries` queries.
  [[nodiscard]] std::uint64_t draws(std::uint64_t queries) const { return queries / repeats; }
  [[nodiscard]] Proportion proportion(std::uint64_t failures, std::uint64_t queries) const {
    return {draws(failures), draws(std::max(failures, queries))};
  }
};

Chances chances_of(const Sort& sort, const Statistics& now, const Statistics& before) {
  Chances sum;
  sum.repeats = std::max(most_repeats(now, sort.second), most_repeats(before, sort.second));
  for (const auto& [key, counts] : before.counts) {
    const std::uint64_t earlier = chances(counts, sort.first);
    if (key.subject != sort.second || !is_random(key.family) || earlier == 0) continue;
    const auto same = now.counts.find(key);
    const std::uint64_t again = same == now.counts.end() ? 0 : chances(same->second, sort.first);
    const double ratio = static_cast<double>(again) / static_cast<double>(earlier);
    sum.before += earlier;
    sum.least = std::min(sum.least, ratio);
    sum.most = std::max(sum.most, ratio);
  }
  return sum;
}

/// The number of failures of a sort in queries that are not random samples: cases and meshes.
std::uint64_t unsampled(const Statistics& statistics, const Sort& sort) {
  std::uint64_t sum = 0;
  for (const auto& [key, counts] : statistics.counts)
    if (key.subject == sort.second && !is_random(key.family)) sum += failures(counts, sort.first);
  return sum;
}

/// The probability that a signature is seen at least as often as now, if nothing has changed since `before`.
double chance_of_more(const Signature& signature, const Statistics& now, const Statistics& before) {
  const Chances chances = chances_of({signature.what, signature.subject}, now, before);
  if (!chances.known()) return 1;
  return fisher_test(chances.proportion(now.times_seen(signature), chances.now(chances.most)),
                     chances.proportion(before.times_seen(signature), chances.before))
      .more;
}

/// The probability that a failure seen `before` times in the baseline is not seen now, if nothing has
/// changed.
double chance_of_none(std::uint64_t before, const Chances& chances) {
  if (!chances.known()) return 1;
  return fisher_test(chances.proportion(0, chances.now(chances.least)),
                     chances.proportion(before, chances.before))
      .less;
}

std::map<Sort, std::vector<std::uint64_t>> seen_by_sort(const Statistics& statistics) {
  std::map<Sort, std::vector<std::uint64_t>> seen;
  for (const auto& [signature, count] : statistics.seen)
    seen[{signature.what, signature.subject}].push_back(count);
  return seen;
}

/// Adds up the campaigns of a baseline. Leaves out each campaign in which the signature was rarer, by more
/// than chance explains, than in the baseline's last campaign.
Statistics without_rarer(const Signature& signature, std::span<const Campaign> baseline, double risk) {
  Statistics sum;
  for (const Campaign& each : baseline)
    if (chance_of_more(signature, baseline.back().statistics, each.statistics) >=
        level_of(risk, baseline.size()))
      sum.merge(each.statistics);
  return sum;
}

void find_new(const Statistics& now, std::span<const Campaign> baseline, const Statistics& before,
              double risk, ChangedSignatures& changes) {
  const auto seen_before = seen_by_sort(before);
  const auto is_only_before = [&](const auto& each) { return now.times_seen(each.first) == 0; };
  const auto only_before = std::count_if(before.seen.begin(), before.seen.end(), is_only_before);
  const double level = level_of(risk, now.seen.size() + static_cast<std::size_t>(only_before));
  const auto is_more_frequent = [&](const Signature& signature) {
    return chance_of_more(signature, now, before) < level &&
           chance_of_more(signature, now, without_rarer(signature, baseline, risk)) < level;
  };
  for (const auto& [signature, count] : now.seen) {
    if (is_beyond_contract(signature.subject) || is_only_shown(signature.what) ||
        std::binary_search(changes.absent_subjects.begin(), changes.absent_subjects.end(), signature.subject))
      continue;
    const bool is_unseen = before.times_seen(signature) == 0;
    const bool fails_anyway =
        !signature.subject.empty() && seen_before.contains({signature.what, signature.subject});
    if (fails_anyway ? is_more_frequent(signature) : is_unseen)
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

void find_gone(const Statistics& now, const Statistics& before, double risk, ChangedSignatures& changes) {
  std::set<Sort> still_fail;
  for (const auto& [signature, count] : now.seen) still_fail.emplace(signature.what, signature.subject);
  std::map<Sort, std::uint64_t> seen_before;
  std::vector<Signature> candidates;
  for (const auto& [signature, count] : before.seen) {
    seen_before[{signature.what, signature.subject}] += count;
    if (now.times_seen(signature) == 0 && !is_beyond_contract(signature.subject) &&
        !is_only_shown(signature.what))
      candidates.push_back(signature);
  }
  const double level = level_of(risk, candidates.size() + seen_before.size());
  for (const Signature& each : candidates) {
    const Sort sort{each.what, each.subject};
    const Chances of_sort = chances_of(sort, now, before);
    const auto chance = [&, in_cases = unsampled(before, sort)](std::uint64_t times) {
      return chance_of_none(times - std::min(times, in_cases), of_sort);
    };
    const bool is_gone = chance(before.times_seen(each)) < level ||
                         (!still_fail.contains(sort) && chance(seen_before.at(sort)) < level);
    (is_gone ? changes.gone_signatures : changes.unrepeated_signatures).push_back(each);
  }
}

/// Names the code of the subject that came after the last code with the signature, such as "in version 2" or
/// "since sha256 0123456789ab". Returns "" if both codes are the same, or if one of them is not known.
std::string fixed_text(const Sightings& seen, const SubjectCode& now) {
  const SubjectCode& then = seen.last_code;
  const SubjectCode& next = seen.next_code == SubjectCode{} ? now : seen.next_code;
  if (next == then || next.text().empty() || then.text().empty()) return "";
  return next.version != then.version && !next.version.empty() ? "in version " + next.version
                                                               : "since " + next.build;
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
  const std::set<std::string> digests = values(plugin + std::string(its_digest));
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
  find_new(now.statistics, baseline, before, risk, changes);
  find_gone(now.statistics, before, risk, changes);
  for (const Signature& each : changes.gone_signatures)
    if (const std::string text = fixed_text(changes.sightings.at(each), code_of(now, each.subject));
        !text.empty())
      changes.fixed.emplace(each, text);
  return changes;
}

}  // namespace nearmiss

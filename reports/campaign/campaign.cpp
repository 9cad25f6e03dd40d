#include "reports/campaign/campaign.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <string_view>
#include <tuple>
#include <utility>

#include "ccd/query/error.hpp"
#include "reports/campaign/complexity.hpp"
#include "reports/statistics/failure.hpp"
#include "reports/statistics/family.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

/// Sorts the findings of a run's shards into the order in which a single machine would have found them, and
/// drops the findings that a single machine would not have kept.
void keep_first(std::vector<Finding>& findings) {
  // All findings of one case come from one shard, which lists these findings in the right order. A stable
  // sort keeps this order.
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return a.place < b.place; });
  FirstFindings first;
  std::erase_if(findings, [&](const Finding& f) { return !first.take(f); });
}

std::string describe(const RunInfo& info) {
  std::string text;
  for (const auto& [name, value] : info)
    if (name != "again")  // the value of "again" is a command, which says no more than the other facts
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, value);
  return text;
}

RunInfo original_of(RunInfo info) {
  info.erase(salvaged_fact);
  info.erase(origin_fact);
  return info;
}

}  // namespace

RunInfo task_of(const RunInfo& info) {
  RunInfo task = original_of(info);
  std::erase_if(task, [](const auto& fact) { return says_which_code(fact.first); });
  return task;
}

bool says_which_code(std::string_view fact) {
  return fact == "version" || fact == "commit" || fact.starts_with(about_plugin);
}

std::string fact(const RunInfo& info, const std::string& name) {
  const auto found = info.find(name);
  return found == info.end() ? "" : found->second;
}

std::optional<DifferentFact> different_fact(const RunInfo& one, const RunInfo& other) {
  for (const RunInfo* each : {&one, &other})
    for (const auto& [name, ignored] : *each)
      if (name != "again" && fact(one, name) != fact(other, name))
        return DifferentFact{name, fact(one, name), fact(other, name)};
  return std::nullopt;
}

namespace {

/// The key by which Campaign::findings sorts this finding.
auto place_of(const Finding& finding, const Statistics& statistics) {
  const bool is_of_oracle = finding.subject.empty();
  const auto times_seen = statistics.times_seen(signature_of(finding));
  const bool seldom_counts =
      failure_info(failure_of(signature_of(finding))).on_request || is_beyond_contract(finding.subject);
  return std::tuple(!is_of_oracle, seldom_counts, least_exotic_first(finding),
                    std::numeric_limits<std::uint64_t>::max() - times_seen, signature_of(finding),
                    complexity(finding.shrunk));
}

}  // namespace

std::vector<Finding> Campaign::findings() const {
  using Place = decltype(place_of(Finding{}, statistics));
  std::vector<std::pair<Place, Finding>> placed;
  for (const Run& run : runs)
    for (const Finding& each : run.findings) placed.emplace_back(place_of(each, statistics), each);
  std::stable_sort(placed.begin(), placed.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Finding> all;
  std::set<std::tuple<Signature, QueryClass, std::string, Kind, std::array<double, 24>, double>> known;
  for (auto& [place, finding] : placed) {
    const Query& shrunk = finding.shrunk;
    if (known
            .emplace(signature_of(finding), finding.query_class, finding.broken_since, shrunk.kind, shrunk.x,
                     shrunk.separation)
            .second)
      all.push_back(std::move(finding));
  }
  return all;
}

namespace {

/// Throws Error if the campaign has results of an unknown run, because a merge could count these results
/// twice.
void expect_known_runs(const Campaign& campaign, const std::string& name) {
  if (std::any_of(campaign.runs.begin(), campaign.runs.end(),
                  [](const Run& run) { return run.info.contains(origin_fact); }))
    throw Error(name +
                ": found results of an unknown run, because rows about runs were lost, expected a "
                "store whose results cannot count twice");
}

class RunMerger {
 public:
  void add(const Run& each, const std::string& name) {
    expect_same_code(each.info, name);
    expect_known_names(each.info, name);
    Run& run = runs_[each.info];
    run.info = each.info;
    for (const Shard& shard : each.shards) add(shard, run, name);
    run.findings.insert(run.findings.end(), each.findings.begin(), each.findings.end());
    run.pictures.insert(run.pictures.end(), each.pictures.begin(), each.pictures.end());
  }

  std::vector<Run> merged() && {
    std::vector<Run> all;
    for (auto& [info, run] : runs_) {
      std::sort(run.shards.begin(), run.shards.end(),
                [](const Shard& a, const Shard& b) { return a.index < b.index; });
      keep_first(run.findings);
      all.push_back(std::move(run));
    }
    return all;
  }

 private:
  void expect_same_code(const RunInfo& info, const std::string& name) {
    const auto& [other, other_name] = by_task_.try_emplace(task_of(info), info, name).first->second;
    if (const auto fact = different_fact(original_of(other), original_of(info)))
      throw Error(fmt::format("{}: found {} '{}', expected '{}' as in {}, for the run with {}", name,
                              fact->name, fact->other, fact->one, other_name, describe(task_of(info))));
  }

  /// Throws Error if two inputs give the same name to different plug-ins or renamed subjects. Plug-ins that
  /// call themselves by the same name count as one plug-in, even if their bytes or versions differ.
  void expect_known_names(const RunInfo& info, const std::string& name) {
    for (const auto& [about, value] : info) {
      const bool is_plugin = about.starts_with(about_plugin) && about.ends_with(its_digest) &&
                             about.size() > about_plugin.size() + its_digest.size();
      if (!is_plugin && !about.starts_with(about_subject)) continue;
      const std::string of_plugin = about.substr(0, about.size() - its_digest.size());
      const std::string subject =
          is_plugin ? of_plugin.substr(about_plugin.size()) : about.substr(about_subject.size());
      const std::string detector = fact(info, of_plugin + std::string(its_detector));
      const std::string stands_for =
          is_plugin ? "the plug-in " + (detector.empty() ? subject.substr(0, subject.find(':')) : detector)
                    : value;
      const auto& [other, other_name] = by_subject_.try_emplace(subject, stands_for, name).first->second;
      if (other != stands_for)
        throw Error(fmt::format("{}: found the name '{}' for {}, but for {} in {}, expected different names",
                                name, subject, stands_for, other, other_name));
    }
  }

  void add(const Shard& shard, Run& run, const std::string& name) {
    const RunInfo original = original_of(run.info);
    const auto [other, is_new] = from_.emplace(std::tuple(original, shard.index), name);
    if (!is_new)
      throw Error(fmt::format("{} and {}: both have shard {}/{} of the run with {}", other->second, name,
                              shard.index, shard.count, describe(original)));
    if (!run.shards.empty() && run.shards.front().count != shard.count)
      throw Error(fmt::format("{}: found a shard of {}, and one of {} in {}, of the run with {}", name,
                              shard.count, run.shards.front().count,
                              from_.at({original, run.shards.front().index}), describe(original)));
    run.shards.push_back(shard);
  }

  std::map<RunInfo, Run> runs_;
  /// for each task, the facts of its first run, and the name of the input that has this run
  std::map<RunInfo, std::pair<RunInfo, std::string>> by_task_;
  /// For each name of a plug-in or of a renamed subject: a text that says what the name stands for, and the
  /// name of the first input that uses the name.
  std::map<std::string, std::pair<std::string, std::string>> by_subject_;
  /// for each shard of a run, the name of the input that contains the shard
  std::map<std::tuple<RunInfo, std::uint64_t>, std::string> from_;
};

/// Whether `condition` holds for a name in the list that is the value of the fact `of`; true if the run does
/// not have this fact. Commas divide the list. A blank ends a name, and the text after the blank is a
/// comment.
template <class Condition>
bool any_name(const RunInfo& info, const std::string& of, const Condition& condition) {
  const std::string text = fact(info, of);
  if (text.empty()) return true;
  std::istringstream words(text);
  std::string name;
  while (std::getline(words >> std::ws, name, ','))
    if (condition(std::string_view(name).substr(0, name.find(' ')))) return true;
  return false;
}

/// Whether a run may have asked the queries that `key` identifies, judged by three facts of the run. Examples
/// of their values are "uniform,needle", "stiff in 17 steps" or "all, search" for the fact "families",
/// "vt,ee" for "kinds", and "wang,x=wang,./plugin.so" for "subjects".
bool may_ask(const RunInfo& info, const CountsKey& key) {
  const FamilyName wanted(key.family);
  return any_name(info, "families",
                  [&](std::string_view name) {
                    return name == "all" || name == "vertices" ||
                           (name == "search" && !wanted.search.empty()) ||
                           FamilyName(name).base == wanted.base;
                  }) &&
         any_name(info, "kinds", [&](std::string_view name) { return name == short_name(key.kind); }) &&
         any_name(info, "subjects", [&](std::string_view name) {
           // the user gave the plug-in no NAME, so the plug-in names itself
           const bool names_itself = name.find_first_of("/:") < name.find('=');
           return names_itself || key.subject.starts_with(name.substr(0, name.find('=')));
         });
}

/// The key with its separation in the usual form, so that the separations 0.1 and 0.10 give equal keys.
CountsKey with_usual_separation(CountsKey key) {
  FamilyName of(key.family);
  const auto separation = of.separation ? number_in(*of.separation) : std::nullopt;
  if (!separation) return key;
  const std::string usual = fmt::format("{}", *separation);
  of.separation = usual;
  key.family = of.text();
  return key;
}

std::set<CountsKey> random_keys(const Campaign& campaign, const RunInfo& info) {
  std::set<CountsKey> keys;
  for (const auto& [key, counts] : campaign.statistics.counts)
    if (is_random(key.family) && may_ask(info, key)) keys.insert(with_usual_separation(key));
  return keys;
}

/// Whether the queries of a family come from files.
bool is_of_files(std::string_view root) { return root == "mesh" || root == "near" || root == "near-within"; }

/// Finds results that would count twice if campaigns were merged: two answers of one subject to the same
/// random query, or two results for the same step of a simulation.
class AskedQueries {
 public:
  /// Adds a campaign; `name` is the name of its store. Throws Error if this campaign and an earlier one have
  /// the same step of a simulation. Also throws Error if both have a run with the same seed, and these two
  /// runs put queries of the same family to the same subject. Shards of one run do not count as two runs,
  /// because they ask different queries.
  void add(const Campaign& campaign, const std::string& name);

 private:
  /// The queries that the runs of one task (task_of) asked.
  struct Asked {
    RunInfo task;
    std::string files;  ///< the files from which the families "mesh" and "near" were made, if any
    std::string name;
    std::set<CountsKey> keys;
  };
  void add_simulations(const Campaign& campaign, const std::string& name);

  std::map<std::string, std::vector<Asked>> by_seed_;
  std::set<SimulatedStepKey> simulated_;
};

void AskedQueries::add_simulations(const Campaign& campaign, const std::string& name) {
  for (const auto& [key, step] : campaign.statistics.simulated)
    if (!simulated_.insert(key).second)
      throw Error(
          fmt::format("{}: found {} with {}, which another store has too; expected each simulation once",
                      name, key.family, key.subject));
}

void AskedQueries::add(const Campaign& campaign, const std::string& name) {
  add_simulations(campaign, name);
  std::vector<std::pair<std::string, Asked>> added;
  for (const Run& run : campaign.runs) {
    const std::string seed = fact(run.info, "seed");
    if (seed.empty()) continue;
    Asked asked{task_of(run.info), fact(run.info, "scene") + fact(run.info, "near"), name,
                random_keys(campaign, run.info)};
    for (const Asked& other : by_seed_[seed]) {
      if (other.task == asked.task) continue;
      const auto twice = std::ranges::find_if(asked.keys, [&](const CountsKey& key) {
        return other.keys.contains(key) &&
               (!is_of_files(FamilyName(key.family).root) || other.files == asked.files);
      });
      if (twice != asked.keys.end())
        throw Error(
            fmt::format("{}: found queries of {} with seed {} that {} was asked in {}, too, expected "
                        "another seed",
                        name, twice->family, seed, twice->subject, other.name));
    }
    added.emplace_back(seed, std::move(asked));
  }
  for (auto& [seed, asked] : added) {
    auto& known = by_seed_[seed];
    const auto same = std::ranges::find(known, asked.task, &Asked::task);
    if (same == known.end())
      known.push_back(std::move(asked));
    else
      same->keys.merge(asked.keys);
  }
}

}  // namespace

Campaign merge_campaigns(std::span<const Campaign> campaigns, std::span<const std::string> names) {
  Statistics statistics;
  RunMerger runs;
  AskedQueries asked;
  for (std::size_t i = 0; i < campaigns.size(); ++i) {
    if (campaigns.size() > 1) expect_known_runs(campaigns[i], names[i]);
    for (const Run& each : campaigns[i].runs) runs.add(each, names[i]);
    asked.add(campaigns[i], names[i]);
    statistics.merge(campaigns[i].statistics);
  }
  return {std::move(runs).merged(), std::move(statistics)};
}

namespace {

/// Says how many cases an incomplete run of one shard has decided.
std::string how_far(const Run& run) {
  const Shard& shard = run.shards.front();
  const std::string after = "stopped after " + with_separators(shard.cases);
  const auto fact = run.info.find("cases");
  if (fact == run.info.end()) return after + " cases";
  if (fact->second == until_the_time_is_over) return after + " cases, before its time was over";
  if (fact->second == std::to_string(shard.cases)) return "stopped before all findings were shrunk";
  return after + " of " + fact->second + " cases";
}

}  // namespace

std::string missing_shards(const Run& run) {
  constexpr std::size_t most_named = 20;  // a damaged store may claim any number of shards
  std::vector<std::uint64_t> missing;     ///< at most `most_named` of the missing shards
  std::vector<std::uint64_t> unfinished;
  std::vector<std::string> asked;  ///< number of cases that each unfinished shard decided
  const std::uint64_t count = run.shards.empty() ? 0 : run.shards.front().count;
  std::uint64_t next = 0;
  const auto miss_before = [&](std::uint64_t index) {
    while (next < index && missing.size() < most_named) missing.push_back(next++);
  };
  for (const Shard& shard : run.shards) {
    if (shard.index >= count) break;
    miss_before(shard.index);
    next = shard.index + 1;
    if (shard.complete) continue;
    unfinished.push_back(shard.index);
    asked.push_back(with_separators(shard.cases));
  }
  miss_before(count);
  std::string text;
  if (!missing.empty())
    text = fmt::format("shards {}{} of {} are missing", fmt::join(missing, ", "),
                       missing.size() < most_named ? "" : ", ...", count);
  if (!unfinished.empty() && count == 1) text = how_far(run);
  if (!unfinished.empty() && count > 1)
    text +=
        fmt::format("{}shards {} of {} are not complete (stopped after {} cases)", text.empty() ? "" : ", ",
                    fmt::join(unfinished, ", "), count, fmt::join(asked, " and "));
  return text;
}

}  // namespace nearmiss

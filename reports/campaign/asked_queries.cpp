#include "reports/campaign/asked_queries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <string_view>
#include <utility>

#include "ccd/query/error.hpp"
#include "reports/statistics/family.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

/// Whether one of the names in a fact, up to a comma or a blank, fulfils a condition; true without the fact.
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

/// Whether a run may have asked the queries of a key, by its facts: families "uniform,needle",
/// "stiff in 17 steps" or "all, search", kinds "vt,ee", subjects "wang,x=wang,./plugin.so".
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
           const bool names_itself = name.find_first_of("/:") < name.find('=');  // a plug-in without a NAME
           return names_itself || key.subject.starts_with(name.substr(0, name.find('=')));
         });
}

/// The same key for queries of the same separation, such as 0.1 and 0.10.
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

/// Whether the queries of a family are those of files.
bool is_of_files(std::string_view root) { return root == "mesh" || root == "near" || root == "near-within"; }

}  // namespace

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

}  // namespace nearmiss

#include "reports/campaign/asked_queries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <string_view>
#include <utility>

#include "ccd/query/error.hpp"
#include "reports/statistics/family.hpp"

namespace nearmiss {

namespace {

/// Whether queries of a family may be those of a run, by its fact "families": "uniform,needle",
/// "stiff in 17 steps", "all, search".
bool may_ask(const RunInfo& info, std::string_view family) {
  const FamilyName wanted(family);
  std::istringstream words(fact(info, "families"));
  std::string name;
  while (std::getline(words >> std::ws, name, ',')) {
    const std::string_view of = std::string_view(name).substr(0, name.find(' '));
    if (of == "all" || of == "vertices" || (of == "search" && !wanted.search.empty()) ||
        FamilyName(of).base == wanted.base)
      return true;
  }
  return false;
}

std::set<CountsKey> random_keys(const Campaign& campaign, const RunInfo& info) {
  std::set<CountsKey> keys;
  for (const auto& [key, counts] : campaign.statistics.counts)
    if (is_random(key.family) && may_ask(info, key.family)) keys.insert(key);
  return keys;
}

}  // namespace

void AskedQueries::add(const Campaign& campaign, const std::string& name) {
  std::vector<std::pair<std::string, Asked>> added;
  for (const Run& run : campaign.runs) {
    const std::string seed = fact(run.info, "seed");
    if (seed.empty()) continue;
    Asked asked{task_of(run.info), fact(run.info, "scene"), name, random_keys(campaign, run.info)};
    for (const Asked& other : by_seed_[seed]) {
      if (other.task == asked.task) continue;
      const auto twice = std::ranges::find_if(asked.keys, [&](const CountsKey& key) {
        return other.keys.contains(key) && (key.family != "mesh" || other.mesh == asked.mesh);
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

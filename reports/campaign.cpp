#include "reports/campaign.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>
#include <tuple>
#include <utility>

#include "ccd/error.hpp"

namespace nearmiss {

namespace {

/// The order of a campaign's findings: those that fail in the same way stand together.
bool is_before(const Finding& a, const Finding& b) {
  const auto key = [](const Finding& f) { return std::tie(f.what, f.subject, f.signature); };
  return key(a) < key(b);
}

/// Puts findings in the order in which one machine would have kept them, and drops what it would not have.
void keep_first(std::vector<Finding>& findings) {
  // A round is done by one part, whose findings are in order.
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return a.round < b.round; });
  std::map<Signature, std::size_t> kept;
  std::erase_if(findings, [&](const Finding& f) { return ++kept[signature_of(f)] > findings_kept; });
}

std::string describe(const RunInfo& info) {
  std::string text;
  for (const auto& [name, value] : info)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, value);
  return text;
}

}  // namespace

std::vector<Finding> Campaign::findings() const {
  std::vector<Finding> all;
  for (const Run& run : runs) all.insert(all.end(), run.findings.begin(), run.findings.end());
  std::stable_sort(all.begin(), all.end(), is_before);
  std::set<std::tuple<Signature, Kind, std::array<double, 24>>> known;
  std::erase_if(all, [&](const Finding& f) {
    return !known.emplace(signature_of(f), f.shrunk.kind, f.shrunk.x).second;
  });
  return all;
}

Campaign merge_campaigns(std::span<const Campaign> campaigns, std::span<const std::string> names) {
  Campaign merged;
  std::map<RunInfo, Run> runs;
  std::map<std::tuple<RunInfo, std::uint64_t>, std::string> from;  // the input that has a shard
  for (std::size_t i = 0; i < campaigns.size(); ++i) {
    merged.statistics.merge(campaigns[i].statistics);
    for (const Run& each : campaigns[i].runs) {
      Run& run = runs[each.info];
      run.info = each.info;
      for (const Part& part : each.parts) {
        const auto [other, is_new] = from.emplace(std::tuple(each.info, part.shard), names[i]);
        if (!is_new)
          throw Error(fmt::format("{} and {}: both have shard {}/{} of the run with {}", other->second,
                                  names[i], part.shard, part.shards, describe(each.info)));
        if (!run.parts.empty() && run.parts.front().shards != part.shards)
          throw Error(fmt::format("{}: found a shard of {}, and one of {} in {}, of the run with {}",
                                  names[i], part.shards, run.parts.front().shards,
                                  from.at({each.info, run.parts.front().shard}), describe(each.info)));
        run.parts.push_back(part);
      }
      run.findings.insert(run.findings.end(), each.findings.begin(), each.findings.end());
      run.pictures.insert(run.pictures.end(), each.pictures.begin(), each.pictures.end());
    }
  }
  for (auto& [info, run] : runs) {
    std::sort(run.parts.begin(), run.parts.end(),
              [](const Part& a, const Part& b) { return a.shard < b.shard; });
    keep_first(run.findings);
    merged.runs.push_back(std::move(run));
  }
  return merged;
}

std::string missing_parts(const Run& run) {
  std::vector<std::uint64_t> missing;
  std::vector<std::uint64_t> unfinished;
  auto part = run.parts.begin();
  const std::uint64_t shards = run.parts.empty() ? 0 : run.parts.front().shards;
  for (std::uint64_t shard = 0; shard < shards; ++shard) {
    if (part == run.parts.end() || part->shard != shard) {
      missing.push_back(shard);
      continue;
    }
    if (!part->complete) unfinished.push_back(shard);
    ++part;
  }
  std::string text;
  if (!missing.empty()) text = fmt::format("shards {} of {} are missing", fmt::join(missing, ", "), shards);
  if (!unfinished.empty() && shards == 1) text = "not complete";
  if (!unfinished.empty() && shards > 1)
    text += fmt::format("{}shards {} of {} are not complete", text.empty() ? "" : ", ",
                        fmt::join(unfinished, ", "), shards);
  return text;
}

}  // namespace nearmiss

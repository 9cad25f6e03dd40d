// Campaigns for tests of reports.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "reports/campaign/campaign.hpp"
#include "tests/queries.hpp"

namespace nearmiss::testing {

/// Counters of a subject; `ns` is its run time per query. The distance of the farthest false positive is
/// `false_positives` / 1000 times the bound.
inline Counts counts(std::uint64_t queries, std::uint64_t collisions, std::uint64_t missed,
                     std::uint64_t false_positives, std::uint64_t ns = 0) {
  Counts c;
  c.queries = queries;
  c.collisions = collisions;
  c.false_negatives = missed;
  c.false_positives = false_positives;
  if (ns != 0) c.times.add(Kind::edge_edge, "f", {queries, ns * queries});
  if (false_positives != 0) c.farthest.push_back({1e-3 * static_cast<double>(false_positives), {}, "f:1:0"});
  return c;
}

inline Campaign campaign(const std::string& seed, std::map<CountsKey, Counts> all) {
  Campaign result;
  result.runs.push_back({{{"command", "fuzz"}, {"seed", seed}}, {{}}, {}});
  result.statistics.counts = std::move(all);
  return result;
}

inline const Query query = falling_vertex(0.25, 0.25, 1, -1);
inline const Query simple = falling_vertex(0.5, 0.5, 1, -1);

/// A campaign in which `subject` reports one collision, misses another, and has a false positive at half of
/// its bound.
inline Campaign some_campaign(const std::string& subject) {
  Campaign campaign;
  campaign.runs.push_back({{{"command", "fuzz"}}, {{}}, {}});
  Counts& counts = campaign.statistics.counts[{subject, Kind::vertex_triangle, "fam,\"ily"}];
  counts.add({.verdict = {true, Stage::proximity, 0.5}, .collision = true}, query, [] { return "f:1:0"; });
  counts.add({.verdict = {false, Stage::none, 0}, .collision = true}, query, [] { return "f:1:2"; });
  counts.add({.verdict = {true, Stage::vv, 0.5}, .collision = false, .ratio = 0.5}, query,
             [] { return "f:1:4"; });
  counts.times.add(Kind::vertex_triangle, "fam,\"ily", {3, 300});
  auto& findings = campaign.runs.front().findings;
  findings.push_back({Finding::What::false_negative, subject, "fam,\"ily", query, "f:1:2", 0,
                      "vt simple-root inside in-face", simple});
  campaign.statistics.seen[signature_of(findings.back())] = 1234;
  return campaign;
}

}  // namespace nearmiss::testing

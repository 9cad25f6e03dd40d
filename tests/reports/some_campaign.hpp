// A campaign with one result of each sort, for tests of reports.
#pragma once

#include <string>

#include "reports/campaign/campaign.hpp"
#include "tests/queries.hpp"

namespace nearmiss::testing {

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

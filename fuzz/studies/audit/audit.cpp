#include "fuzz/studies/audit/audit.hpp"

#include <algorithm>

#include "fuzz/families/families.hpp"
#include "fuzz/studies/audit/constant_groups.hpp"

namespace nearmiss {

namespace {

using namespace audit_parts;

/// Adds the readings of one sample to the rows.
void take(std::vector<AuditRow>& rows, const Readings& readings) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    AuditRow& row = rows[i];
    const Reading& one = readings.at(i);
    if (!(one.derived <= row.derived)) {
      row.derived = one.derived;
      row.bound = one.bound;
    }
    row.seen = std::max(row.seen, one.seen);
    if (one.by_the_rules && one.seen > one.derived) ++row.violations;
  }
}

/// A hill climb for the largest error of one row. Each round starts from the best of some random samples and
/// takes small steps from there.
void climb(ConstantGroup& group, std::size_t row, const AuditPlan& plan, Random& random) {
  const int round = std::max(1000, plan.steps / 6);
  AuditSample best;
  double seen = -1;
  for (int i = 0; i < plan.steps; ++i) {
    if (i % round == 0) seen = -1;
    const bool start = i % round < round / 4;
    const AuditSample next = start ? draw_sample(random, group.reach) : changed(random, best);
    const Readings readings = group.read(next);
    take(group.rows, readings);
    if (readings.at(row).seen < seen) continue;
    seen = readings[row].seen;
    best = next;
  }
}

/// Reads the samples of each family's first queries.
void read_families(std::vector<ConstantGroup>& groups, const AuditPlan& plan) {
  for (const Family& family : families()) {
    for (int i = 0; i < plan.queries; ++i) {
      const Query query = make_query(family, plan.seed, static_cast<std::uint64_t>(i));
      Random random(plan.seed, 1, static_cast<std::uint64_t>(i));
      const auto sample = sample_of(query, random);
      if (!sample) continue;
      for (ConstantGroup& group : groups)
        if (!group.kind || *group.kind == query.kind) take(group.rows, group.read(*sample));
    }
  }
}

}  // namespace

std::vector<AuditRow> audit(const AuditPlan& plan) {
  std::vector<ConstantGroup> groups = constant_groups();
  read_families(groups, plan);
  std::vector<AuditRow> rows;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    ConstantGroup& group = groups[g];
    for (std::size_t row = 0; row < group.rows.size() && !group.kind; ++row) {
      Random random(plan.seed, 2 + g, row);
      climb(group, row, plan, random);
    }
    rows.insert(rows.end(), group.rows.begin(), group.rows.end());
  }
  const auto others = consequences(rows);
  rows.insert(rows.end(), others.begin(), others.end());
  return rows;
}

}  // namespace nearmiss

// The audited constants, in groups that share their samples.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "fuzz/studies/audit/audit.hpp"
#include "fuzz/studies/audit/readings.hpp"

namespace nearmiss::audit_parts {

struct ConstantGroup {
  std::vector<AuditRow> rows;
  std::function<Readings(const AuditSample&)> read;  ///< a reading for each row
  double reach = 1;                                  ///< bound of p in the hill climb, in units of B
  /// If set, the rows are about the rounding of relative vectors, and their samples are queries of this kind.
  std::optional<Kind> kind{};
};

/// All groups, in the order of the paper. Only the quoted and the proven constants are filled in.
std::vector<ConstantGroup> constant_groups();

/// The constants that the paper computes from other constants, given the rows of all groups.
std::vector<AuditRow> consequences(const std::vector<AuditRow>& rows);

}  // namespace nearmiss::audit_parts

// The constants that are audited, in groups that are read from the same samples.
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
  double reach = 1;                                  ///< of p, in the hill climb
  /// If set, the rows are about the rounding of relative vectors, which queries of this kind show.
  std::optional<Kind> kind{};
};

/// All groups, in the order of the paper. Only what the paper or ccd/ quotes, and what is proven, is filled in.
std::vector<ConstantGroup> constant_groups();

/// Constants that the paper computes from others, from the rows of all groups.
std::vector<AuditRow> consequences(const std::vector<AuditRow>& rows);

}  // namespace nearmiss::audit_parts

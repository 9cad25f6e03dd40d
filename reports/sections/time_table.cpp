#include "reports/sections/time_table.hpp"

#include <fmt/format.h>

#include <vector>

#include "reports/statistics/family_class.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

constexpr const char* footnote =
    "early: t* - time, where t* is the exact earliest time, of times that are not after t*; late: of times "
    "that should be "
    "lower bounds;\nstuck: the time is 0, and t* is not\n";

/// The upper end of a bin, rounded; "-" if there are no times.
std::string shown(const Bin& bin, const Counts& counts) {
  return counts.times_given == 0 ? "-" : fmt::format("{:.2g}", bin.to);
}

}  // namespace

std::string time_table(const Statistics& statistics) {
  std::vector<std::vector<std::string>> rows{{"subject", "kind", "class", "times", "late", "stuck", "unknown",
                                              "early: median", "99 %", "most", "after t*"}};
  for (const auto& [key, sum] : by_class(statistics)) {
    const Counts& counts = sum.counts;
    if (counts.times_given == 0) continue;
    rows.push_back({key.subject, std::string(short_name(key.kind)), std::string(name(key.of)),
                    with_separators(counts.times_given), with_separators(counts.late),
                    with_separators(counts.stuck), with_separators(counts.unknown()),
                    shown(counts.early_quantile(0.5), counts), shown(counts.early_quantile(0.99), counts),
                    fmt::format("{:.2g}", counts.max_early()), fmt::format("{:.2g}", counts.max_after())});
  }
  return rows.size() == 1 ? "" : columns(rows, 3) + footnote;
}

}  // namespace nearmiss

#include "reports/sections/time_table.hpp"

#include <fmt/format.h>

#include <vector>

#include "reports/statistics/family_class.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

constexpr const char* footnote =
    "early: t* - time, where t* is the exact earliest time, of times that are not after t*; late: something "
    "happens before a "
    "time\nthat is to be a lower bound; stuck: the time is 0, and t* is not; invalid: a time that is none, "
    "or a "
    "collision without the time that\nis promised\n";

std::uint64_t invalid(const Counts& counts) {
  return counts.faults[static_cast<std::size_t>(Fault::invalid)];
}

/// The upper end of a bin, rounded.
std::string shown(const Bin& bin) { return fmt::format("{:.2g}", bin.to); }

}  // namespace

std::string time_table(const Statistics& statistics) {
  std::vector<std::vector<std::string>> rows{{"subject", "kind", "class", "sort", "times", "late", "stuck",
                                              "invalid", "unknown", "early: median", "99 %", "most",
                                              "after t*"}};
  for (const auto& [key, sum] : by_class(statistics)) {
    const Counts& counts = sum.counts;
    if (counts.times_given == 0 && invalid(counts) == 0) continue;
    rows.push_back({key.subject, std::string(short_name(key.kind)), std::string(name(key.of)),
                    std::string(name(counts.time_sort())), with_separators(counts.times_given),
                    late_times(counts), with_separators(counts.stuck), with_separators(invalid(counts)),
                    with_separators(counts.unknown()), shown(counts.early_quantile(0.5)),
                    shown(counts.early_quantile(0.99)), fmt::format("{:.2g}", counts.max_early()),
                    fmt::format("{:.2g}", counts.max_after())});
  }
  return rows.size() == 1 ? "" : columns(rows, 4) + footnote;
}

std::string late_times(const Counts& counts) {
  return counts.times_promised == 0 ? "-" : with_separators(counts.late);
}

}  // namespace nearmiss

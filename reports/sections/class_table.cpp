#include "reports/sections/class_table.hpp"

#include <set>
#include <vector>

#include "reports/sections/time_table.hpp"
#include "reports/statistics/family_class.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

std::string class_table(const Statistics& statistics) {
  std::vector<std::vector<std::string>> rows{
      {"subject", "kind", "class", "queries", "collisions", "false neg.", "late", "false pos.", "ns/query"}};
  std::set<QueryClass> classes;
  for (const auto& [key, sum] : by_class(statistics)) {
    const Counts& counts = sum.counts;
    classes.insert(key.of);
    rows.push_back({key.subject, std::string(short_name(key.kind)), std::string(name(key.of)),
                    with_separators(counts.queries), with_separators(counts.collisions),
                    with_separators(counts.false_negatives), late_times(counts),
                    with_separators(counts.false_positives), whole_ns(counts.times.ns_per_query())});
  }
  return classes.size() < 2 ? "" : columns(rows, 3);
}

}  // namespace nearmiss

#include "reports/sections/common_factors_table.hpp"

#include <fmt/format.h>

#include "reports/text/json.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

std::string to_text(const CommonFactors& common) {
  return fmt::format("{:.0f} % of the missed ones have {}, and {:.0f} % of all", 100 * common.share(),
                     common.key.values, 100 * common.share_of_collisions());
}

std::string common_factors_lines(const Statistics& statistics) {
  std::string lines;
  for (const CommonFactors& each : common_factors(statistics.factors))
    lines += fmt::format("{} {}, {}: {} of {} missed; {}\n", each.key.subject, short_name(each.key.kind),
                         each.key.family, with_separators(each.all.false_negatives),
                         counted(each.all.collisions, "collision", "collisions"), to_text(each));
  return lines;
}

nlohmann::ordered_json common_factors_json(const Statistics& statistics) {
  auto json = nlohmann::ordered_json::array();
  for (const CommonFactors& each : common_factors(statistics.factors))
    json.push_back({{"subject", each.key.subject},
                    {"kind", short_name(each.key.kind)},
                    {"family", each.key.family},
                    {"collisions", each.all.collisions},
                    {"false_negatives", each.all.false_negatives},
                    {"values", each.key.values},
                    {"share", each.share()},
                    {"share_of_collisions", each.share_of_collisions()},
                    {"text", to_text(each)}});
  return json;
}

}  // namespace nearmiss

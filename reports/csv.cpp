#include "reports/csv.hpp"

#include <fmt/format.h>

#include "corpus/query_text.hpp"
#include "reports/confidence.hpp"

namespace nearmiss {

namespace {

/// A text field: in quotes where it needs them.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace

std::string statistics_csv(const Statistics& statistics) {
  std::string text =
      "subject,kind,family,queries,collisions,positives,false_negatives,false_negative_rate_upper_95,"
      "false_positives,false_positive_rate,false_positive_rate_from,false_positive_rate_to,refuted_bounds,"
      "median_fp_distance_over_bound_from,median_fp_distance_over_bound_to,"
      "q99_fp_distance_over_bound_from,q99_fp_distance_over_bound_to,max_fp_distance_over_bound,ns_per_query";
  for (const auto fault : fault_names)
    if (fault != "none") text += fmt::format(",fault_{}", fault);
  text += ",median_ns,q99_ns";
  for (const auto stage : stage_names) text += fmt::format(",true_by_{}", stage);
  for (const auto stage : stage_names) text += fmt::format(",false_by_{}", stage);
  for (const auto rejection : rejection_names) text += fmt::format(",rejected_by_{}", rejection);
  text += '\n';
  for (const auto& [key, c] : statistics.counts) {
    const Interval rate = clopper_pearson(c.false_positives, c.others());
    const std::string upper =
        c.is_sample ? fmt::format("{}", clopper_pearson_upper(c.false_negatives, c.collisions)) : "";
    text += fmt::format("{},{},{},{},{},{},{},{},", field(key.subject), short_name(key.kind),
                        field(key.family), c.queries, c.collisions, c.positives, c.false_negatives, upper);
    const Bin median = c.ratio_quantile(0.5);
    const Bin q99 = c.ratio_quantile(0.99);
    text +=
        fmt::format("{},{},{},{},{},{},{},{},{},{},{}", c.false_positives, c.false_positive_rate(), rate.lo,
                    rate.hi, c.refuted_bounds, median.from, median.to, q99.from, q99.to, c.max_ratio(),
                    c.times.queries() == 0 ? "" : fmt::format("{}", c.times.ns_per_query()));
    for (std::size_t i = 1; i < fault_count; ++i) text += fmt::format(",{}", c.faults[i]);
    for (const double part : {0.5, 0.99})
      text += c.times.each.total() == 0 ? "," : fmt::format(",{:.0f}", c.times.each.quantile(part));
    for (const auto count : c.true_by_stage) text += fmt::format(",{}", count);
    for (const auto count : c.false_by_stage) text += fmt::format(",{}", count);
    for (const auto count : c.rejected_by) text += fmt::format(",{}", count);
    text += '\n';
  }
  return text;
}

std::string distances_csv(const Statistics& statistics) {
  std::string text = "subject,kind,family,distance_over_bound_from,distance_over_bound_to,false_positives\n";
  for (const auto& [key, counts] : statistics.counts)
    for (std::size_t i = 0; i < Histogram::bin_count; ++i)
      if (const auto count = counts.distances.bins[i]; count != 0)
        text += fmt::format("{},{},{},{},{},{}\n", field(key.subject), short_name(key.kind),
                            field(key.family), Histogram::border(i), Histogram::border(i + 1), count);
  return text;
}

std::string findings_csv(const Campaign& campaign) {
  std::string text = "what,subject,signature,seen,kind,family,provenance,distance_over_bound,shrunk,query\n";
  for (const Finding& f : campaign.findings())
    text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", name(f.what), field(f.subject), field(f.signature),
                        campaign.statistics.times_seen(signature_of(f)), short_name(f.query.kind),
                        field(f.family), field(f.provenance), f.ratio, to_line(f.shrunk), to_line(f.query));
  return text;
}

}  // namespace nearmiss

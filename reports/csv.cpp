#include "reports/csv.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "corpus/query_text.hpp"
#include "reports/statistics/confidence.hpp"
#include "reports/statistics/family.hpp"
#include "reports/statistics/family_class.hpp"

namespace nearmiss {

namespace {

/// A text field, in quotes if it needs them. An apostrophe keeps spreadsheets from computing what begins like a formula.
std::string field(std::string text) {
  if (text.find_first_of("=+-@") == 0) text.insert(0, 1, '\'');
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

/// A row of statistics.csv or classes.csv.
struct CsvRow {
  CountsKey key;  ///< `family` is a family or a class
  CountsSum sum;
};

/// A column: its heading, and its field in a row.
struct CsvColumn {
  std::string heading;
  std::function<std::string(const CsvRow&)> field;
};
using CsvColumns = std::vector<CsvColumn>;

/// Adds a column of numbers; `number` computes one from the counters.
template <class Number>
void add_column(CsvColumns& columns, std::string heading, const Number& number) {
  columns.push_back({std::move(heading), [number](const CsvRow& row) {
                       return fmt::format("{}", std::invoke(number, row.sum.counts));
                     }});
}

/// Adds the two columns of a range; `range` computes it from the counters.
template <class Range>
void add_range(CsvColumns& columns, const std::string& name, const Range& range) {
  add_column(columns, name + "_from", [range](const Counts& counts) { return range(counts).from; });
  add_column(columns, name + "_to", [range](const Counts& counts) { return range(counts).to; });
}

void add_quantile(CsvColumns& columns, const std::string& name, double part) {
  add_range(columns, name + "_fp_distance_over_bound",
            [part](const Counts& counts) { return counts.ratio_quantile(part); });
}

std::string upper_bound_of_misses(const CsvRow& row) {
  if (!row.sum.is_sample) return "";
  return fmt::format("{}", clopper_pearson_upper(row.sum.counts.false_negatives, row.sum.counts.collisions));
}

/// Adds the columns that are computed from this counter.
void add_computed(CsvColumns& columns, std::uint64_t Counts::*counter) {
  if (counter == &Counts::false_negatives)
    columns.push_back({"false_negative_rate_upper_95", upper_bound_of_misses});
  if (counter == &Counts::false_positives) {
    add_column(columns, "false_positive_rate", &Counts::false_positive_rate);
    add_range(columns, "false_positive_rate", [](const Counts& c) {
      const ConfidenceInterval interval = clopper_pearson(c.false_positives, c.others());
      return Bin{interval.lo, interval.hi};
    });
  }
  if (counter == &Counts::refuted_bounds) {
    add_quantile(columns, "median", 0.5);
    add_quantile(columns, "q99", 0.99);
    add_column(columns, "max_fp_distance_over_bound", &Counts::max_ratio);
    columns.push_back({"ns_per_query", [](const CsvRow& row) {
                         const auto ns = row.sum.counts.times.ns_per_query();
                         return ns ? fmt::format("{}", *ns) : "";
                       }});
  }
}

/// Adds the columns of times that are computed after this counter.
void add_times(CsvColumns& columns, std::uint64_t Counts::*counter) {
  if (counter != &Counts::stuck) return;
  add_column(columns, "unknown", &Counts::unknown);
  for (const auto& [name, part] : {std::pair{"median_early", 0.5}, {"q99_early", 0.99}})
    add_range(columns, name, [part = part](const Counts& counts) { return counts.early_quantile(part); });
  add_column(columns, "max_early", &Counts::max_early);
  add_column(columns, "max_after", &Counts::max_after);
  add_range(columns, "q99_travelled", [](const Counts& counts) { return counts.travelled.quantile(0.99); });
}

void add_counter(CsvColumns& columns, const Counter<Counts, std::uint64_t>& counter) {
  add_column(columns, std::string(counter.name), counter.member);
  add_computed(columns, counter.member);
  add_times(columns, counter.member);
}

template <std::size_t size>
void add_counter(CsvColumns& columns, const NamedCounts<Counts, size>& counter) {
  for (std::size_t i = counter.first; i < size; ++i)
    add_column(columns, fmt::format("{}_{}", counter.csv_prefix, counter.names[i]),
               [member = counter.member, i](const Counts& c) { return (c.*member)[i]; });
}

void add_time_quantile(CsvColumns& columns, std::string heading, double part) {
  columns.push_back({std::move(heading), [part](const CsvRow& row) {
                       const auto time = row.sum.counts.times.each.quantile(part);
                       return time ? fmt::format("{:.0f}", *time) : "";
                     }});
}

void add_counter(CsvColumns& columns, const Counter<Counts, SubjectTimes>& /*counter*/) {
  add_time_quantile(columns, "median_ns", 0.5);
  add_time_quantile(columns, "q99_ns", 0.99);
}

/// These members have no column: distances.csv and times.csv have the histograms, and case files have the farthest false
/// positives.
template <class Member>
void add_counter(CsvColumns& /*columns*/, const Counter<Counts, Member>& /*counter*/) {}

/// The columns; `of` is the heading of the rows' families or classes.
CsvColumns columns_of(const std::string& of) {
  CsvColumns columns{{"subject", [](const CsvRow& row) { return field(row.key.subject); }},
                     {"kind", [](const CsvRow& row) { return std::string(short_name(row.key.kind)); }},
                     {of, [](const CsvRow& row) { return field(row.key.family); }}};
  for_each_counter<Counts>([&](const auto& counter) { add_counter(columns, counter); });
  return columns;
}

std::string as_csv(const CsvColumns& columns, const std::vector<CsvRow>& rows) {
  std::vector<std::string> fields;
  for (const CsvColumn& column : columns) fields.push_back(column.heading);
  std::string text = fmt::format("{}\n", fmt::join(fields, ","));
  for (const CsvRow& row : rows) {
    for (std::size_t i = 0; i < columns.size(); ++i) fields[i] = columns[i].field(row);
    text += fmt::format("{}\n", fmt::join(fields, ","));
  }
  return text;
}

}  // namespace

std::string statistics_csv(const Statistics& statistics) {
  CsvColumns columns = columns_of("family");
  columns.push_back({"class", [](const CsvRow& row) { return std::string(name(class_of(row.key.family))); }});
  std::vector<CsvRow> rows;
  for (const auto& [key, counts] : statistics.counts) rows.push_back({key, {counts, is_random(key.family)}});
  return as_csv(columns, rows);
}

std::string classes_csv(const Statistics& statistics) {
  std::vector<CsvRow> rows;
  for (const auto& [key, sum] : by_class(statistics))
    rows.push_back({{key.subject, key.kind, std::string(name(key.of))}, sum});
  return as_csv(columns_of("class"), rows);
}

std::string distances_csv(const Statistics& statistics) {
  std::string text =
      "subject,kind,family,distance_over_bound_from,distance_over_bound_to,false_positives,bound\n";
  for (const auto& [key, counts] : statistics.counts)
    for (std::size_t i = 0; i < Histogram::bin_count; ++i)
      if (const auto count = counts.distances.bins[i]; count != 0)
        text +=
            fmt::format("{},{},{},{},{},{},{}\n", field(key.subject), short_name(key.kind), field(key.family),
                        Histogram::border(i), Histogram::border(i + 1), count, name(counts.distance_unit()));
  return text;
}

std::string times_csv(const Statistics& statistics) {
  std::string text = "subject,kind,family,side,error_from,error_to,times\n";
  for (const auto& [key, counts] : statistics.counts)
    for (const auto& [side, histogram] : {std::pair{"early", &counts.early}, {"after", &counts.after}})
      for (std::size_t i = 0; i < Histogram::bin_count; ++i)
        if (const auto count = histogram->bins[i]; count != 0)
          text += fmt::format("{},{},{},{},{},{},{}\n", field(key.subject), short_name(key.kind),
                              field(key.family), side, Histogram::border(i), Histogram::border(i + 1), count);
  return text;
}

std::string findings_csv(const Campaign& campaign) {
  std::string text =
      "what,subject,signature,seen,kind,family,provenance,distance_over_bound,late_by,class,shrunk,query\n";
  for (const Finding& f : campaign.findings())
    text +=
        fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", name(f.what), field(f.subject),
                    field(f.signature), campaign.statistics.times_seen(signature_of(f)),
                    short_name(f.query.kind), field(f.family), field(f.provenance),
                    f.what == Finding::What::late ? 0 : f.ratio, f.what == Finding::What::late ? f.ratio : 0,
                    name(f.query_class), to_line(f.shrunk), to_line(f.query));
  return text;
}

}  // namespace nearmiss

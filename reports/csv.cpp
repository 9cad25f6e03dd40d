#include "reports/csv.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>
#include <variant>
#include <vector>

#include "corpus/query_text.hpp"
#include "reports/sections/measures.hpp"
#include "reports/statistics/confidence.hpp"
#include "reports/statistics/family.hpp"

namespace nearmiss {

namespace {

/// A text field, in quotes if it needs them. A text that begins like a formula gets an apostrophe in front,
/// so that spreadsheets do not evaluate it.
std::string field(std::string text) {
  if (text.find_first_of("=+-@") == 0) text.insert(0, 1, '\'');
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

struct Field {
  std::string heading, text;
};
using Fields = std::vector<Field>;

/// Adds a field for a value, or two fields for the two ends of a range.
struct AddField {
  Fields& fields;
  const std::string& heading;

  void operator()(std::monostate /*nothing*/) const { fields.push_back({heading, ""}); }
  void operator()(const Bin& range) const {
    fields.push_back({heading + "_from", fmt::format("{}", range.from)});
    fields.push_back({heading + "_to", fmt::format("{}", range.to)});
  }
  template <class Simple>
  void operator()(const Simple& value) const {
    fields.push_back({heading, fmt::format("{}", value)});
  }
};

void add(Fields& fields, const std::string& heading, const Value& value) {
  std::visit(AddField{fields, heading}, value);
}

void add_counter(Fields& fields, const Counts& counts, const Counter<Counts, std::uint64_t>& counter) {
  add(fields, std::string(counter.name), counts.*counter.member);
}

template <std::size_t size>
void add_counter(Fields& fields, const Counts& counts, const NamedCounts<Counts, size>& counter) {
  for (std::size_t i = counter.first; i < size; ++i)
    add(fields, fmt::format("{}_{}", counter.csv_prefix, counter.names[i]), (counts.*counter.member)[i]);
}

void add_counter(Fields& fields, const Counts& counts, const Counter<Counts, SubjectTimes>& /*counter*/) {
  for (const auto& [heading, part] : {std::pair{"median_ns", 0.5}, {"q99_ns", 0.99}}) {
    const auto time = counts.times.each.quantile(part);
    fields.push_back({heading, time ? fmt::format("{:.0f}", *time) : ""});
  }
}

/// Members of any other type get no field: the histograms are in distances.csv and times.csv, and the
/// farthest false positives are in case files.
template <class Member>
void add_counter(Fields& /*fields*/, const Counts& /*counts*/, const Counter<Counts, Member>& /*counter*/) {}

/// The confidence interval of the rate of false positives. statistics.csv has this interval for every family,
/// even if the family's queries are not a random sample.
Value interval_of_false_positives(const Counts& counts) {
  const auto [lo, hi] = clopper_pearson(counts.false_positives, counts.others());
  return Bin{lo, hi};
}

/// Adds all counters and, after each counter, the measures that are computed from it.
void add_counters(Fields& fields, const CountsSum& sum) {
  for_each_counter<Counts>([&](const auto& counter) {
    add_counter(fields, sum.counts, counter);
    for (const Measure& each : rate_measures())
      if (each.csv_after == counter.name) add(fields, std::string(each.key), each.value(sum));
    if (counter.name == "false_positives")
      add(fields, "false_positive_rate", interval_of_false_positives(sum.counts));
  });
}

/// The fields of a row of statistics.csv or classes.csv: the key, then the counters. `of` is the heading of
/// the column with `key.family`: "family" or "class".
Fields fields_of(const CountsKey& key, const char* of, const CountsSum& sum) {
  Fields fields{
      {"subject", field(key.subject)}, {"kind", std::string(short_name(key.kind))}, {of, field(key.family)}};
  add_counters(fields, sum);
  return fields;
}

std::string line(const Fields& fields, std::string Field::*part) {
  std::vector<std::string> parts;
  for (const Field& each : fields) parts.push_back(each.*part);
  return fmt::format("{}\n", fmt::join(parts, ","));
}

/// The text of a CSV file with `rows`. The headings are taken from `any`, which is an example of a row,
/// because `rows` may be empty.
std::string as_csv(const Fields& any, const std::vector<Fields>& rows) {
  std::string text = line(any, &Field::heading);
  for (const Fields& row : rows) text += line(row, &Field::text);
  return text;
}

}  // namespace

std::string statistics_csv(const Statistics& statistics) {
  const auto row = [](const CountsKey& key, const Counts& counts) {
    Fields fields = fields_of(key, "family", {counts, is_random(key.family)});
    fields.push_back({"class", std::string(name(class_of(key.family)))});
    return fields;
  };
  std::vector<Fields> rows;
  for (const auto& [key, counts] : statistics.counts) rows.push_back(row(key, counts));
  return as_csv(row({}, {}), rows);
}

std::string classes_csv(const Statistics& statistics) {
  std::vector<Fields> rows;
  for (const auto& [key, sum] : by_class(statistics))
    rows.push_back(fields_of({key.subject, key.kind, std::string(name(key.of))}, "class", sum));
  return as_csv(fields_of({}, "class", {}), rows);
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

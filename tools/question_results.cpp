#include "tools/question_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "corpus/query_text.hpp"
#include "reports/text/json.hpp"
#include "reports/text/text.hpp"

namespace nearmiss::tools {

using nlohmann::ordered_json;

namespace {

using Distances = QuestionResults<DistanceQuestion>;
using Steps = QuestionResults<StepQuestion>;
using KeptCounts = decltype(StepQuestion::Counts::kept);
using Findings = std::vector<QuestionFinding>;

// --- text -----------------------------------------------------------------------------------------------

std::string number(double error) { return error == 0 ? "0" : fmt::format("{:.2g}", error); }

double largest(const std::vector<FarCase>& cases) { return cases.empty() ? 0 : cases.front().ratio; }

/// The sum of the counts of all classes, then the count of each class: "3 (2 ordinary, 1 extreme)".
std::string by_class(const QueryClassCounts& counts) {
  std::string classes;
  for (std::size_t i = 0; i < class_names.size(); ++i)
    if (counts[i] > 0)
      classes +=
          fmt::format("{}{} {}", classes.empty() ? "" : ", ", with_separators(counts[i]), class_names[i]);
  return with_separators(sum(counts)) + (classes.empty() ? "" : " (" + classes + ")");
}

std::string table(const Distances& results) {
  std::vector<std::vector<std::string>> rows{{"subject", "kind", "distances", "over-reported", "largest",
                                              "under-reported", "largest", "wrong weights", "faults"}};
  for (const auto& [key, counts] : results.counts)
    rows.push_back({key.first, std::string(short_name(key.second)), with_separators(counts.queries),
                    by_class(counts.over_by_class), number(largest(counts.largest_over)),
                    by_class(counts.under_by_class), number(largest(counts.largest_under)),
                    by_class(counts.weights_by_class), by_class(counts.faults_by_class)});
  return columns(rows, rows.front().size()) +
         fmt::format(
             "over- and under-reported: off by more than {:.0f} % and {:.0e} of the size; largest: "
             "of all errors, divided by the size\n",
             100 * DistanceError::part_of_distance, DistanceError::part_of_size);
}

/// The quantile for the probability `part` of StepQuestion::Counts::kept.
std::string percentage(const KeptCounts& kept, double part) {
  const auto bin = quantile_bin(kept, part);
  return bin == kept.end() ? "-" : fmt::format("{} %", bin - kept.begin());
}

std::string table(const Steps& results) {
  std::vector<std::vector<std::string>> rows{{"subject", "kind", "steps", "unsafe", "kept, median", "1 %",
                                              "cut without contact", "changed again", "faults"}};
  for (const auto& [key, counts] : results.counts)
    rows.push_back({key.first, std::string(short_name(key.second)), with_separators(counts.queries),
                    by_class(counts.unsafe_by_class), percentage(counts.kept, 0.5),
                    percentage(counts.kept, 0.01), with_separators(counts.cut_free),
                    with_separators(counts.objects), by_class(counts.faults_by_class)});
  return columns(rows, rows.front().size()) +
         "unsafe: the filtered step touches, or comes nearer than the claimed clearance; kept: at least this "
         "part of the motion before contact\n";
}

/// Lines about subjects that are right in one range of a property of the queries, such as an angle, and fail
/// elsewhere. Each line is about one subject, kind and property. `unsafe` is the word for a failure.
std::string ranges(const FactorTable& factors, const char* unsafe) {
  std::string lines;
  for (const RightRange& each : right_ranges(factors))
    if (each.exponents && each.elsewhere.false_negatives > 0)
      lines += fmt::format("{} {}: right with {} = 2^{} to 2^{}; {} {} of {} elsewhere\n", each.subject,
                           short_name(each.kind), each.factor, each.exponents->first, each.exponents->second,
                           unsafe, with_separators(each.elsewhere.false_negatives),
                           with_separators(each.elsewhere.collisions));
  return lines;
}

/// The vertices of a query: "0 0 1, 1 0 0". If the vertices move, "to" and their places at t = 1 follow.
/// Numbers that are exact as decimals are printed as decimals.
std::string places(const Query& query) {
  const auto at = [&](std::size_t time) {
    std::string text;
    for (int i = 0; i < vertices(query.kind); ++i) {
      const std::size_t first = 12 * time + 3 * static_cast<std::size_t>(i);
      text += fmt::format("{}{} {} {}", i == 0 ? "" : ", ", to_exact(query.x[first]),
                          to_exact(query.x[first + 1]), to_exact(query.x[first + 2]));
    }
    return text;
  };
  const bool moves = !std::equal(query.x.begin(), query.x.begin() + 12, query.x.begin() + 12);
  return at(0) + (moves ? " to " + at(1) : "");
}

std::string simplest(const Findings& findings) {
  if (findings.empty()) return "";
  constexpr std::size_t most = 8;
  std::string text = "\nthe simplest failures, and the places of their vertices:\n";
  for (const QuestionFinding& each : std::span(findings).first(std::min(most, findings.size())))
    text += fmt::format("{} {}, {}: {} ({})\n    {}\n", each.subject, each.signature, name(each.query_class),
                        each.text, each.provenance, places(each.query));
  if (findings.size() > most)
    text += fmt::format("and {}; --json has all\n", counted(findings.size() - most, "other", "others"));
  return text;
}

// --- JSON -----------------------------------------------------------------------------------------------

constexpr std::array quantiles{std::pair{"p01", 0.01}, std::pair{"median", 0.5}, std::pair{"p99", 0.99}};

ordered_json json_of(const Histogram& histogram) {
  ordered_json json;
  for (const auto& [name, part] : quantiles) {
    const Bin bin = histogram.quantile(part);
    json[name] = {bin.from, std::isfinite(bin.to) ? ordered_json(bin.to) : ordered_json(nullptr)};
  }
  json["bins"] = histogram.bins;
  return json;
}

/// Quantiles of StepQuestion::Counts::kept in percent (null if there are none), and the count of each percent.
ordered_json json_of(const KeptCounts& kept) {
  ordered_json json;
  for (const auto& [name, part] : quantiles) {
    const auto bin = quantile_bin(kept, part);
    json[name] = bin == kept.end() ? ordered_json(nullptr) : ordered_json(bin - kept.begin());
  }
  json["counts"] = kept;
  return json;
}

ordered_json json_of(const QueryClassCounts& counts) {
  auto json = ordered_json::object();
  for (std::size_t i = 0; i < class_names.size(); ++i)
    if (counts[i] > 0) json[std::string(class_names[i])] = counts[i];
  return json;
}

ordered_json first_of(const std::vector<FarCase>& cases) {
  if (cases.empty()) return nullptr;
  return {{"value", cases.front().ratio},
          {"query", to_line(cases.front().query)},
          {"provenance", cases.front().provenance}};
}

ordered_json json_of(const DistanceQuestion::Counts& counts) {
  return {{"queries", counts.queries},
          {"faults", sum(counts.faults_by_class)},
          {"faults_by_class", json_of(counts.faults_by_class)},
          {"over_reported", sum(counts.over_by_class)},
          {"over_reported_by_class", json_of(counts.over_by_class)},
          {"under_reported", sum(counts.under_by_class)},
          {"under_reported_by_class", json_of(counts.under_by_class)},
          {"wrong_weights", sum(counts.weights_by_class)},
          {"wrong_weights_by_class", json_of(counts.weights_by_class)},
          {"over_by_size", json_of(counts.over_by_size)},
          {"over_by_distance", json_of(counts.over_by_distance)},
          {"under_by_size", json_of(counts.under_by_size)},
          {"under_by_distance", json_of(counts.under_by_distance)},
          {"largest_over", first_of(counts.largest_over)},
          {"largest_under", first_of(counts.largest_under)}};
}

ordered_json json_of(const StepQuestion::Counts& counts) {
  return {{"queries", counts.queries},
          {"faults", sum(counts.faults_by_class)},
          {"faults_by_class", json_of(counts.faults_by_class)},
          {"unsafe", sum(counts.unsafe_by_class)},
          {"unsafe_by_class", json_of(counts.unsafe_by_class)},
          {"cut_without_contact", counts.cut_free},
          {"changed_again", counts.objects},
          {"kept", json_of(counts.kept)},
          {"least_kept", first_of(counts.least_kept)}};
}

ordered_json json_of(const QuestionFinding& finding) {
  ordered_json json{{"what", finding.what},
                    {"subject", finding.subject},
                    {"kind", short_name(finding.query.kind)},
                    {"signature", finding.signature},
                    {"class", name(finding.query_class)},
                    {"provenance", finding.provenance},
                    {"text", finding.text},
                    {"places", places(finding.query)},
                    {"query", to_line(finding.query)},
                    {"answer", finding.answer}};
  if (!finding.certificate.empty()) json["certificate"] = finding.certificate;
  return json;
}

ordered_json json_of(const RightRange& range) {
  ordered_json json{{"subject", range.subject},
                    {"kind", short_name(range.kind)},
                    {"factor", range.factor},
                    {"from", nullptr},
                    {"to", nullptr},
                    {"unsafe_elsewhere", range.elsewhere.false_negatives},
                    {"answers_elsewhere", range.elsewhere.collisions}};
  if (range.exponents) std::tie(json["from"], json["to"]) = *range.exponents;
  return json;
}

template <class Question>
ordered_json json_of_results(const QuestionResults<Question>& results) {
  ordered_json json{{"subjects", ordered_json::object()},
                    {"right", ordered_json::array()},
                    {"by_factor", ordered_json::array()},
                    {"findings", ordered_json::array()}};
  for (const auto& [key, counts] : results.counts)
    json["subjects"][key.first][std::string(short_name(key.second))] = json_of(counts);
  for (const RightRange& each : right_ranges(results.factors))
    if (!each.too_few) json["right"].push_back(json_of(each));
  for (const auto& [key, counts] : results.factors)
    if (!key.values.empty() && key.values.find(' ') == std::string::npos)
      json["by_factor"].push_back({{"subject", key.subject},
                                   {"kind", short_name(key.kind)},
                                   {"family", key.family},
                                   {"value", key.values},
                                   {"answers", counts.collisions},
                                   {"unsafe", counts.false_negatives}});
  for (const QuestionFinding& each : results.findings) json["findings"].push_back(json_of(each));
  return json;
}

/// Copies the members `keys` of an object.
template <class T>
void copy_members(const ordered_json& from, ordered_json& to, const std::vector<const char*>& keys) {
  for (const char* key : keys) to[key] = from.at(key).get<T>();
}

double value_of(const ordered_json& extreme) {
  return extreme.is_null() ? 0 : extreme.at("value").get<double>();
}

}  // namespace

std::string text_of(const Distances& results) {
  return table(results) + ranges(results.factors, "over-reports") + simplest(results.findings);
}

std::string text_of(const Steps& results) {
  return table(results) + ranges(results.factors, "unsafe in") + simplest(results.findings);
}

ordered_json json_of(const Distances& results) { return json_of_results(results); }
ordered_json json_of(const Steps& results) { return json_of_results(results); }

ordered_json distances_section(const ordered_json& results) {
  ordered_json section{{"run", ordered_json::object()}, {"counts", ordered_json::array()}};
  for (const auto& [fact, value] : results.at("run").items()) section["run"][fact] = value.get<std::string>();
  for (const auto& [subject, kinds] : results.at("subjects").items())
    for (const auto& [kind, counts] : kinds.items()) {
      ordered_json& row = section["counts"].emplace_back(ordered_json{{"subject", subject}, {"kind", kind}});
      copy_members<std::uint64_t>(counts, row,
                                  {"queries", "over_reported", "under_reported", "wrong_weights", "faults"});
      row["ordinary"] = counts.at("over_reported_by_class").value("ordinary", std::uint64_t{0});
      row["largest_over"] = value_of(counts.at("largest_over"));
      row["largest_under"] = value_of(counts.at("largest_under"));
    }
  for (const char* list : {"right", "findings"}) section[list] = ordered_json::array();
  for (const auto& range : results.at("right")) {
    ordered_json& row = section["right"].emplace_back();
    copy_members<std::string>(range, row, {"subject", "kind", "factor"});
    for (const char* key : {"from", "to"})
      row[key] = range.at(key).is_null() ? ordered_json(nullptr) : ordered_json(range.at(key).get<int>());
    copy_members<std::uint64_t>(range, row, {"unsafe_elsewhere", "answers_elsewhere"});
  }
  for (const auto& finding : results.at("findings"))
    copy_members<std::string>(finding, section["findings"].emplace_back(),
                              {"subject", "signature", "class", "text", "places", "query", "provenance"});
  return section;
}

}  // namespace nearmiss::tools

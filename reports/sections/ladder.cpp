#include "reports/sections/sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "ccd/query/scalar_name.hpp"
#include "ccd/wang/bounds/tight_tolerances.hpp"
#include "reports/sections/measures.hpp"
#include "reports/statistics/confidence.hpp"
#include "reports/statistics/family.hpp"
#include "reports/text/json.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

constexpr std::array algorithms{"wang", "wang-tight"};
constexpr int finest = -127;
constexpr int coarsest = -23;
constexpr int double_exponent = -52;

/// A subject of the precision ladder (one algorithm in several scalar types). Distances are in units of B,
/// the size of a query's pair.
struct Rung : LadderPlace {
  std::string subject;
  CountsSum sum;  ///< the sum of the subject's counters over all families and kinds

  [[nodiscard]] double claimed() const { return *unit; }
  /// Distance of the farthest false positive, divided by the claimed bound; 0 if there is no false positive.
  [[nodiscard]] double part() const { return sum.counts.max_ratio(); }
  /// Distance of the farthest false positive; 0 if there is no false positive.
  [[nodiscard]] double farthest() const { return part() * claimed(); }
};

/// Says which power of ε the farthest distance follows. The fit is a line, by the method of least squares. It
/// has one point for each scalar of an algorithm: the logarithms of ε and of the farthest distance. A fit
/// uses the queries of one origin, or of all origins.
struct Fit {
  std::string algorithm, origin;
  double exponent = 0, standard_error = 0;
  double half_width_95 = 0;                  ///< half-width of the exponent's 95 % confidence interval
  int points = 0;                            ///< number of rungs
  int precisions = 0;                        ///< number of different ε
  double least_part = 0, greatest_part = 0;  ///< range of Rung::part()

  /// Whether the farthest false positive of every rung almost reaches the claimed bound. If so, the fit only
  /// repeats the exponent in the formula of the claim.
  [[nodiscard]] bool restates_the_bound() const { return least_part > 0.9; }
};

/// The distance bound that an algorithm claims for ε = 2^exponent, in units of B, the size of a pair.
double claimed_distance(const std::string& algorithm, int exponent) {
  const ToleranceConstants c = algorithm == "wang" ? closed_forms(exponent) : solve_tight(exponent);
  return tolerances_of(c, std::exp2(exponent), 1.0).distance_bound();
}

/// Whether the value of Rung::part() is known. Below the lowest border of the histogram, the value is not
/// known; the border is only its upper bound.
bool is_measured(const Rung& rung) { return rung.part() >= Histogram::border(1); }

bool is_ladder(const std::vector<Rung>& all) {
  std::map<std::string, std::set<int>> exponents;
  for (const Rung& rung : all) exponents[rung.algorithm].insert(rung.epsilon_exponent);
  return std::any_of(exponents.begin(), exponents.end(),
                     [](const auto& each) { return each.second.size() > 1; });
}

}  // namespace

LadderPlace place_of(const std::string& subject) {
  const auto [algorithm, scalar] = split_scalar(subject);
  const auto exponent = epsilon_exponent_of(scalar);
  const std::string given_bound = subject.substr(std::min(subject.rfind('@'), subject.size()));
  if (!exponent) return {subject, "double", double_exponent, std::nullopt};
  LadderPlace place{std::string(algorithm) + given_bound, scalar.empty() ? "double" : std::string(scalar),
                    *exponent, std::nullopt};
  if (!given_bound.empty()) return place;
  const auto name = algorithm.substr(0, algorithm.find(':'));  // without options
  // basic, basic-plain and bridson claim no bound, so wang's bound is the unit of their distances.
  if (name == "basic" || name == "basic-plain" || name == "bridson")
    place.unit = claimed_distance("wang", double_exponent);
  else if (name == "wang-tight")
    place.unit = claimed_distance("wang-tight", *exponent);
  else if (name == "wang" || name == "wang-scalar" || name == "wang-eps" || name == "wang-plain" ||
           name == "wang-no-planes")
    place.unit = claimed_distance("wang", *exponent);
  return place;
}

nlohmann::ordered_json place_json(const LadderPlace& place) {
  return {{"algorithm", place.algorithm},
          {"scalar", place.scalar},
          {"epsilon", std::exp2(place.epsilon_exponent)}};
}

namespace {

/// The rungs (subjects of the precision ladder) of wang and wang-tight, one for each scalar in the
/// statistics, in the order of ascending precision. Counts only queries of the origin `only` (family.hpp), or
/// of all origins if `only` is "".
std::vector<Rung> rungs(const Statistics& statistics, std::string_view only = "") {
  std::map<std::string, CountsSum> by_subject;
  // The fits test the exponent of ε in the distance bound 41 B ε^¼, where B is the size of the pair. This
  // bound holds for vertex-triangle and edge-edge.
  for (const auto& [key, counts] : statistics.counts)
    if (is_of_meshes(key.kind) && (only.empty() || origin(key.family) == only))
      by_subject[key.subject].add(key.family, counts);
  std::vector<Rung> all;
  for (auto& [subject, sum] : by_subject)
    if (LadderPlace place = place_of(subject);
        std::find(algorithms.begin(), algorithms.end(), place.algorithm) != algorithms.end())
      all.push_back({std::move(place), subject, std::move(sum)});
  std::stable_sort(all.begin(), all.end(),
                   [](const Rung& a, const Rung& b) { return a.epsilon_exponent > b.epsilon_exponent; });
  return all;
}

/// The binary logarithms of a rung's ε and farthest distance.
struct LogPoint {
  double x = 0, y = 0;
};

/// Fits a line to the points by least squares. Returns its slope and the slope's standard error.
std::pair<double, double> slope(const std::vector<LogPoint>& points) {
  const auto n = static_cast<double>(points.size());
  LogPoint mean;
  for (const auto& [x, y] : points) {
    mean.x += x / n;
    mean.y += y / n;
  }
  double xx = 0;
  double xy = 0;
  for (const auto& [x, y] : points) {
    xx += (x - mean.x) * (x - mean.x);
    xy += (x - mean.x) * (y - mean.y);
  }
  double residual = 0;
  for (const auto& [x, y] : points) residual += std::pow(y - mean.y - xy / xx * (x - mean.x), 2);
  return {xy / xx, std::sqrt(residual / (n - 2) / xx)};
}

/// Fits a line to those rungs of an algorithm whose ε is from 2^-127 to 2^-23 and whose farthest false
/// positive is_measured(). Nothing for fewer than three values of ε.
std::optional<Fit> fit(const std::vector<Rung>& rungs, const std::string& algorithm) {
  std::vector<LogPoint> points;
  std::set<int> precisions;
  Fit line;
  line.algorithm = algorithm;
  line.least_part = std::numeric_limits<double>::infinity();
  for (const Rung& rung : rungs) {
    if (rung.algorithm != algorithm || !is_measured(rung)) continue;
    if (rung.epsilon_exponent > coarsest || rung.epsilon_exponent < finest) continue;
    points.push_back({static_cast<double>(rung.epsilon_exponent), std::log2(rung.farthest())});
    precisions.insert(rung.epsilon_exponent);
    line.least_part = std::min(line.least_part, rung.part());
    line.greatest_part = std::max(line.greatest_part, rung.part());
  }
  if (precisions.size() < 3) return std::nullopt;
  std::tie(line.exponent, line.standard_error) = slope(points);
  line.half_width_95 = line.standard_error * student_t_quantile_975(points.size() - 2);
  line.points = static_cast<int>(points.size());
  line.precisions = static_cast<int>(precisions.size());
  return line;
}

/// The fits of each algorithm: one over all origins, and one for each origin.
std::vector<Fit> fits(const Statistics& statistics) {
  std::set<std::string> origins{""};
  for (const auto& [key, counts] : statistics.counts) origins.emplace(origin(key.family));
  std::vector<Fit> all;
  for (const std::string algorithm : algorithms)
    for (const std::string& each : origins)
      if (auto line = fit(rungs(statistics, each), algorithm)) {
        line->origin = each;
        all.push_back(*line);
      }
  return all;
}

std::string to_text(const Fit& line) {
  const std::string of = line.algorithm + (line.origin.empty() ? "" : ", " + line.origin);
  const std::string from = fmt::format("{} subjects with {} precisions", line.points, line.precisions);
  const std::string parts =
      fmt::format("{} to {} of the claimed distance", fraction_of_bound(line.least_part),
                  fraction_of_bound(line.greatest_part));
  if (line.restates_the_bound()) return fmt::format("{}: the farthest are at {} for {}", of, parts, from);
  return fmt::format("{}: the farthest distance goes as epsilon^({:.4f} +- {:.2g}, 95 %), from {}; at {}", of,
                     line.exponent, line.half_width_95, from, parts);
}

}  // namespace

nlohmann::ordered_json ladder_json(const Statistics& statistics) {
  nlohmann::ordered_json json;
  const std::vector<Rung> all = rungs(statistics);
  if (!is_ladder(all)) return json;
  json["rungs"] = nlohmann::ordered_json::array();
  for (const Rung& rung : all) {
    nlohmann::ordered_json row{{"subject", rung.subject}};
    row.update(place_json(rung));
    row.update({{"claimed", rung.claimed()}, {"farthest", rung.farthest()}});
    row.update(rates_json(rung.sum));
    json["rungs"].push_back(std::move(row));
  }
  json["fits"] = nlohmann::ordered_json::array();
  for (const Fit& line : fits(statistics))
    json["fits"].push_back({{"algorithm", line.algorithm},
                            {"origin", line.origin},
                            {"exponent", line.exponent},
                            {"standard_error", line.standard_error},
                            {"half_width_95", line.half_width_95},
                            {"points", line.points},
                            {"precisions", line.precisions},
                            {"least_part_of_claimed", line.least_part},
                            {"greatest_part_of_claimed", line.greatest_part},
                            {"restates_the_bound", line.restates_the_bound()}});
  return json;
}

std::string ladder_table(const Statistics& statistics) {
  const std::vector<Rung> all = rungs(statistics);
  if (!is_ladder(all)) return "";
  std::vector<std::vector<std::string>> rows{
      {"subject", "epsilon", "queries", "missed", "false pos.", "farthest / B", "claimed / B", "ns/query"}};
  for (const Rung& rung : all) {
    auto cells = row_of({rung.subject, fmt::format("2^{}", rung.epsilon_exponent)},
                        {"queries", "false_negatives", "false_positives"}, rung.sum);
    cells.push_back(fmt::format("{:.3g}", rung.farthest()));
    cells.push_back(fmt::format("{:.3g}", rung.claimed()));
    rows.push_back(row_of(std::move(cells), {"ns_per_query"}, rung.sum));
  }
  std::string text = "\n" + columns(rows, 1);
  for (const Fit& line : fits(statistics))
    if (line.origin.empty()) text += to_text(line) + "\n";
  return text;
}

}  // namespace nearmiss

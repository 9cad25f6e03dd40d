#include "tools/bench_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>
#include <string_view>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "corpus/file.hpp"
#include "reports/text/json.hpp"
#include "reports/text/text.hpp"

namespace nearmiss::tools {

namespace {

/// Times as JSON. JSON has no NaN, so a missing time is null.
nlohmann::ordered_json times_to_json(const std::vector<double>& times) {
  auto json = nlohmann::ordered_json::array();
  for (const double time : times) json.push_back(time);
  return json;
}

std::vector<double> times_of(const nlohmann::json& json) {
  std::vector<double> times;
  for (const auto& time : json)
    times.push_back(time.is_null() ? std::numeric_limits<double>::quiet_NaN() : time.get<double>());
  return times;
}

BenchRun run_of(const nlohmann::json& json) {
  BenchRun run;
  json.at("about").get_to(run.about);
  for (const auto& row : json.at("rows")) {
    TimedRow timed;
    row.at("input").get_to(timed.input);
    row.at("kind").get_to(timed.kind);
    row.at("queries").get_to(timed.queries);
    row.at("subject").get_to(timed.subject);
    run.times[timed] = times_of(row.at("ns"));
  }
  return run;
}

std::vector<BenchRun> runs_of(const std::string& text, const std::filesystem::path& file) {
  std::vector<BenchRun> runs;
  std::istringstream lines(text);
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    try {
      runs.push_back(run_of(parse_json<nlohmann::json>(line)));
    } catch (const std::exception&) {
      throw Error(fmt::format("{}:{}: found '{}', expected a run that nearmiss bench --history stored",
                              file.string(), number, excerpt(line)));
    }
  }
  return runs;
}

nlohmann::ordered_json to_json(const BenchRun& run) {
  auto rows = nlohmann::ordered_json::array();
  for (const auto& [row, times] : run.times)
    rows.push_back({{"input", row.input},
                    {"kind", row.kind},
                    {"queries", row.queries},
                    {"subject", row.subject},
                    {"ns", times_to_json(times)}});
  return {{"about", run.about}, {"rows", std::move(rows)}};
}

/// The smallest number of pairs of runs that are compared. With fewer pairs, even the interval from the
/// smallest to the largest ratio contains the median with less than 95 % confidence.
constexpr std::size_t fewest_pairs = 6;

/// The factor by which the time in one row of the table of times changes between two series of runs.
struct Change {
  double ratio;   ///< the median, over all pairs of runs, of (time after) / (time before)
  double lo, hi;  ///< the ends of an interval that contains the true median with at least 95 % confidence
  /// "faster" or "slower" if the confidence interval does not contain 1, otherwise "within noise".
  [[nodiscard]] std::string_view verdict() const {
    return hi < 1 ? "faster" : lo > 1 ? "slower" : "within noise";
  }
};

/// Computes the change from the ratios of at least `fewest_pairs` pairs. The ends of the interval are two of
/// the ratios (order statistics), so the interval is valid for any distribution of the ratios (David and
/// Nagaraja, Order Statistics, 3rd edition, 7.1).
Change change_of(std::vector<double> ratios) {
  std::sort(ratios.begin(), ratios.end());
  // The true median lies between the k-th and the (n + 1 - k)-th of n sorted ratios, unless fewer than k
  // ratios are below the true median, or fewer than k are above it. The loop finds the largest k for which
  // each of these two events has a probability of at most 2.5 %.
  const boost::math::binomial below(static_cast<double>(ratios.size()), 0.5);
  std::size_t k = 1;
  while (k < ratios.size() / 2 && boost::math::cdf(below, static_cast<double>(k)) <= 0.025) ++k;
  return {median(ratios), ratios[k - 1], ratios[ratios.size() - k]};
}

void expect_pairs(const std::vector<BenchRun>& before, const std::vector<BenchRun>& after) {
  if (before.size() != after.size() || before.size() < fewest_pairs)
    throw Error(fmt::format("found {} and {} runs, expected as many of both, and at least {}", before.size(),
                            after.size(), fewest_pairs));
  std::set<std::string> processors;
  for (const auto* runs : {&before, &after})
    for (const BenchRun& run : *runs) {
      const auto cpu = run.about.find("cpu");
      processors.insert(cpu == run.about.end() ? "unknown" : cpu->second);
    }
  if (processors.size() > 1)
    throw Error(fmt::format("found runs on '{}' and '{}', expected those of one processor",
                            *processors.begin(), *processors.rbegin()));
}

/// For each run, the median time of a row of the table. The time is NaN for a run without this row.
std::vector<double> medians(const std::vector<BenchRun>& runs, const TimedRow& row) {
  std::vector<double> all;
  for (const BenchRun& run : runs) {
    const auto found = run.times.find(row);
    all.push_back(median(found == run.times.end() ? std::vector<double>{} : found->second));
  }
  return all;
}

std::string in_ns(double time) { return std::isnan(time) ? "-" : fmt::format("{:.1f}", time); }

std::vector<std::string> cells(const TimedRow& row, const std::vector<double>& before,
                               const std::vector<double>& after) {
  std::vector<std::string> line{
      row.input,           row.kind, row.subject, fmt::format("{}", row.queries), in_ns(median(before)),
      in_ns(median(after))};
  std::vector<double> ratios;
  for (std::size_t i = 0; i < before.size(); ++i)
    if (const double ratio = after[i] / before[i]; std::isfinite(ratio)) ratios.push_back(ratio);
  if (ratios.size() < before.size()) {
    line.insert(line.end(), {"-", "-", "not in all runs"});
    return line;
  }
  const Change change = change_of(std::move(ratios));
  line.insert(line.end(),
              {fmt::format("{:.3f}", change.ratio), fmt::format("{:.3f}-{:.3f}", change.lo, change.hi),
               std::string(change.verdict())});
  return line;
}

}  // namespace

std::vector<BenchRun> read_history(const std::filesystem::path& file) {
  return runs_of(read_whole_file(file), file);
}

void append_to_history(const std::filesystem::path& file, const BenchRun& run) {
  std::string text;
  if (std::filesystem::exists(file)) {
    text = read_whole_file(file);
    runs_of(text, file);  // throws Error if the file is no history
    if (!text.empty() && text.back() != '\n') text += '\n';
  }
  replace_file(file, text + json_text(to_json(run)) + '\n');
}

std::string comparison_table(const std::vector<BenchRun>& before, const std::vector<BenchRun>& after) {
  expect_pairs(before, after);
  std::set<TimedRow> rows;
  for (const auto* runs : {&before, &after})
    for (const BenchRun& run : *runs)
      for (const auto& [row, times] : run.times) rows.insert(row);
  std::vector<std::vector<std::string>> table{
      {"input", "kind", "subject", "queries", "before", "after", "ratio", "95 % interval", "change"}};
  for (const TimedRow& row : rows) table.push_back(cells(row, medians(before, row), medians(after, row)));
  return columns(table, 3);
}

}  // namespace nearmiss::tools

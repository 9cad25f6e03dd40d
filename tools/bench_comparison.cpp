#include "tools/bench_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <set>

#include "ccd/query/error.hpp"
#include "reports/text/text.hpp"
#include "tools/median.hpp"

namespace nearmiss::tools {

namespace {

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

/// The median time of a row in each run; NaN for a run without it.
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

std::string_view Change::verdict() const { return hi < 1 ? "faster" : lo > 1 ? "slower" : "within noise"; }

Change change_of(std::vector<double> ratios) {
  std::sort(ratios.begin(), ratios.end());
  // The true median is between the order statistics k and n + 1 - k, unless fewer than k ratios are on one
  // side of it. The loop finds the largest k for which that happens with a probability of at most 2.5 % for
  // each side.
  const boost::math::binomial below(static_cast<double>(ratios.size()), 0.5);
  std::size_t k = 1;
  while (k < ratios.size() / 2 && boost::math::cdf(below, static_cast<double>(k)) <= 0.025) ++k;
  return {median(ratios), ratios[k - 1], ratios[ratios.size() - k]};
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

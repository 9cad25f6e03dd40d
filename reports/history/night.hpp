// What the report of a night says, as far as a history shows it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "reports/sections/baseline.hpp"

namespace nearmiss {

/// (failure, subject, signature), or ("rate" or "time", subject, what it measures)
using ChangeKey = std::tuple<std::string, std::string, std::string>;

/// A change since the baseline, as a report tells it.
struct ReportedChange {
  std::string what;     ///< "new", "worse", "slower", "gone", "better" or "faster"
  std::string subject;  ///< "" for the oracle
  std::string topic;    ///< the failure, such as "false negative", or "time"
  ChangeKey key;
  std::string text;        ///< "false-negative, vt simple-root inside in-face"
  std::string fixed = {};  ///< "in version 2"
  double ratio = 1;        ///< the ratio of a run time to the expected one
};

/// A subject in one night. Numbers that its report does not give are missing.
struct SubjectNight {
  SubjectCode code;
  bool clean = true;
  std::string text;  ///< its verdict
  std::optional<double> queries, false_positive_rate, ns_per_query;
  std::map<std::string, std::pair<double, double>> missed;  ///< by class: the numbers of misses and of
                                                            ///< collisions
};

/// A campaign and what its report says.
struct NightReport {
  std::string name;     ///< of the night's folder
  std::string page;     ///< the report's page, relative to the folder of all nights; "" if there is no report
  std::string started;  ///< the earliest date of its runs; "" if it is not known
  std::string headline;  ///< the headline of its report, or why there is no report
  bool clean = false;
  std::uint64_t cases = 0;
  double seconds = 0;  ///< run time of all its runs
  SubjectCode oracle;  ///< nearmiss itself
  std::map<std::string, SubjectNight> subjects;
  std::vector<ReportedChange> changes;
  std::map<ChangeKey, std::uint64_t> seen;  ///< in how many queries each way to fail was seen
  bool has_baseline = false;
  std::set<std::string> baseline = {};  ///< the dates of the runs that are its baseline
};

/// The nights in a folder, in the order of their dates; but a night comes after the nights that are its
/// baseline, even if the clock was set back in between. A night is a folder that has a report.json, in itself
/// or in report/, or a store, or the name that tools/nightly gives. Throws Error if there is none, or the
/// folder cannot be read.
std::vector<NightReport> read_nights(const std::filesystem::path& folder);

}  // namespace nearmiss

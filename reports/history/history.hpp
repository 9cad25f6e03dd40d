// The history of a campaign that is repeated, night after night: what changed, and in which night.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
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
  std::optional<double> queries = {}, false_positive_rate = {}, ns_per_query = {};
  std::map<std::string, std::pair<double, double>> missed = {};  ///< by class: misses, and collisions
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

/// A change in a night.
struct NightEvent {
  std::string what;     ///< that of a ReportedChange, or "version" or "first"
  std::string subject;  ///< "" for the oracle
  std::size_t count;    ///< number of ways to fail, rates or run times
  std::string text;     ///< "2 new ways to fail, such as false-negative, vt simple-root inside in-face"
};

struct Night {
  NightReport report;
  bool went_back = false;               ///< an earlier night has a later date, because the clock was set back
  std::vector<NightEvent> events = {};  ///< what the report tells and no earlier report told
};

/// A way to fail (a signature), and the nights that saw it, as indices into History::nights.
struct WayToFail {
  std::string what, subject, signature;
  std::size_t first = 0, last = 0;
  std::size_t nights = 0;  ///< number of nights that saw it
  std::uint64_t seen = 0;  ///< number of queries in all nights
  bool lasts = false;      ///< the last night that asked its subject saw it
  std::size_t gone = 0;    ///< the night whose report says that it is gone; 0 if there is none
  std::string fixed = {};  ///< "in version 2", if that report says so
};

struct History {
  std::vector<Night> nights;    ///< in their order (read_nights)
  std::vector<WayToFail> ways;  ///< those that last first, then the latest, then the most frequent
};

/// Finds out what changed in each night. Nothing is told of the first night, because the nights before it are
/// not known.
History make_history(std::vector<NightReport> nights);

/// The history as JSON, which is part of its page.
nlohmann::ordered_json history_json(const History& history);

/// The last ten nights, a line of at most 100 columns each.
std::string describe(const History& history);

}  // namespace nearmiss

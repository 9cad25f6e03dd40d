// The history of a campaign that is repeated every night: what changed in which night.
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

/// Identifies a change: (failure, subject, signature), ("rate", subject, "false negatives in vt uniform") or
/// ("time", subject, "vt uniform").
using ChangeKey = std::tuple<std::string, std::string, std::string>;

/// A change since the baseline, as read from a report.
struct ReportedChange {
  std::string what;     ///< "new", "worse", "slower", "gone", "better" or "faster"
  std::string subject;  ///< "" for the oracle
  std::string topic;    ///< the kind of failure or rate, such as "false negative", or "time"
  ChangeKey key;
  std::string text;        ///< "false-negative, vt simple-root inside in-face"
  std::string fixed = {};  ///< for a failure that is gone: "in version 2"; "" if unknown
  double ratio = 1;        ///< the run time divided by the expected run time; 1 for other changes
};

/// A subject in one night. A number has no value if the night's report does not have it.
struct SubjectNight {
  SubjectCode code;
  bool clean = true;
  std::string text;  ///< the verdict on the subject
  std::optional<double> queries = {}, false_positive_rate = {}, ns_per_query = {};
  std::map<std::string, std::pair<double, double>> missed = {};  ///< misses and collisions of each class
};

/// The campaign of one night, and what its report says.
struct NightReport {
  std::string name;     ///< name of the night's folder
  std::string page;     ///< the report's page, relative to the folder of all nights; "" if there is no report
  std::string started;  ///< date of the earliest run; if unknown, the date in `name`, or `name` itself
  std::string headline;  ///< the report's headline, or why there is no report
  bool clean = false;
  std::uint64_t cases = 0;
  double seconds = 0;  ///< run time of all runs together
  SubjectCode oracle;  ///< the code of nearmiss itself
  std::map<std::string, SubjectNight> subjects;
  std::vector<ReportedChange> changes;
  std::map<ChangeKey, std::uint64_t> seen;  ///< in how many queries of the night each way to fail was seen
  bool has_baseline = false;
  std::set<std::string> baseline = {};  ///< the dates of the runs in the report's baseline
};

/// The nights in a folder, in the order of their dates. However, a night always comes after the nights of its
/// baseline, even if the clock was set back between them. A subfolder is a night if it has a report.json
/// (directly or in report/) or a store, or if its name is a date as tools/nightly writes it. Throws Error if
/// the folder has no night or cannot be read.
std::vector<NightReport> read_nights(const std::filesystem::path& folder);

/// Changes of one sort in a night, which the history shows as one line.
struct NightEvent {
  std::string what;     ///< ReportedChange::what, "version" (new code) or "first" (a new subject)
  std::string subject;  ///< "" for the oracle
  std::size_t count;    ///< number of ways to fail, rates or run times that changed
  std::string text;     ///< "2 new ways to fail, such as false-negative, vt simple-root inside in-face"
};

struct Night {
  NightReport report;
  bool went_back = false;               ///< an earlier night has a later date, because the clock was set back
  std::vector<NightEvent> events = {};  ///< changes of this night that no event of an earlier night has shown
};

/// A way to fail (a signature), and in which nights it was seen. Nights are indices into History::nights.
struct WayToFail {
  std::string what, subject, signature;
  std::size_t first = 0, last = 0;
  std::size_t nights = 0;  ///< number of nights that saw this way to fail
  std::uint64_t seen = 0;  ///< number of queries that failed in this way, in all nights together
  bool lasts = false;      ///< whether the last night in which the subject was asked saw this way to fail
  std::size_t gone = 0;    ///< the night whose report says that the failure is gone; 0 if no report says so
  std::string fixed = {};  ///< "in version 2", if that report says so
};

struct History {
  std::vector<Night> nights;  ///< the nights, in the order in which read_nights returns them
  /// Ways to fail for which `lasts` is true come first, then the others. Each of these two groups is sorted
  /// by the last night that saw the way to fail, the latest first, then by the number of queries, the largest
  /// first.
  std::vector<WayToFail> ways;
};

/// Finds out what changed in each night. The first night with a report has no events, because there is no
/// earlier report to compare it with.
History make_history(std::vector<NightReport> nights);

nlohmann::ordered_json history_json(const History& history);

/// A text about the last ten nights, with a line of at most 100 columns for each night.
std::string describe(const History& history);

}  // namespace nearmiss

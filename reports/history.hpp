// The history of a campaign that is repeated, night after night: what changed, and in which night.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reports/sections/baseline.hpp"

namespace nearmiss {

/// A change that the report of a night tells, if no earlier report told it already.
struct NightEvent {
  std::string what;       ///< "version", "first", "new", "gone", "worse", "better", "slower" or "faster"
  std::string subject;    ///< "" for the oracle
  std::size_t count = 1;  ///< of ways to fail, rates or run times
  std::string text;       ///< "2 new ways to fail, such as false-negative, vt simple-root inside in-face"
};

/// A subject in one night.
struct SubjectNight {
  SubjectCode code;
  bool clean = true;
  std::string text;              ///< its verdict
  nlohmann::ordered_json rates;  ///< numbers of its verdict for charts
};

/// A campaign and its report.
struct Night {
  std::string name;     ///< of its folder
  std::string page;     ///< its report's page, relative to the folder of all nights; "" if there is no report
  std::string started;  ///< UTC; "" if it is not known
  std::string headline;  ///< of its report, or why there is none
  bool clean = false;
  bool went_back = false;  ///< its date is before that of an earlier night, because the clock was set back
  std::uint64_t cases = 0;
  double seconds = 0;  ///< run time of all its runs
  std::vector<NightEvent> events;
  std::map<std::string, SubjectNight> subjects;
};

/// A way to fail (a signature), and the nights that saw it, as indices into History::nights.
struct WayToFail {
  std::string what, subject, signature;
  std::size_t first = 0, last = 0;
  std::size_t nights = 0;  ///< number of nights that saw it
  std::uint64_t seen = 0;  ///< number of queries in all nights
  bool lasts = false;      ///< the last night that asked its subject saw it
  std::string fixed = {};  ///< "in version 2", if a later night says so
  std::size_t gone = 0;    ///< the night that says so; 0 if there is none
};

struct History {
  std::vector<Night> nights;    ///< in their order
  std::vector<WayToFail> ways;  ///< those that last first, then the latest, then the most frequent
};

/// Reads the reports of nights: the folders in `folder` that have a report.json, in themselves or in report/.
/// Folders with stores but without a report that can be read are nights, too. Nights are in the order of their
/// dates, but a night comes after all nights that are its baseline, even if the clock was set back in between.
/// Throws Error if there is no night.
History read_history(const std::filesystem::path& folder);

/// The history as JSON, which is part of its page.
nlohmann::ordered_json history_json(const History& history);

/// The last ten nights, a line each.
std::string describe(const History& history);

}  // namespace nearmiss

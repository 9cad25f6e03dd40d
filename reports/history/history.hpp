// The history of a campaign that is repeated, night after night: what changed, and in which night.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "reports/history/night.hpp"

namespace nearmiss {

/// A change in a night.
struct NightEvent {
  std::string what;     ///< that of a ReportedChange, or "version" or "first"
  std::string subject;  ///< "" for the oracle
  std::size_t count;    ///< number of ways to fail, rates or run times
  std::string text;     ///< "2 new ways to fail, such as false-negative, vt simple-root inside in-face"
};

struct Night {
  NightReport report;
  bool went_back = false;          ///< an earlier night has a later date, because the clock was set back
  std::vector<NightEvent> events;  ///< what the report tells and no earlier report told
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

#include "reports/history.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>
#include <sstream>
#include <tuple>
#include <utility>

#include "ccd/query/error.hpp"
#include "reports/text/json_file.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

/// (failure, subject, signature), or (rate, subject, kind and family)
using Key = std::tuple<std::string, std::string, std::string>;

/// A change as a report tells it.
struct Change {
  std::string what, subject;
  Key key;
  std::string text;
  std::string fixed = {};  ///< "in version 2"
  double ratio = 1;        ///< of a run time to the expected one
};

/// What a report says of a night.
struct Report {
  Night night;
  std::string latest;  ///< the latest start of the night and of its baseline, which orders the nights
  std::vector<Change> changes;
  std::map<Key, std::uint64_t> seen;  ///< ways to fail
};

const ordered_json& list_in(const ordered_json& json, const char* name) {
  static const ordered_json none = ordered_json::array();
  const auto found = json.find(name);
  return found == json.end() ? none : *found;
}

Key way_of(const ordered_json& signature) {
  return {signature.at("what"), signature.at("subject"), signature.at("signature")};
}

/// The changes that a section "baseline" tells.
std::vector<Change> changes_in(const ordered_json& baseline) {
  std::vector<Change> changes;
  for (const auto& [list, what] : {std::pair{"new_signatures", "new"}, {"gone_signatures", "gone"}})
    for (const auto& each : list_in(baseline, list)) {
      const Key way = way_of(each);
      changes.push_back({what, std::get<1>(way), way,
                         fmt::format("{}, {}", std::get<0>(way), std::get<2>(way)), each.value("fixed", "")});
    }
  const auto place = [](const ordered_json& each) {
    return fmt::format("{} {}", each.at("kind").get<std::string>(), each.at("family").get<std::string>());
  };
  for (const auto& each : list_in(baseline, "changed_rates")) {
    const std::string subject = each.at("subject");
    const std::string of = fmt::format("{} in {}", each.at("what").get<std::string>(), place(each));
    const auto rate = [&](const char* when) {
      const auto& of_time = each.at(when);
      return fmt::format("{} of {}", with_separators(of_time.at("count").get<std::uint64_t>()),
                         with_separators(of_time.at("total").get<std::uint64_t>()));
    };
    changes.push_back({each.at("worse").get<bool>() ? "worse" : "better",
                       subject,
                       {"rate", subject, of},
                       fmt::format("{}: {} (was {})", of, rate("now"), rate("before")),
                       ""});
  }
  for (const auto& each : list_in(baseline, "changed_times")) {
    const std::string subject = each.at("subject");
    const double ratio = each.at("ratio");
    changes.push_back({each.at("slower").get<bool>() ? "slower" : "faster",
                       subject,
                       {"time", subject, place(each)},
                       fmt::format("{}, {:.3g} times the expected time", place(each), ratio),
                       "",
                       ratio});
  }
  return changes;
}

/// Facts of runs, as far as they say which code ran, and when.
Campaign campaign_of(const ordered_json& runs) {
  Campaign campaign;
  for (const auto& json : runs) {
    Run& run = campaign.runs.emplace_back();
    for (const auto& [name, value] : json.items())
      if (value.is_string()) run.info[name] = value.get<std::string>();
  }
  return campaign;
}

/// The numbers of a verdict that charts show.
ordered_json rates_of(const ordered_json& verdict) {
  ordered_json rates;
  const auto copy = [&](const ordered_json& from, const char* name) {
    if (const auto value = from.find(name); value != from.end()) rates[name] = *value;
  };
  if (const auto counts = verdict.find("counts"); counts != verdict.end())
    for (const char* name : {"queries", "false_positive_rate", "ns_per_query"}) copy(*counts, name);
  if (const auto classes = verdict.find("classes"); classes != verdict.end())
    for (const auto& [name, counts] : classes->items())
      rates["classes"][name] = {{"collisions", counts.at("collisions")},
                                {"false_negatives", counts.at("false_negatives")}};
  return rates;
}

/// Reads the report of a night.
void take(const ordered_json& json, Report& report) {
  Night& night = report.night;
  const auto& runs = json.at("runs");
  for (const auto& run : runs) {
    const std::string started = run.value("started", "");
    if (night.started.empty() || (!started.empty() && started < night.started)) night.started = started;
    report.latest = std::max(report.latest, started);
    night.cases += run.value("cases_done", std::uint64_t{0});
    night.seconds += run.value("seconds", 0.0);
  }
  const Campaign campaign = campaign_of(runs);
  for (const auto& verdict : json.at("verdicts")) {
    const std::string name = verdict.at("subject");
    night.subjects[name] = {code_of(campaign, name), verdict.at("clean"), verdict.at("text"),
                            rates_of(verdict)};
  }
  for (const auto& each : list_in(json, "signatures")) report.seen[way_of(each)] = each.at("seen");
  if (const auto baseline = json.find("baseline"); baseline != json.end()) {
    report.changes = changes_in(*baseline);
    for (const auto& run : list_in(*baseline, "runs"))
      report.latest = std::max(report.latest, run.value("started", ""));
  }
  night.headline = json.at("headline").at("text");
  night.clean = json.at("headline").at("clean");
}

bool has_store(const fs::path& folder) {
  std::error_code error;
  return std::any_of(fs::directory_iterator(folder, error), fs::directory_iterator(),
                     [](const auto& each) { return each.path().extension() == ".db"; });
}

/// The reports of all nights in a folder, in their order.
std::vector<Report> read_reports(const fs::path& folder) {
  std::error_code error;
  std::set<fs::path> folders;
  for (auto each = fs::directory_iterator(folder, error); !error && each != fs::directory_iterator();
       each.increment(error))
    if (each->is_directory() && !each->is_symlink()) folders.insert(each->path());
  if (error) throw Error(fmt::format("{}: cannot be read: {}", folder.string(), error.message()));
  std::vector<Report> reports;
  for (const fs::path& each : folders) {
    const fs::path own = fs::exists(each / "report.json") ? each : each / "report";
    if (!fs::exists(own / "report.json") && !has_store(each)) continue;
    Report report;
    try {
      read_json_file(own / "report.json", "what nearmiss report writes",
                     [&](const ordered_json& json) { take(json, report); });
      report.night.page = (own / "index.html").lexically_relative(folder).generic_string();
    } catch (const Error& problem) {
      report = {};
      report.night.headline = fs::exists(own / "report.json") ? problem.what() : "no report";
    }
    report.night.name = each.filename().string();
    if (report.latest.empty()) report.latest = report.night.name;
    reports.push_back(std::move(report));
  }
  if (reports.empty())
    throw Error(fmt::format("{}: found no report, expected folders of nights, each with report/report.json",
                            folder.string()));
  const auto order = [](const Report& report) {  // a night comes before those that have it as their baseline
    return std::tuple(report.latest, report.latest != report.night.started, report.night.started);
  };
  std::stable_sort(reports.begin(), reports.end(),
                   [&](const Report& a, const Report& b) { return order(a) < order(b); });
  return reports;
}

/// What the nights so far have told, so that nothing is told twice. While a subject's code stays the same, each sort
/// of change is told once: rates and ways to fail that become significant only in a later night are evidence of
/// the same change.
class Told {
 public:
  /// Whether a change is news. Call end_night() after all changes of a night.
  [[nodiscard]] bool is_news(const Change& change) const {
    if (with_this_code_.contains({change.subject, change.what})) return false;
    if (change.what == "gone") return !gone_.contains(change.key);
    const auto before = night_before_.find(change.subject);
    return before == night_before_.end() || !before->second.contains({change.what, change.key});
  }

  void add_version(const std::string& subject) {
    std::erase_if(with_this_code_, [&](const auto& each) { return each.first == subject; });
  }

  void end_night(const Night& night, const std::vector<Change>& changes) {
    for (const auto& [subject, _] : night.subjects) night_before_[subject].clear();
    for (const Change& each : changes) {
      with_this_code_.insert({each.subject, each.what});
      night_before_[each.subject].insert({each.what, each.key});
      if (each.what == "gone") gone_.insert(each.key);
    }
  }

  void add_seen(const Key& way) { gone_.erase(way); }

 private:
  std::set<std::pair<std::string, std::string>> with_this_code_;               // (subject, what)
  std::map<std::string, std::set<std::pair<std::string, Key>>> night_before_;  // by subject
  std::set<Key> gone_;
};

/// The run times of subjects that became slower.
class Slowed {
 public:
  /// Adds an event for each subject that is as fast again as before it became slower: its time is nearer to the time
  /// that was expected then.
  void add_events(Night& night, const std::vector<Change>& changes) {
    const auto is_told = [&](const std::string& subject, const char* what) {
      return std::any_of(changes.begin(), changes.end(),
                         [&](const Change& each) { return each.subject == subject && each.what == what; });
    };
    for (const auto& [name, subject] : night.subjects) {
      const double time = subject.rates.value("ns_per_query", 0.0);
      const auto slowed = limits_.find(name);
      if (is_told(name, "slower")) {
        if (slowed == limits_.end()) limits_[name] = time / std::sqrt(ratio_of(name, changes));
      } else if (slowed != limits_.end() && time > 0 && time < slowed->second) {
        if (!is_told(name, "faster")) night.events.push_back({"faster", name, 1, "no longer slower"});
        limits_.erase(slowed);
      }
    }
  }

 private:
  static double ratio_of(const std::string& subject, const std::vector<Change>& changes) {
    for (const Change& each : changes)
      if (each.subject == subject && each.what == "slower") return each.ratio;
    return 1;
  }

  std::map<std::string, double> limits_;  // ns a query, by subject
};

/// "3 new ways to fail, such as ..."
std::string in_words(const Change& example, std::size_t count) {
  static const std::map<std::string, std::pair<const char*, const char*>> words{
      {"new", {"new way to fail", "new ways to fail"}},
      {"gone", {"way to fail gone", "ways to fail gone"}},
      {"worse", {"worse rate", "worse rates"}},
      {"better", {"better rate", "better rates"}},
      {"slower", {"slower run time", "slower run times"}},
      {"faster", {"faster run time", "faster run times"}}};
  const auto& [one, many] = words.at(example.what);
  const std::string fixed = example.fixed.empty() ? "" : ", fixed " + example.fixed;
  return fmt::format("{}{}{}{}", counted(count, one, many), count == 1 ? ": " : ", such as ", example.text,
                     fixed);
}

/// Adds what a night's report tells that is new, one event for each subject and sort of change. Its example is the first
/// change, or the way to fail that was seen most often.
void add_changes(const Report& report, const Told& told, Night& night) {
  constexpr std::array order{"new", "worse", "slower", "gone", "better", "faster"};
  struct Sum {
    std::size_t count = 0;
    const Change* example = nullptr;
    std::uint64_t seen = 0;
  };
  std::map<std::pair<std::string, std::size_t>, Sum> sums;
  for (const Change& change : report.changes) {
    if (!told.is_news(change)) continue;
    const auto place = std::find(order.begin(), order.end(), change.what) - order.begin();
    Sum& sum = sums[{change.subject, static_cast<std::size_t>(place)}];
    const auto times = report.seen.find(change.key);
    const std::uint64_t seen = times == report.seen.end() ? 0 : times->second;
    if (sum.example == nullptr || seen > sum.seen)
      std::tie(sum.example, sum.seen) = std::tuple(&change, seen);
    ++sum.count;
  }
  for (const auto& [of, sum] : sums)
    night.events.push_back({sum.example->what, of.first, sum.count, in_words(*sum.example, sum.count)});
}

/// Adds the subjects that are new, and those whose code has changed.
void add_versions(const std::map<std::string, SubjectCode>& codes, bool is_first_night, Told& told,
                  Night& night) {
  for (const auto& [name, subject] : night.subjects) {
    const auto before = codes.find(name);
    if (before == codes.end()) {
      if (!is_first_night) night.events.push_back({"first", name, 1, "asked for the first time"});
    } else if (!(before->second == subject.code)) {
      told.add_version(name);
      const bool by_version = before->second.text() != subject.code.text();
      night.events.push_back(
          {"version", name, 1,
           fmt::format("{} (was {})", by_version ? subject.code.text() : subject.code.build,
                       by_version ? before->second.text() : before->second.build)});
    }
  }
}

}  // namespace

History read_history(const fs::path& folder) {
  History history;
  std::map<Key, WayToFail> ways;
  std::map<std::string, SubjectCode> codes;
  std::map<std::string, std::size_t> last_asked;
  std::string latest;
  Told told;
  Slowed slowed;
  for (Report& report : read_reports(folder)) {
    const std::size_t index = history.nights.size();
    Night& night = history.nights.emplace_back(report.night);
    night.went_back = !night.started.empty() && night.started < latest;
    latest = std::max(latest, night.started);
    add_versions(codes, codes.empty(), told, night);
    for (const auto& [key, _] : report.seen) told.add_seen(key);
    add_changes(report, told, night);
    told.end_night(night, report.changes);
    slowed.add_events(night, report.changes);
    for (const auto& [name, subject] : night.subjects) {
      codes[name] = subject.code;
      last_asked[name] = index;
    }
    for (const auto& [key, times] : report.seen) {
      const auto& [what, subject, signature] = key;
      WayToFail& way = ways.try_emplace(key, WayToFail{what, subject, signature, index}).first->second;
      way.last = index;
      ++way.nights;
      way.seen += times;
      way.gone = 0;
      way.fixed.clear();
    }
    for (const Change& change : report.changes)
      if (const auto way = ways.find(change.key);
          change.what == "gone" && way != ways.end() && way->second.gone == 0) {
        way->second.gone = index;
        way->second.fixed = change.fixed;
      }
  }
  for (auto& [key, way] : ways) {
    const auto asked = last_asked.find(way.subject);
    way.lasts = way.last == (asked == last_asked.end() ? history.nights.size() - 1 : asked->second);
    history.ways.push_back(std::move(way));
  }
  std::stable_sort(history.ways.begin(), history.ways.end(), [](const WayToFail& a, const WayToFail& b) {
    return std::tuple(!a.lasts, b.last, b.seen) < std::tuple(!b.lasts, a.last, a.seen);
  });
  return history;
}

ordered_json history_json(const History& history) {
  ordered_json json{{"nights", ordered_json::array()}, {"ways_to_fail", ordered_json::array()}};
  for (const Night& night : history.nights) {
    ordered_json events = ordered_json::array();
    for (const NightEvent& each : night.events)
      events.push_back(
          {{"what", each.what}, {"subject", each.subject}, {"count", each.count}, {"text", each.text}});
    ordered_json subjects = ordered_json::object();
    for (const auto& [name, subject] : night.subjects) {
      subjects[name] = {{"code", subject.code.text()}, {"clean", subject.clean}, {"text", subject.text}};
      subjects[name].update(subject.rates);
    }
    json["nights"].push_back({{"name", night.name},
                              {"page", night.page},
                              {"started", night.started},
                              {"headline", night.headline},
                              {"clean", night.clean},
                              {"went_back", night.went_back},
                              {"cases", night.cases},
                              {"seconds", night.seconds},
                              {"events", std::move(events)},
                              {"subjects", std::move(subjects)}});
  }
  const auto code = [&](std::size_t night, const std::string& subject) {
    const auto& subjects = history.nights[night].subjects;
    const auto found = subjects.find(subject);
    return found == subjects.end() ? "" : found->second.code.text();
  };
  for (const WayToFail& way : history.ways)
    json["ways_to_fail"].push_back({{"what", way.what},
                                    {"subject", way.subject},
                                    {"signature", way.signature},
                                    {"first", way.first},
                                    {"first_code", code(way.first, way.subject)},
                                    {"last", way.last},
                                    {"last_code", code(way.last, way.subject)},
                                    {"nights", way.nights},
                                    {"seen", way.seen},
                                    {"lasts", way.lasts},
                                    {"gone", way.gone == 0 ? ordered_json() : ordered_json(way.gone)},
                                    {"fixed", way.fixed}});
  return json;
}

std::string describe(const History& history) {
  constexpr std::size_t most_nights = 10;
  constexpr std::size_t widest = 100;
  const std::size_t from = history.nights.size() - std::min(history.nights.size(), most_nights);
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> changes;
  for (const Night& night : std::span(history.nights).subspan(from)) {
    rows.push_back({night.name,
                    night.page.empty() ? "-"
                    : night.clean      ? "ok"
                                       : "FAIL",
                    with_separators(night.cases)});
    std::vector<std::string> lines;
    if (night.page.empty()) lines.push_back(night.headline);
    for (const NightEvent& each : night.events)
      lines.push_back(fmt::format("{}: {}", each.subject.empty() ? "the oracle" : each.subject, each.text));
    changes.push_back(fmt::format("{}", fmt::join(lines, "; ")));
  }
  std::istringstream table(columns(rows, 2));
  std::string text;
  std::string line;
  for (std::size_t i = 0; std::getline(table, line); ++i)
    text += wrapped(changes[i].empty() ? line : line + "  " + changes[i], "", 1, widest);
  return text;
}

}  // namespace nearmiss

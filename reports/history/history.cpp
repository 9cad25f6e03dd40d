#include "reports/history/history.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string_view>

#include "ccd/query/printable.hpp"
#include "reports/text/json.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

using nlohmann::ordered_json;

namespace {

/// Remembers which changes the history has told, that is, shown as an event of a night. For each subject and
/// topic, the history tells a sort of change ("new", "worse" and so on) once. It may tell this sort again
/// after the subject's code has changed, or after it has told the opposite change. If another rate or another
/// way to fail of the same topic becomes significant in a later night, this is further evidence of a change
/// that was already told.
class Told {
 public:
  [[nodiscard]] bool is_news(const ReportedChange& change) const {
    if (told_.contains({change.subject, change.what, change.topic})) return false;
    if (change.what == "gone") return !gone_.contains(change.key);
    const auto before = night_before_.find(change.subject);
    return before == night_before_.end() || !before->second.contains({change.what, change.key});
  }

  void add_version(const std::string& subject) {
    std::erase_if(told_, [&](const Topic& each) { return std::get<0>(each) == subject; });
  }

  void tell(const std::string& subject, const std::string& what, const std::string& topic) {
    static const std::map<std::string, std::string> opposites{{"new", "gone"},      {"gone", "new"},
                                                              {"worse", "better"},  {"better", "worse"},
                                                              {"slower", "faster"}, {"faster", "slower"}};
    told_.erase({subject, opposites.at(what), topic});
    told_.insert({subject, what, topic});
    if (what == "gone") told_.erase({subject, "worse", topic});
  }

  /// Notes the end of a night. Must be called after all changes of the night have been told.
  void end_night(const NightReport& night) {
    for (const auto& [subject, of_night] : night.subjects) {
      night_before_[subject].clear();
      // After a clean night, a failure is news again, even if the subject's code seems unchanged. The code
      // may have changed, because nearmiss does not know the code of a program that is a subject (`pipe:`).
      if (of_night.clean)
        std::erase_if(told_, [&, name = subject](const Topic& each) {
          const auto& [of, what, topic] = each;
          return of == name && (what == "new" || what == "worse") && topic != "false positive";
        });
    }
    night_before_[""].clear();
    for (const auto& [way, _] : night.seen) gone_.erase(way);
    for (const ReportedChange& each : night.changes) {
      night_before_[each.subject].insert({each.what, each.key});
      if (each.what == "gone") gone_.insert(each.key);
    }
  }

 private:
  using Topic = std::tuple<std::string, std::string, std::string>;  // subject, what, topic

  std::set<Topic> told_;
  std::map<std::string, std::set<std::pair<std::string, ChangeKey>>> night_before_;  // by subject
  std::set<ChangeKey> gone_;
};

class Slowed {
 public:
  /// Adds an event for each subject that became slower in an earlier night and is fast again: its time is
  /// below the geometric mean of the slow time and the time that was expected when it became slower. Once
  /// slow nights are part of the baseline, the reports themselves do not show that the subject is fast again.
  void add_events(Night& night, Told& told) {
    for (const auto& [name, subject] : night.report.subjects) {
      const double time = subject.ns_per_query.value_or(0);
      const auto limit = limits_.find(name);
      if (const ReportedChange* slower = change_of(night.report, name, "slower")) {
        limits_.try_emplace(name, time / std::sqrt(slower->ratio));
      } else if (limit != limits_.end() && time > 0 && time < limit->second) {
        if (!change_of(night.report, name, "faster")) {
          night.events.push_back({"faster", name, 1, "no longer slower"});
          told.tell(name, "faster", "time");
        }
        limits_.erase(limit);
      }
    }
  }

 private:
  static const ReportedChange* change_of(const NightReport& night, const std::string& subject,
                                         std::string_view what) {
    const auto found = std::find_if(
        night.changes.begin(), night.changes.end(),
        [&](const ReportedChange& each) { return each.subject == subject && each.what == what; });
    return found == night.changes.end() ? nullptr : &*found;
  }

  std::map<std::string, double> limits_;  // the time (ns per query) below which a slow subject is fast again
};

/// A sort of event, with the words for a single change and the words for several changes.
struct Sort {
  std::string_view what, one, many;
};
/// The sorts of events, in the order in which a night shows them.
constexpr std::array sorts{Sort{"new", "new way to fail", "new ways to fail"},
                           Sort{"worse", "worse rate", "worse rates"},
                           Sort{"slower", "slower run time", "slower run times"},
                           Sort{"version", "", ""},
                           Sort{"first", "", ""},
                           Sort{"gone", "way to fail gone", "ways to fail gone"},
                           Sort{"better", "better rate", "better rates"},
                           Sort{"faster", "faster run time", "faster run times"}};

const Sort& sort_of(std::string_view what) {
  return *std::find_if(sorts.begin(), sorts.end(), [&](const Sort& each) { return each.what == what; });
}

/// Adds the news in a night's report: one event for each subject and sort of change. Each event has an
/// example. For new ways to fail, the example is the one that the night saw most often; for other changes
/// (failures that are gone, rates, times), the example is the first change.
void add_changes(Told& told, Night& night) {
  struct Sum {
    std::size_t count = 0;
    const ReportedChange* example = nullptr;
    std::uint64_t seen = 0;
  };
  std::map<std::pair<std::string, std::string>, Sum> sums;
  std::vector<const ReportedChange*> news;
  for (const ReportedChange& change : night.report.changes) {
    if (!told.is_news(change)) continue;
    news.push_back(&change);
    Sum& sum = sums[{change.subject, change.what}];
    const auto times = night.report.seen.find(change.key);
    const std::uint64_t seen = times == night.report.seen.end() ? 0 : times->second;
    if (sum.example == nullptr || seen > sum.seen) {
      sum.example = &change;
      sum.seen = seen;
    }
    ++sum.count;
  }
  for (const ReportedChange* each : news) told.tell(each->subject, each->what, each->topic);
  for (const auto& [of, sum] : sums) {
    const Sort& sort = sort_of(of.second);
    const std::string fixed = sum.example->fixed.empty() ? "" : ", fixed " + sum.example->fixed;
    night.events.push_back({of.second, of.first, sum.count,
                            fmt::format("{}{}{}{}", counted(sum.count, sort.one, sort.many),
                                        sum.count == 1 ? ": " : ", such as ", sum.example->text, fixed)});
  }
}

/// The text that names a subject's code. If `by_version` is true, the text is that of SubjectCode::text(),
/// such as "version 2"; otherwise it is the build, cut off after 12 digits.
std::string text_of(const SubjectCode& code, bool by_version) {
  return by_version ? code.text() : code.build.substr(0, std::string_view("commit 0123456789ab").size());
}

/// Adds an event for each subject that is new or has new code. `codes` has the last known code of each
/// subject.
void add_versions(const std::map<std::string, SubjectCode>& codes, Told& told, Night& night) {
  const auto compare = [&](const std::string& name, const SubjectCode& now) {
    const auto before = codes.find(name);
    if (before == codes.end() || before->second == now || now == SubjectCode{}) return;
    told.add_version(name);
    const bool by_version = before->second.text() != now.text();
    if (!name.empty())
      night.events.push_back(
          {"version", name, 1,
           fmt::format("{} (was {})", text_of(now, by_version), text_of(before->second, by_version))});
  };
  compare("", night.report.oracle);
  for (const auto& [name, subject] : night.report.subjects) {
    compare(name, subject.code);
    if (!codes.contains(name)) night.events.push_back({"first", name, 1, "asked for the first time"});
  }
}

/// Finds out which nights saw each way to fail.
class Ways {
 public:
  void add(const NightReport& night, std::size_t index) {
    for (const auto& [name, _] : night.subjects) last_asked_[name] = index;
    if (!night.page.empty()) last_asked_[""] = index;
    for (const auto& [key, times] : night.seen) {
      const auto& [what, subject, signature] = key;
      WayToFail& way = ways_.try_emplace(key, WayToFail{what, subject, signature, index}).first->second;
      way.last = index;
      ++way.nights;
      way.seen += times;
      way.gone = 0;
      way.fixed.clear();
    }
    for (const ReportedChange& change : night.changes)
      if (const auto way = ways_.find(change.key);
          change.what == "gone" && way != ways_.end() && way->second.gone == 0) {
        way->second.gone = index;
        way->second.fixed = change.fixed;
      }
  }

  [[nodiscard]] std::vector<WayToFail> in_order() const {
    std::vector<WayToFail> all;
    for (const auto& [key, way] : ways_) {
      all.push_back(way);
      const auto asked = last_asked_.find(way.subject);
      all.back().lasts = asked == last_asked_.end() || way.last == asked->second;
    }
    std::stable_sort(all.begin(), all.end(), [](const WayToFail& a, const WayToFail& b) {
      return std::tuple(!a.lasts, b.last, b.seen) < std::tuple(!b.lasts, a.last, a.seen);
    });
    return all;
  }

 private:
  std::map<ChangeKey, WayToFail> ways_;
  std::map<std::string, std::size_t> last_asked_;
};

ordered_json number_or_null(const std::optional<double>& number) {
  return number ? ordered_json(*number) : ordered_json();
}

ordered_json subject_json(const SubjectNight& subject) {
  ordered_json classes = ordered_json::object();
  for (const auto& [name, missed] : subject.missed)
    classes[name] = {{"false_negatives", missed.first}, {"collisions", missed.second}};
  return {{"code", subject.code.text()},
          {"build", text_of(subject.code, false)},
          {"clean", subject.clean},
          {"text", subject.text},
          {"queries", number_or_null(subject.queries)},
          {"false_positive_rate", number_or_null(subject.false_positive_rate)},
          {"ns_per_query", number_or_null(subject.ns_per_query)},
          {"classes", std::move(classes)}};
}

}  // namespace

History make_history(std::vector<NightReport> reports) {
  History history;
  Ways ways;
  std::map<std::string, SubjectCode> codes;
  std::string latest;
  Told told;
  Slowed slowed;
  for (NightReport& report : reports) {
    const std::size_t index = history.nights.size();
    Night& night = history.nights.emplace_back(Night{.report = std::move(report)});
    night.went_back = night.report.started < latest;
    latest = std::max(latest, night.report.started);
    add_versions(codes, told, night);
    add_changes(told, night);
    told.end_night(night.report);
    slowed.add_events(night, told);
    if (codes.empty()) night.events.clear();
    std::stable_sort(night.events.begin(), night.events.end(), [](const NightEvent& a, const NightEvent& b) {
      return &sort_of(a.what) < &sort_of(b.what);
    });
    ways.add(night.report, index);
    if (night.report.page.empty()) continue;
    codes[""] = night.report.oracle;
    for (const auto& [name, subject] : night.report.subjects)
      if (subject.code != SubjectCode{} || !codes.contains(name)) codes[name] = subject.code;
  }
  history.ways = ways.in_order();
  return history;
}

ordered_json history_json(const History& history) {
  ordered_json json{{"nights", ordered_json::array()}, {"ways_to_fail", ordered_json::array()}};
  for (const auto& [report, went_back, events] : history.nights) {
    ordered_json list = ordered_json::array();
    for (const NightEvent& each : events)
      list.push_back(
          {{"what", each.what}, {"subject", each.subject}, {"count", each.count}, {"text", each.text}});
    ordered_json subjects = ordered_json::object();
    for (const auto& [name, subject] : report.subjects) subjects[name] = subject_json(subject);
    json["nights"].push_back({{"name", printable(report.name)},
                              {"page", report.page},
                              {"started", report.started},
                              {"headline", report.headline},
                              {"clean", report.clean},
                              {"has_baseline", report.has_baseline},
                              {"went_back", went_back},
                              {"cases", report.cases},
                              {"seconds", report.seconds},
                              {"events", std::move(list)},
                              {"subjects", std::move(subjects)}});
  }
  const auto code = [&](std::size_t night, const std::string& subject) {
    const auto& subjects = history.nights[night].report.subjects;
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
  constexpr std::size_t widest_name = 30;
  const auto some = std::span(history.nights).last(std::min(history.nights.size(), most_nights));
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> changes;
  for (const auto& [report, went_back, events] : some) {
    const bool has_report = !report.page.empty();
    rows.push_back({printable(report.name).substr(0, widest_name),
                    !has_report    ? "-"
                    : report.clean ? "ok"
                                   : "FAIL",
                    with_separators(report.cases)});
    std::vector<std::string> texts;
    if (!has_report) texts.push_back(printable(report.headline));
    for (const NightEvent& each : events)
      texts.push_back(fmt::format("{}: {}", each.subject.empty() ? "the oracle" : each.subject, each.text));
    changes.push_back(fmt::format("{}", fmt::join(texts, "; ")));
  }
  std::istringstream table(columns(rows, 2));
  std::string text;
  std::string line;
  for (std::size_t i = 0; std::getline(table, line); ++i)
    text += wrapped(changes[i].empty() ? line : line + "  " + changes[i], "", 1, widest);
  return text;
}

}  // namespace nearmiss

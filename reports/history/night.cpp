#include "reports/history/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>

#include "ccd/query/error.hpp"
#include "reports/text/json.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

/// The list that is the member `name` of an object; an empty list if the object does not have this member.
const ordered_json& list_in(const ordered_json& json, const char* name) {
  static const ordered_json none = ordered_json::array();
  const auto found = json.find(name);
  return found == json.end() ? none : *found;
}

/// The number that is the member `name` of an object; nothing if the object does not have this member, or if
/// the member is not a number.
std::optional<double> number_in(const ordered_json& json, const char* name) {
  const auto found = json.find(name);
  if (found == json.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

ChangeKey way_of(const ordered_json& signature) {
  return {signature.at("what"), signature.at("subject"), signature.at("signature")};
}

/// "false negative", for both the failure "false-negative" and the rate "false negatives"
std::string topic_of(std::string what) {
  std::replace(what.begin(), what.end(), '-', ' ');
  if (what.ends_with('s')) what.pop_back();
  return what;
}

/// "vt uniform"
std::string described_place(const ordered_json& changed) {
  return fmt::format("{} {}", changed.at("kind").get<std::string>(), changed.at("family").get<std::string>());
}

/// "30 of 1,000"
std::string text_of(const ordered_json& proportion) {
  return fmt::format("{} of {}", with_separators(proportion.at("count").get<std::uint64_t>()),
                     with_separators(proportion.at("total").get<std::uint64_t>()));
}

ReportedChange changed_way(const char* what, const ordered_json& json) {
  const ChangeKey key = way_of(json);
  const auto& [failure, subject, signature] = key;
  return {.what = what,
          .subject = subject,
          .topic = topic_of(failure),
          .key = key,
          .text = fmt::format("{}, {}", failure, signature),
          .fixed = json.value("fixed", "")};
}

ReportedChange changed_rate(const ordered_json& json) {
  const std::string measure = json.at("what");
  const std::string subject = json.at("subject");
  const std::string of = fmt::format("{} in {}", measure, described_place(json));
  return {.what = json.at("worse").get<bool>() ? "worse" : "better",
          .subject = subject,
          .topic = topic_of(measure),
          .key = {"rate", subject, of},
          .text = fmt::format("{}: {} (was {})", of, text_of(json.at("now")), text_of(json.at("before")))};
}

ReportedChange changed_time(const ordered_json& json) {
  const std::string subject = json.at("subject");
  const double ratio = json.at("ratio");
  return {.what = json.at("slower").get<bool>() ? "slower" : "faster",
          .subject = subject,
          .topic = "time",
          .key = {"time", subject, described_place(json)},
          .text = fmt::format("{}, {:.3g} times the expected time", described_place(json), ratio),
          .ratio = ratio};
}

void take_baseline(const ordered_json& json, NightReport& night) {
  night.has_baseline = true;
  for (const auto& run : list_in(json, "runs")) night.baseline.insert(run.value("started", ""));
  for (const auto& each : list_in(json, "new_signatures")) night.changes.push_back(changed_way("new", each));
  for (const auto& each : list_in(json, "gone_signatures"))
    night.changes.push_back(changed_way("gone", each));
  for (const auto& each : list_in(json, "changed_rates")) night.changes.push_back(changed_rate(each));
  for (const auto& each : list_in(json, "changed_times")) night.changes.push_back(changed_time(each));
}

/// A campaign that has nothing but the facts of a report's runs. `code_of` reads in these facts which code
/// ran.
Campaign campaign_of(const ordered_json& runs) {
  Campaign campaign;
  for (const auto& json : runs) {
    Run& run = campaign.runs.emplace_back();
    for (const auto& [name, value] : json.items())
      if (value.is_string()) run.info[name] = value.get<std::string>();
  }
  return campaign;
}

SubjectNight subject_of(const ordered_json& verdict, SubjectCode code) {
  SubjectNight subject{.code = std::move(code), .clean = verdict.at("clean"), .text = verdict.at("text")};
  if (const auto counts = verdict.find("counts"); counts != verdict.end()) {
    subject.queries = number_in(*counts, "queries");
    subject.false_positive_rate = number_in(*counts, "false_positive_rate");
    subject.ns_per_query = number_in(*counts, "ns_per_query");
  }
  if (const auto classes = verdict.find("classes"); classes != verdict.end() && classes->is_object())
    for (const auto& [name, counts] : classes->items()) {
      const auto missed = number_in(counts, "false_negatives");
      const auto collisions = number_in(counts, "collisions");
      if (missed && collisions) subject.missed[name] = {*missed, *collisions};
    }
  return subject;
}

void take_report(const ordered_json& json, NightReport& night) {
  const auto& runs = json.at("runs");
  for (const auto& run : runs) {
    const std::string started = run.value("started", "");
    if (night.started.empty() || (!started.empty() && started < night.started)) night.started = started;
    night.cases += run.value("cases_done", std::uint64_t{0});
    night.seconds += run.value("seconds", 0.0);
  }
  const Campaign campaign = campaign_of(runs);
  night.oracle = code_of(campaign, "");
  for (const auto& verdict : json.at("verdicts")) {
    const std::string name = verdict.at("subject");
    night.subjects[name] = subject_of(verdict, code_of(campaign, name));
  }
  for (const auto& each : list_in(json, "signatures")) night.seen[way_of(each)] = each.at("seen");
  if (const auto baseline = json.find("baseline"); baseline != json.end()) take_baseline(*baseline, night);
  night.headline = json.at("headline").at("text");
  night.clean = json.at("headline").at("clean");
}

/// The date in a name that tools/nightly gives: "2026-11-30T22:00:00Z" for 2026-11-30T220000Z; "" for another
/// name.
std::string date_in(const std::string& name) {
  static const std::regex of_night(R"((\d{4}-\d\d-\d\dT\d\d)(\d\d)(\d\dZ).*)");
  std::smatch parts;
  return std::regex_match(name, parts, of_night)
             ? fmt::format("{}:{}:{}", parts[1].str(), parts[2].str(), parts[3].str())
             : "";
}

bool has_store(const fs::path& folder) {
  return std::any_of(fs::directory_iterator(folder), fs::directory_iterator(),
                     [](const auto& each) { return each.path().extension() == ".db"; });
}

/// The night in a folder; nothing if the folder does not belong to a night.
std::optional<NightReport> read_night(const fs::path& folder) {
  NightReport night;
  const std::string name = folder.filename().string();
  fs::path file = folder / "report.json";
  try {
    if (!fs::exists(file)) file = folder / "report" / "report.json";
    if (fs::exists(file)) {
      read_json_file(file, "what nearmiss report writes",
                     [&](const ordered_json& json) { take_report(json, night); });
      night.page =
          (file.parent_path() / "index.html").lexically_relative(folder.parent_path()).generic_string();
    } else if (date_in(name).empty() && !has_store(folder)) {
      return std::nullopt;
    } else {
      night.headline = "no report";
    }
  } catch (const std::exception& problem) {
    night = {};
    night.headline = problem.what();
    const std::string place = file.string() + ": ";
    if (night.headline.starts_with(place)) night.headline.erase(0, place.size());
  }
  night.name = name;
  if (night.started.empty()) night.started = date_in(name);
  if (night.started.empty()) night.started = name;
  return night;
}

/// Sorts nights by their dates, but puts each night after the nights of its baseline.
std::vector<NightReport> in_order(std::vector<NightReport> nights) {
  std::stable_sort(nights.begin(), nights.end(),
                   [](const NightReport& a, const NightReport& b) { return a.started < b.started; });
  std::vector<NightReport> sorted;
  while (!nights.empty()) {
    const auto is_next = [&](const NightReport& night) {
      return std::none_of(nights.begin(), nights.end(), [&](const NightReport& other) {
        return &other != &night && night.baseline.contains(other.started);
      });
    };
    auto next = std::find_if(nights.begin(), nights.end(), is_next);
    if (next == nights.end()) next = nights.begin();  // a cycle of baselines, so the dates are wrong
    sorted.push_back(std::move(*next));
    nights.erase(next);
  }
  return sorted;
}

}  // namespace

std::vector<NightReport> read_nights(const fs::path& folder) {
  std::set<fs::path> folders;
  try {
    for (const auto& each : fs::directory_iterator(folder))
      if (!each.is_symlink() && each.is_directory()) folders.insert(each.path());
  } catch (const fs::filesystem_error& error) {
    throw Error(fmt::format("{}: cannot be read: {}", folder.string(), error.code().message()));
  }
  std::vector<NightReport> nights;
  for (const fs::path& each : folders)
    if (auto night = read_night(each)) nights.push_back(std::move(*night));
  if (nights.empty())
    throw Error(fmt::format("{}: found no report, expected folders of nights, each with report/report.json",
                            folder.string()));
  return in_order(std::move(nights));
}

}  // namespace nearmiss

// The history of nightly campaigns, from their reports.
#include "reports/history/history.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "reports/text/json.hpp"
#include "tests/refused.hpp"
#include "tests/temporary_folder.hpp"

namespace nearmiss {
namespace {

using nlohmann::ordered_json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

const std::string contact = "vt simple-root inside in-face";

/// The statements about the plug-in `mine` in the report of a nightly campaign.
struct Said {
  std::string version;
  std::vector<std::string> seen = {}, created = {}, gone = {};  // signatures
  std::vector<std::string> worse = {};                          // families in which a rate is worse
  double slower = 0;                                            // run time now / expected run time
  double ns = 100;
};

class HistoryOfNights : public testing::TemporaryFolder {
 protected:
  static ordered_json way(const std::string& signature) {
    return {{"what", "false-negative"}, {"subject", "mine"}, {"signature", signature}, {"seen", 7}};
  }

  static ordered_json ways(const std::vector<std::string>& signatures) {
    ordered_json list = ordered_json::array();
    for (const auto& each : signatures) list.push_back(way(each));
    return list;
  }

  /// Writes the report of a night. The baseline is a run of the day `baseline_until`; there is no baseline if
  /// `baseline_until` is 0.
  void write_night(int day, const Said& said, int baseline_until = 0) {
    const auto date = [](int of) { return fmt::format("2026-11-{:02}T22:00:00Z", of); };
    ordered_json report{
        {"runs",
         {{{"version", "1.0.0"},
           {"plug-in mine sha256", "0123456789abcdef"},
           {"plug-in mine version", said.version},
           {"cases_done", 1000},
           {"started", date(day)},
           {"seconds", 2.5}}}},
        {"headline", {{"clean", said.seen.empty()}, {"text", "the headline"}}},
        {"signatures", ways(said.seen)},
        {"verdicts",
         {{{"subject", "mine"},
           {"clean", said.seen.empty()},
           {"text", "the verdict"},
           {"counts", {{"queries", 1000}, {"false_positive_rate", 0.5}, {"ns_per_query", said.ns}}},
           {"classes", {{"ordinary", {{"collisions", 100}, {"false_negatives", 3}, {"stuck", 1}}}}}}}}};
    if (baseline_until != 0) {
      ordered_json& baseline = report["baseline"];
      baseline["runs"] = ordered_json::array({{{"started", date(baseline_until)}}});
      baseline["new_signatures"] = ways(said.created);
      baseline["gone_signatures"] = ways(said.gone);
      for (auto& each : baseline["gone_signatures"]) each["fixed"] = "in version " + said.version;
      baseline["changed_rates"] = ordered_json::array();
      for (const auto& family : said.worse)
        baseline["changed_rates"].push_back({{"what", "false negatives"},
                                             {"subject", "mine"},
                                             {"kind", "vt"},
                                             {"family", family},
                                             {"worse", true},
                                             {"before", {{"count", 1}, {"total", 1000}}},
                                             {"now", {{"count", 30}, {"total", 1000}}}});
      baseline["changed_times"] = ordered_json::array();
      if (said.slower != 0)
        baseline["changed_times"].push_back({{"subject", "mine"},
                                             {"kind", "vt"},
                                             {"family", "all families"},
                                             {"slower", true},
                                             {"ratio", said.slower}});
    }
    write(fmt::format("2026-11-{:02}/report/report.json", day), report.dump());
  }

  /// The events of all nights, as texts such as "05 new 1": on day 5, one way to fail was new.
  [[nodiscard]] std::vector<std::string> events() const {
    std::vector<std::string> all;
    for (const Night& night : make_history(read_nights(file(""))).nights)
      for (const NightEvent& each : night.events)
        all.push_back(fmt::format("{} {} {}", night.report.name.substr(8), each.what, each.count));
    return all;
  }
};

TEST_F(HistoryOfNights, TellsEachChangeInTheNightInWhichItCame) {
  write_night(1, {.version = "1"});
  write_night(2, {.version = "1"}, 1);
  write_night(3, {.version = "2", .seen = {"a", "b"}, .created = {"a", "b"}, .worse = {"uniform"}}, 2);
  // In night 4, the new way to fail and the worse rate of `sliver` are no events. They come from version 2,
  // and version 2 is an event of night 3 already.
  write_night(4, {.version = "2", .seen = {"a", "c"}, .created = {"c"}, .worse = {"uniform", "sliver"}}, 3);
  write_night(5, {.version = "3", .gone = {"a", "b"}, .slower = 4, .ns = 400}, 4);
  write_night(6, {.version = "3", .gone = {"a", "b", "c"}, .slower = 3.5, .ns = 390}, 5);
  write_night(7, {.version = "4", .gone = {"a", "b", "c"}, .ns = 390}, 6);  // still slow, as is the baseline
  write_night(8, {.version = "5", .gone = {"a", "b", "c"}, .ns = 110}, 7);
  write_night(9, {.version = "6", .seen = {"a"}, .created = {"a"}}, 8);
  EXPECT_THAT(events(), ElementsAre("03 new 2", "03 worse 1", "03 version 1", "05 slower 1", "05 version 1",
                                    "05 gone 2", "07 version 1", "08 version 1", "08 faster 1", "09 new 1",
                                    "09 version 1"));
  const History history = make_history(read_nights(file("")));
  ASSERT_EQ(history.ways.size(), 3);
  const auto& [a, c, b] = std::tie(history.ways[0], history.ways[1], history.ways[2]);
  EXPECT_EQ(a.signature + c.signature + b.signature, "acb");
  EXPECT_TRUE(a.lasts);
  EXPECT_EQ(a.fixed, "");
  EXPECT_EQ(std::tuple(a.first, a.last, a.nights, a.seen), std::tuple(2, 8, 3, 21));
  EXPECT_EQ(std::tuple(b.first, b.last, b.lasts, b.gone, b.fixed),
            std::tuple(2, 2, false, 4, "in version 3"));
  const ordered_json json = history_json(history);
  EXPECT_EQ(json["nights"][2]["events"][2]["text"], "version 2 (was version 1)");
  EXPECT_EQ(json["nights"][2]["events"][1]["text"],
            "1 worse rate: false negatives in vt uniform: 30 of 1,000 (was 1 of 1,000)");
  EXPECT_EQ(json["nights"][0]["subjects"]["mine"]["classes"]["ordinary"]["false_negatives"], 3);
  EXPECT_EQ(json["ways_to_fail"][2]["last_code"], "version 2");
  EXPECT_THAT(
      describe(history),
      HasSubstr("2026-11-09  FAIL  1,000  mine: 1 new way to fail: false-negative, a; mine: version"));
}

// In this history, nearmiss sees no change of the subject's code, although the failures change. This happens
// with programs (pipe:...): nearmiss does not know a program's code, and so never sees that the code has
// changed.
TEST_F(HistoryOfNights, TellsAnotherFailureOfTheSameCodeAfterARepair) {
  write_night(1, {.version = "1"});
  write_night(2, {.version = "1", .seen = {"a"}, .created = {"a"}}, 1);
  write_night(3, {.version = "1", .seen = {"a", "b"}, .created = {"b"}}, 2);
  write_night(4, {.version = "1", .gone = {"a", "b"}}, 3);
  write_night(5, {.version = "1", .seen = {"c"}, .created = {"c"}, .gone = {"a", "b"}}, 4);
  write_night(6, {.version = "1", .gone = {"a", "b", "c"}}, 5);
  EXPECT_THAT(events(), ElementsAre("02 new 1", "04 gone 2", "05 new 1", "06 gone 1"));
}

TEST_F(HistoryOfNights, TellsNothingOfItsFirstNightWhoseBaselineIsNotKept) {
  write_night(2, {.version = "1", .seen = {"a"}, .created = {"a"}, .worse = {"uniform"}}, 1);
  write_night(3, {.version = "1", .seen = {"a"}, .worse = {"uniform"}}, 2);
  EXPECT_THAT(events(), IsEmpty());
}

TEST_F(HistoryOfNights, TellsEachNewDisagreementOfTheOracle) {
  const auto night = [&](int day, const std::string& commit, const std::string& created) {
    ordered_json report{{"runs", {{{"commit", commit}, {"started", fmt::format("2026-11-0{}", day)}}}},
                        {"verdicts", ordered_json::array()},
                        {"headline", {{"text", ""}, {"clean", true}}}};
    report["baseline"]["new_signatures"] = ordered_json::array();
    if (!created.empty())
      report["baseline"]["new_signatures"].push_back(
          {{"what", "oracle-disagreement"}, {"subject", ""}, {"signature", created}});
    write(fmt::format("2026-11-0{}/report.json", day), report.dump());
  };
  night(1, "a", "");
  night(2, "b", "x");
  night(3, "b", "");
  night(4, "c", "y");
  EXPECT_THAT(events(), ElementsAre("02 new 1", "04 new 1"));
}

TEST_F(HistoryOfNights, ANightComesAfterItsBaselineEvenIfTheClockWasSetBack) {
  write_night(10, {.version = "1"});
  write_night(3, {.version = "2"}, 10);
  write_night(4, {.version = "2"}, 10);
  write_night(11, {.version = "2"}, 10);
  const History history = make_history(read_nights(file("")));
  std::vector<std::string> names;
  for (const Night& each : history.nights) names.push_back(each.report.name + (each.went_back ? "!" : ""));
  EXPECT_THAT(names, ElementsAre("2026-11-10", "2026-11-03!", "2026-11-04!", "2026-11-11"));
  EXPECT_THAT(events(), ElementsAre("03 version 1"));
  write_night(2, {.version = "2"}, 3);  // the clock was set back again
  EXPECT_EQ(make_history(read_nights(file(""))).nights[2].report.name, "2026-11-02");
}

TEST_F(HistoryOfNights, KeepsThePlaceOfNightsThatItCannotRead) {
  write_night(1, {.version = "1"});
  write("2026-11-02/all.db", "");
  write("2026-11-03/report/report.json", "{\"runs\": 7}");
  write("2026-11-04/report/report.json", "{");
  write("2026-11-05/report.json",
        R"({"runs": [], "verdicts": [], "headline": {"text": "of old", "clean": true}})");
  const std::string odd =
      R"({"runs": [], "verdicts": [{"subject": "mine", "clean": true, "text": "", "counts":
      {"ns_per_query": "fast"}, "classes": {"ordinary": 7}}], "headline": {"text": "odd", "clean": true}})";
  write("2026-11-06/report.json", odd);
  std::filesystem::create_directory(file("2026-11-07T220000Z"));  // was killed early
  write("2026-11-08\n\x1b[31m <b>/report.json", odd);
  std::filesystem::create_directory_symlink("report", file("2026-11-07T220000Z/report"));
  write("no night/notes.txt", "");
  std::filesystem::create_directory_symlink("2026-11-01", file("last"));
  const History history = make_history(read_nights(file("")));
  std::vector<std::string> said;
  for (const Night& each : history.nights) said.push_back(each.report.page + "|" + each.report.headline);
  EXPECT_THAT(said,
              ElementsAre("2026-11-01/report/index.html|the headline", "|no report",
                          AllOf(StartsWith("|found "), HasSubstr("expected what nearmiss report writes")),
                          AllOf(StartsWith("|found "), HasSubstr("expected what nearmiss report writes")),
                          "2026-11-05/index.html|of old", "2026-11-06/index.html|odd",
                          HasSubstr("Too many levels of symbolic links"), HasSubstr("<b>/index.html|odd")));
  EXPECT_THAT(events(), IsEmpty());
  EXPECT_THAT(describe(history), HasSubstr("2026-11-08 ?[31m <b>  ok      0\n"));
  write("2026-12-01" + std::string(150, 'x') + "/report.json", odd);
  std::istringstream lines(describe(make_history(read_nights(file("")))));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100);
}

TEST_F(HistoryOfNights, RefusesAFolderWithoutNights) {
  EXPECT_REFUSED(read_nights(file("")), "found no report, expected folders of nights");
  EXPECT_REFUSED(read_nights(file("none")), "none: cannot be read");
}

}  // namespace
}  // namespace nearmiss

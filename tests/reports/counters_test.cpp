// Tests that every counter is in the store, in report.json and in statistics.csv. Also tests sums by class of
// families.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "reports/csv.hpp"
#include "reports/report.hpp"
#include "reports/sections/measures.hpp"
#include "reports/sections/sections.hpp"
#include "reports/statistics/counter.hpp"
#include "reports/statistics/family.hpp"
#include "reports/store/store.hpp"
#include "reports/text/json.hpp"
#include "tests/queries.hpp"
#include "tests/refused.hpp"
#include "tests/reports/campaigns.hpp"
#include "tests/temporary_folder.hpp"

namespace nearmiss {
namespace {

using Fields = std::map<std::string, std::string>;
using testing::counts;

/// Gives each counter a distinct value.
class Filler {
 public:
  explicit Filler(std::uint64_t last) : last_(last) {}

  template <class Owner>
  requires requires { Owner::counters(); }
  void fill(Owner& owner) {
    for_each_counter<Owner>([&](const auto& counter) { fill(owner.*counter.member); });
  }
  void fill(std::uint64_t& count) { count = ++last_; }
  template <std::size_t size>
  void fill(std::array<std::uint64_t, size>& counts) {
    for (std::uint64_t& each : counts) fill(each);
  }
  void fill(Histogram& histogram) { fill(histogram.bins); }
  void fill(TimeHistogram& histogram) { fill(histogram.bins); }
  void fill(BatchesByFamily& batches) { batches[{Kind::edge_edge, "f"}].add({++last_, ++last_ * 100}); }
  void fill(std::vector<FarCase>& cases) {
    cases = {
        {1.0 / static_cast<double>(++last_), testing::falling_edge(0.1, -1.0 / 3), std::to_string(last_)}};
  }
  void fill(std::vector<SlowCase>& cases) {
    cases = {{++last_, testing::falling_edge(0.1, -1.0 / 3), std::to_string(last_)}};
  }

 private:
  std::uint64_t last_;
};

template <class Owner>
Owner filled(std::uint64_t last = 0) {
  Owner owner;
  Filler(last).fill(owner);
  return owner;
}

/// Counters with distinct values that fit together: for example, collisions do not exceed queries.
Counts filled_counts(std::uint64_t last = 0) {
  auto counts = filled<Counts>(last);
  counts.queries = 1000000;
  counts.collisions = 100000;
  counts.positives = 100001;
  counts.false_positives = 50000;
  counts.times_given = 40000;
  counts.times_promised = 30000;
  counts.committed = 10000;
  return counts;
}

class CountersTest : public testing::TemporaryFolder {};

TEST_F(CountersTest, EachComesBackFromTheStore) {
  auto statistics = filled<Statistics>();
  statistics.counts[{"wang", Kind::vertex_triangle, "f"}] = filled_counts();
  statistics.counts[{"wang", Kind::edge_edge, "f"}] = filled_counts(5000);
  statistics.oracle[{Kind::edge_edge, "f"}] = filled<OracleCounts>();
  statistics.funnels[{"scene:cloth#3", Kind::edge_edge}] = filled<Funnel>();
  statistics.simulated[{"scene:sim:cloths", "wang", 3}] = filled<SimulatedStep>();
  write_campaign({{}, statistics}, file("a.db"));
  EXPECT_EQ(load_campaign(file("a.db")).statistics, statistics);
}

TEST_F(CountersTest, ACounterIsNotMoreThanWhatItIsAPartOf) {
  const auto refused = [&](std::uint64_t Counts::*counter, std::uint64_t value, const std::string& words) {
    Campaign one{{{}}, {}};
    one.statistics.counts[{"wang", Kind::edge_edge, "uniform"}].*counter = value;
    const std::string name = file(std::to_string(value) + ".db");
    write_campaign(one, name);
    EXPECT_REFUSED(load_campaign(name), words);
    std::filesystem::remove(name);
  };
  for (const auto counter :
       {&Counts::collisions, &Counts::positives, &Counts::false_negatives, &Counts::late,
        &Counts::false_positives, &Counts::refuted_bounds, &Counts::stuck, &Counts::unsafe_steps})
    refused(counter, 1, "found a counter that exceeds the one of which it counts a part");
  refused(&Counts::queries, largest_count + 1, "found the count 1152921504606846977, expected at most 2^60");
}

template <class Owner>
void expect_in_json(const nlohmann::ordered_json& json, const Owner& owner,
                    const Counter<Owner, std::uint64_t>& counter) {
  const auto& object = counter.json_object.empty() ? json : json.at(std::string(counter.json_object));
  EXPECT_EQ(object.at(std::string(counter.json_key)), owner.*counter.member);
}

template <class Owner, std::size_t size>
void expect_in_json(const nlohmann::ordered_json& json, const Owner& owner,
                    const NamedCounts<Owner, size>& counter) {
  const auto& object = counter.json_key.empty() ? json : json.at(std::string(counter.json_key));
  for (std::size_t i = counter.first; i < size; ++i)
    EXPECT_EQ(object.at(std::string(counter.names[i])), (owner.*counter.member)[i]);
}

template <class Owner, class Member>
void expect_in_json(const nlohmann::ordered_json& json, const Owner& /*owner*/,
                    const Counter<Owner, Member>& counter) {
  EXPECT_FALSE(json.at(std::string(counter.json_key)).empty());
}

template <class Owner>
void expect_in_json(const nlohmann::ordered_json& json, const Owner& owner) {
  for_each_counter<Owner>([&](const auto& counter) {
    SCOPED_TRACE(counter.name);
    ASSERT_NO_THROW(expect_in_json(json, owner, counter));
  });
}

TEST(Counters, EachStandsInTheJson) {
  const Counts counts = filled_counts();
  expect_in_json(counts_json({counts}), counts);
  const auto oracle = filled<OracleCounts>();
  expect_in_json(oracle_json(oracle), oracle);
  const auto funnel = filled<Funnel>();
  expect_in_json(funnel_json(funnel), funnel);
  const auto statistics = filled<Statistics>();
  nlohmann::ordered_json json;
  add_campaign_counters(json, statistics);
  expect_in_json(json, statistics);
}

std::vector<std::string> keys_of(const nlohmann::ordered_json& object) {
  std::vector<std::string> keys;
  for (const auto& each : object.items()) keys.push_back(each.key());
  return keys;
}

/// The keys of an object's properties in the schema, in order. `path` is a JSON pointer to the object.
std::vector<std::string> keys_in_schema(const char* path) {
  std::ifstream file(NEARMISS_SCHEMA);
  const auto schema = nlohmann::ordered_json::parse(file);
  return keys_of(schema.at(nlohmann::ordered_json::json_pointer(path)).at("properties"));
}

TEST(Counters, TheSchemaHasTheKeysOfTheJson) {
  std::vector<std::string> keys = keys_in_schema("/$defs/rates");
  EXPECT_EQ(keys, keys_of(rates_json({})));
  for (std::string& each : keys_in_schema("/$defs/counts")) keys.push_back(std::move(each));
  EXPECT_EQ(keys, keys_of(counts_json({})));
  EXPECT_EQ(keys_in_schema("/$defs/oracle_counts"), keys_of(oracle_json({})));
}

TEST(Measures, AreKnownByTheirKeys) {
  for (const Measure& each : rate_measures()) EXPECT_EQ(&measure(each.key), &each) << each.key;
  EXPECT_THROW(measure("no such key"), std::out_of_range);
}

/// The fields of the only row of a CSV text, by heading.
std::map<std::string, std::string> fields_of(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::vector<std::vector<std::string>> rows;
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    rows.emplace_back();
    while (std::getline(fields, line, ',')) rows.back().push_back(line);
  }
  std::map<std::string, std::string> by_heading;
  for (std::size_t i = 0; i < rows.at(0).size(); ++i) by_heading[rows[0][i]] = rows.at(1).at(i);
  return by_heading;
}

void expect_in_csv(const Fields& fields, const Counts& counts,
                   const Counter<Counts, std::uint64_t>& counter) {
  EXPECT_EQ(fields.at(std::string(counter.name)), std::to_string(counts.*counter.member));
}

template <std::size_t size>
void expect_in_csv(const Fields& fields, const Counts& counts, const NamedCounts<Counts, size>& counter) {
  for (std::size_t i = counter.first; i < size; ++i)
    EXPECT_EQ(fields.at(std::string(counter.csv_prefix) + "_" + std::string(counter.names[i])),
              std::to_string((counts.*counter.member)[i]));
}

/// Members that are not numbers, such as histograms, need not be in the CSV file.
template <class Member>
void expect_in_csv(const Fields& /*fields*/, const Counts& /*counts*/,
                   const Counter<Counts, Member>& /*counter*/) {}

TEST(Counters, EachNumberStandsInTheCsvFile) {
  Statistics statistics;
  const Counts counts = statistics.counts[{"wang", Kind::edge_edge, "f"}] = filled_counts();
  const Fields fields = fields_of(statistics_csv(statistics));
  for_each_counter<Counts>([&](const auto& counter) {
    SCOPED_TRACE(counter.name);
    ASSERT_NO_THROW(expect_in_csv(fields, counts, counter));
  });
  const auto json = counts_json({counts});
  EXPECT_EQ(fields.at("median_ns"), std::to_string(std::lround(json["times"]["median_ns"].get<double>())));
}

TEST(Counters, EachMeasureStandsInTheCsvFileAsInTheJson) {
  Statistics statistics;
  const Counts counts = statistics.counts[{"wang", Kind::edge_edge, "f"}] = filled_counts();
  const Fields fields = fields_of(statistics_csv(statistics));
  const auto json = rates_json({counts});
  const auto expect = [&](const std::string& heading, const nlohmann::ordered_json& value) {
    EXPECT_DOUBLE_EQ(std::stod(fields.at(heading)), value.is_null() ? HUGE_VAL : value.get<double>())
        << heading;
  };
  for (const Measure& each : rate_measures()) {
    const std::string key(each.key);
    if (each.csv_after.empty()) continue;
    if (json[key].is_array())
      for (const int end : {0, 1}) expect(key + (end == 0 ? "_from" : "_to"), json[key][end]);
    else
      expect(key, json[key]);
  }
  for (const int end : {0, 1})
    expect(end == 0 ? "false_positive_rate_from" : "false_positive_rate_to",
           json["false_positive_rate_interval_95"][end]);
}

TEST(FamilyClass, IsThatOfTheNameWithoutItsParameter) {
  EXPECT_EQ(class_of("uniform"), QueryClass::ordinary);
  EXPECT_EQ(class_of("scene:cloth#3"), QueryClass::ordinary);
  EXPECT_EQ(class_of("sim:cloths"), QueryClass::ordinary);
  for (const char* other : {"sim:cloths@64", "sim:cloths:step=2ms", "sim:cloths~0.1"})
    EXPECT_EQ(class_of(other), QueryClass::unclassified) << other;
  EXPECT_EQ(class_of("grazing"), QueryClass::degenerate);
  EXPECT_EQ(class_of("scale"), QueryClass::extreme);
  EXPECT_EQ(class_of("scale@-1074"), QueryClass::extreme);
}

TEST(FamilyClass, OfVerticesAndEdgesIsThatOfTheirFamily) {
  EXPECT_EQ(class_of("v-scale@3~drawn"), QueryClass::extreme);
  EXPECT_EQ(class_of("v-one-point"), QueryClass::extreme);  // unlike the class of "one-point"
  std::string name;                                         // the name in a forged store may be long
  for (int i = 0; i < 300'000; ++i) name += "v-";
  EXPECT_EQ(class_of(name + "scale"), QueryClass::unclassified);
}

TEST(FamilyClass, CasesAndSearchesAndUnknownNamesHaveNone) {
  for (const char* name :
       {"cases/", "search-miss-wang", "search-miss", "search-far-wang:p24", "", "uniforms"})
    EXPECT_EQ(class_of(name), QueryClass::unclassified) << name;
}

/// Counters for two ordinary families (one of them has late times), for a degenerate family, and for cases.
Statistics some_statistics() {
  Statistics statistics;
  const auto of = [&](const char* family) -> Counts& {
    return statistics.counts[{"mine", Kind::edge_edge, family}];
  };
  of("uniform") = counts(100, 10, 0, 5, 20);
  of("uniform-end") = counts(300, 20, 0, 7, 20);
  of("uniform-end").times_given = of("uniform-end").times_promised = 20;
  of("uniform-end").late = 2;
  of("grazing") = counts(50, 40, 3, 1, 30);
  of("cases/") = counts(8, 8, 1, 0);
  return statistics;
}

TEST(ByClass, TheTerminalShowsARowForEachOfSeveralClasses) {
  EXPECT_THAT(
      summary_table(some_statistics()),
      ::testing::HasSubstr(
          "\nsubject  kind  class         queries  collisions  false neg.  late  false pos.  ns/query\n"
          "mine     ee    ordinary          400          30           0     2          12        20\n"
          "mine     ee    degenerate         50          40           3     -           1        30\n"
          "mine     ee    unclassified        8           8           1     -           0         -\n"));
  Statistics statistics;
  statistics.counts[{"mine", Kind::edge_edge, "uniform"}] = counts(100, 10, 0, 5);
  statistics.counts[{"mine", Kind::edge_edge, "scene:cloth#3"}] = counts(100, 10, 0, 5);
  EXPECT_THAT(summary_table(statistics), ::testing::Not(::testing::HasSubstr("class")));
}

TEST(ByClass, ReportJsonHasTheSumsAndEachFamilysClass) {
  const auto json = summary_json({{}, some_statistics()})["subjects"]["mine"]["ee"];
  EXPECT_EQ(json["classes"].size(), 3);
  EXPECT_EQ(json["classes"]["ordinary"]["queries"], 400);
  EXPECT_EQ(json["classes"]["ordinary"]["false_negative_rate_upper_95"].is_number(), true);
  EXPECT_EQ(json["classes"]["ordinary"]["false_positives"], 12);
  EXPECT_EQ(json["classes"]["degenerate"]["false_negatives"], 3);
  EXPECT_EQ(json["classes"]["degenerate"]["ns_per_query"], 30);
  EXPECT_EQ(json["classes"]["unclassified"]["false_negative_rate_upper_95"], nullptr);
  EXPECT_EQ(json["families"]["uniform-end"]["class"], "ordinary");
  EXPECT_EQ(json["families"]["cases/"]["class"], "unclassified");
}

TEST(ByClass, CsvHasARowForEachClass) {
  const std::string text = classes_csv(some_statistics());
  EXPECT_THAT(text, ::testing::StartsWith("subject,kind,class,queries,collisions,"));
  EXPECT_THAT(text, ::testing::HasSubstr("\nmine,ee,ordinary,400,30,0,0,"));
  EXPECT_THAT(text, ::testing::HasSubstr("\nmine,ee,degenerate,50,40,0,3,"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4);
  EXPECT_THAT(statistics_csv(some_statistics()), ::testing::HasSubstr(",degenerate\n"));
}

}  // namespace
}  // namespace nearmiss

#include "tools/bench_history.hpp"

#include <fmt/format.h>

#include <limits>
#include <sstream>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "corpus/file.hpp"
#include "reports/text/json.hpp"
#include "reports/text/json_file.hpp"

namespace nearmiss::tools {

namespace {

/// Times as JSON. JSON has no NaN, so a missing time is null.
nlohmann::ordered_json times_to_json(const std::vector<double>& times) {
  auto json = nlohmann::ordered_json::array();
  for (const double time : times) json.push_back(time);
  return json;
}

std::vector<double> times_of(const nlohmann::json& json) {
  std::vector<double> times;
  for (const auto& time : json)
    times.push_back(time.is_null() ? std::numeric_limits<double>::quiet_NaN() : time.get<double>());
  return times;
}

BenchRun run_of(const nlohmann::json& json) {
  BenchRun run;
  json.at("about").get_to(run.about);
  for (const auto& row : json.at("rows")) {
    TimedRow timed;
    row.at("input").get_to(timed.input);
    row.at("kind").get_to(timed.kind);
    row.at("queries").get_to(timed.queries);
    row.at("subject").get_to(timed.subject);
    run.times[timed] = times_of(row.at("ns"));
  }
  return run;
}

std::vector<BenchRun> runs_of(const std::string& text, const std::filesystem::path& file) {
  std::vector<BenchRun> runs;
  std::istringstream lines(text);
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    try {
      runs.push_back(run_of(parse_json<nlohmann::json>(line)));
    } catch (const std::exception&) {
      throw Error(fmt::format("{}:{}: found '{}', expected a run that nearmiss bench --history stored",
                              file.string(), number, excerpt(line)));
    }
  }
  return runs;
}

}  // namespace

nlohmann::ordered_json to_json(const BenchRun& run) {
  auto rows = nlohmann::ordered_json::array();
  for (const auto& [row, times] : run.times)
    rows.push_back({{"input", row.input},
                    {"kind", row.kind},
                    {"queries", row.queries},
                    {"subject", row.subject},
                    {"ns", times_to_json(times)}});
  return {{"about", run.about}, {"rows", std::move(rows)}};
}

std::vector<BenchRun> read_history(const std::filesystem::path& file) {
  return runs_of(read_whole_file(file), file);
}

void append_to_history(const std::filesystem::path& file, const BenchRun& run) {
  std::string text;
  if (std::filesystem::exists(file)) {
    text = read_whole_file(file);
    runs_of(text, file);  // throws if the file is of another kind
    if (!text.empty() && text.back() != '\n') text += '\n';
  }
  replace_file(file, text + json_text(to_json(run)) + '\n');
}

}  // namespace nearmiss::tools

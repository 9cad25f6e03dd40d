#include "fuzz/libfuzzer/query_target.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "ccd/query/error.hpp"
#include "ccd/subjects/plugin.hpp"
#include "corpus/query_text.hpp"
#include "fuzz/families/mutation.hpp"
#include "fuzz/libfuzzer/query_bytes.hpp"
#include "fuzz/libfuzzer/untraced.hpp"
#include "fuzz/subjects/built_in.hpp"
#include "fuzz/subjects/contracted.hpp"
#include "fuzz/subjects/named.hpp"
#include "reports/campaign/finding_case.hpp"

namespace nearmiss::libfuzzer {

namespace {

constexpr std::size_t signals = 8;
constexpr std::size_t values = 128;

// libFuzzer clears these counters before each run, and treats each counter that the run sets as covered code.
[[gnu::used,
  gnu::section("__libfuzzer_extra_counters")]] std::array<std::uint8_t, signals * kinds.size() * values>
    counters;

std::string environment(const char* name, const char* otherwise) {
  const char* const value = std::getenv(name);
  return value != nullptr ? value : otherwise;
}

}  // namespace

const Subject& subject() {
  // A plug-in runs in this process, because libFuzzer sees the coverage of no other process.
  static const SubjectText text = SubjectText::parse(environment("NEARMISS_SUBJECT", target.subject));
  static const bool is_object = is_plugin(text.subject);
  static const auto subject =
      named(is_object ? make_subject(text.subject) : make_built_in(text.subject), text.name, is_object);
  return *subject;
}

void show(Signal signal, Kind kind, std::size_t value) {
  const auto row = static_cast<std::size_t>(signal) * kinds.size() + static_cast<std::size_t>(kind);
  counters[row * values + std::min(value, values - 1)] = 1;
}

void show_factor(Signal signal, Kind kind, double factor) {
  if (std::isnan(factor)) return;
  // The exponent -log2(factor) is clamped to the range from 2^-10 to 2^8. Whenever the exponent halves, the
  // value that is shown falls by four.
  const double exponent = std::clamp(-std::log2(factor), 0x1p-10, 0x1p8);
  show(signal, kind, static_cast<std::size_t>(4 * (std::log2(exponent) + 10)));
}

void fail(Finding::What what, const Query& query, double ratio) {
  Finding finding{.what = what,
                  .subject = subject().name(),
                  .family = "libfuzzer",
                  .query = query,
                  .provenance = "libfuzzer",
                  .ratio = ratio};
  if (what == Finding::What::oracle_disagreement) finding.subject.clear();
  const std::string line = to_line(query);
  const std::filesystem::path folder = environment("NEARMISS_CASES", ".");
  std::filesystem::create_directories(folder);
  const auto id = fmt::format("{:016x}", std::hash<std::string>()(line));
  const auto file = folder / case_file_name(finding, id);
  write_case(to_case(finding), file);
  fmt::print(stderr, "{}: {}: {} {}\n", to_case(finding).why, file.string(), short_name(query.kind), line);
  std::abort();
}

}  // namespace nearmiss::libfuzzer

// --- the functions that libFuzzer looks for --------------------------------------------------------------

namespace {

using namespace nearmiss;
using namespace nearmiss::libfuzzer;

bool keeps_contract_of_subject(const Query& query) {
  return untraced([&] { return keeps_contract(subject().rounded(query), subject().contract()); });
}

/// The query in an input. If the target or the subject takes no separations, the query's separation is set to
/// 0. Returns nothing if the input is not a query, or if the subject does not decide queries of its kind.
std::optional<Query> asked(const std::uint8_t* data, std::size_t size) {
  auto query = from_bytes(data, size);
  if (query && !subject().decides(query->kind)) return std::nullopt;
  if (query && !(target.takes_separations && subject().takes_separation(query->kind))) query->separation = 0;
  return query;
}

Query query_of(const std::uint8_t* data, std::size_t size) { return asked(data, size).value_or(Query{}); }

/// Throws Error if the subject on trial does not exist, or if the target cannot test it.
void expect_subject() {
  const Subject& on_trial = subject();
  if (target.needs_lower_bounds && !is_lower_bound(on_trial.time_sort()))
    throw Error(fmt::format("{}: promises no lower bound of the time, expected a subject that does",
                            on_trial.name()));
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
  try {
    expect_subject();
  } catch (const Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    std::exit(2);
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto query = asked(data, size);
  if (!query || !keeps_contract_of_subject(*query)) return -1;
  examine(*query);
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  if (max_size < query_bytes) return 0;
  Random random(seed, 0, 0);
  return to_bytes(mutated(random, query_of(data, size)), data);
}

extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* first, std::size_t first_size,
                                                 const std::uint8_t* second, std::size_t second_size,
                                                 std::uint8_t* out, std::size_t max_size, unsigned seed) {
  if (max_size < query_bytes) return 0;
  Random random(seed, 1, 0);
  return to_bytes(crossed(random, query_of(first, first_size), query_of(second, second_size)), out);
}

#include "fuzz/subjects/isolation/worker/program_description.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string_view>
#include <vector>

#include "ccd/query/error.hpp"
#include "ccd/query/kind.hpp"
#include "ccd/query/printable.hpp"

namespace nearmiss::isolation {

namespace {

/// Parses a number of this type that is at least 0.
template <class Number>
Number number(const std::string& text, const char* expected) {
  Number value = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || rest != text.data() + text.size() || !(value >= 0))
    throw Error("found '" + text + "', expected " + expected);
  return value;
}

double length(const std::string& text) { return number<double>(text, "a number"); }

std::uint32_t whole_number(const std::string& text) {
  return number<std::uint32_t>(text, "a whole number below 2^32");
}

/// The index of `value` in `words`, plus the number `first`. Throws Error if `words` does not contain the
/// value.
int place(const std::string& value, const std::vector<std::string>& words, int first) {
  for (std::size_t i = 0; i < words.size(); ++i)
    if (value == words[i]) return first + static_cast<int>(i);
  std::string known;
  for (const std::string& each : words) known += (known.empty() ? "" : ", ") + each;
  throw Error("found '" + value + "', expected one of " + known);
}

int yes_or_no(const std::string& value) { return place(value, {"no", "yes"}, 0); }

Error expected_kinds(const std::string& value) {
  std::string known;
  for (const Kind each : kinds) known.append(" ").append(short_name(each));
  return Error("found '" + value + "', expected some of" + known + ", each once");
}

/// Reads kinds with blanks between them, such as "vt ee", as a sum of their bits.
int sum_of_kinds(const std::string& value) {
  int sum = 0;
  std::istringstream words(value);
  for (std::string word; words >> word;) {
    const auto kind = std::ranges::find(kinds, word, short_name);
    const bool is_new = kind != kinds.end() && (sum & bit_of(*kind)) == 0;
    if (!is_new) throw expected_kinds(value);
    sum += bit_of(*kind);
  }
  if (sum == 0) throw expected_kinds(value);
  return sum;
}

void read_separation(const std::string& value, nearmiss_subject& subject) {
  if (value == "yes" || value == "no")
    subject.takes_separation = yes_or_no(value);
  else
    subject.separation_kinds = sum_of_kinds(value);
}

/// For each line that a description may have, the function that reads the line's value.
using Description = ProgramDescription;
const std::map<std::string_view, std::function<void(Description& to, const std::string& value)>> lines{
    {"name", [](auto& to, auto& value) { to.name = value; }},
    {"version", [](auto& to, auto& value) { to.version = value; }},
    {"about", [](auto& to, auto& value) { to.about = value; }},
    {"kinds", [](auto& to, auto& value) { to.subject.kinds = sum_of_kinds(value); }},
    {"bits", [](auto& to, auto& value) { to.subject.bits = static_cast<int>(whole_number(value)); }},
    {"time",
     [](auto& to, auto& value) {
       to.subject.time_sort =
           place(value, {"none", "estimate", "lower-bound", "free-step"}, NEARMISS_NO_TIME);
     }},
    {"separation", [](auto& to, auto& value) { read_separation(value, to.subject); }},
    {"distance", [](auto& to, auto& value) { to.subject.distance_kinds = sum_of_kinds(value); }},
    {"step", [](auto& to, auto& value) { to.subject.step_kinds = sum_of_kinds(value); }},
    {"batch", [](auto& to, auto& value) { to.subject.batch = whole_number(value); }},
    {"layout",
     [](auto& to, auto& value) {
       to.subject.layout = place(value, {"rows", "arrays"}, NEARMISS_ROWS);
     }},
    {"seconds", [](auto& to, auto& value) { to.says_seconds = yes_or_no(value) == 1; }},
    {"bound", [](auto& to, auto& value) { to.claims_bound = yes_or_no(value) == 1; }},
    {"apart-at-start", [](auto& to, auto& value) { to.subject.contract.apart_at_start = yes_or_no(value); }},
    {"one-root", [](auto& to, auto& value) { to.subject.contract.one_root = yes_or_no(value); }},
    {"apart-by", [](auto& to, auto& value) { to.subject.contract.apart_by = length(value); }},
    {"grid", [](auto& to, auto& value) { to.subject.contract.grid = length(value); }},
    {"shortest", [](auto& to, auto& value) { to.subject.contract.shortest = length(value); }},
    {"longest", [](auto& to, auto& value) { to.subject.contract.longest = length(value); }}};

}  // namespace

ProgramDescription ProgramDescription::parse(const std::string& text) {
  ProgramDescription description;
  description.subject.interface_version = NEARMISS_INTERFACE;
  std::set<std::string> keys;
  std::size_t at = text.find('\n') + 1;
  description.ignores_separation_in_bounds = text.starts_with("nearmiss 2\n");
  const bool is_known = description.ignores_separation_in_bounds || text.starts_with("nearmiss 3\n") ||
                        text.starts_with("nearmiss 4\n");
  if (!is_known)
    throw Error("found '" + text.substr(0, at - 1) + "', expected 'nearmiss 4', or an earlier version");
  while (at + 1 < text.size()) {
    const std::size_t end = text.find('\n', at);
    const std::string line = text.substr(at, end - at);
    at = end + 1;
    const std::size_t blank = line.find(' ');
    const std::string key = line.substr(0, blank);
    if (line.find('\0') != std::string::npos)
      throw Error("found a NUL character in '" + printable(line) + "', expected text");
    if (!keys.insert(key).second) throw Error("found the line '" + key + "' twice, expected it once");
    const auto read = lines.find(key);
    if (read == lines.end())
      throw Error("found the line '" + key + "', expected one that fuzz/subjects/PROGRAMS.md lists");
    read->second(description, blank == std::string::npos ? "" : line.substr(blank + 1));
  }
  return description;
}

}  // namespace nearmiss::isolation

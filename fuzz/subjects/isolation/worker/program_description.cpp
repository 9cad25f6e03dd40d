#include "fuzz/subjects/isolation/worker/program_description.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
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

/// A value's place among words, counted from `first`.
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

/// Reads a line of the contract; false if it is not one.
bool read_contract_line(std::string_view key, const std::string& value, nearmiss_contract& contract) {
  if (key == "apart-at-start") {
    contract.apart_at_start = yes_or_no(value);
  } else if (key == "one-root") {
    contract.one_root = yes_or_no(value);
  } else if (key == "apart-by") {
    contract.apart_by = length(value);
  } else if (key == "grid") {
    contract.grid = length(value);
  } else if (key == "shortest") {
    contract.shortest = length(value);
  } else if (key == "longest") {
    contract.longest = length(value);
  } else {
    return false;
  }
  return true;
}

void read_line(std::string_view key, const std::string& value, ProgramDescription& into) {
  nearmiss_subject& subject = into.subject;
  if (key == "name") {
    into.name = value;
  } else if (key == "version") {
    into.version = value;
  } else if (key == "about") {
    into.about = value;
  } else if (key == "kinds") {
    subject.kinds = sum_of_kinds(value);
  } else if (key == "bits") {
    subject.bits = static_cast<int>(whole_number(value));
  } else if (key == "time") {
    subject.time_sort = place(value, {"none", "estimate", "lower-bound", "free-step"}, NEARMISS_NO_TIME);
  } else if (key == "separation") {
    if (value == "yes" || value == "no")
      subject.takes_separation = yes_or_no(value);
    else
      subject.separation_kinds = sum_of_kinds(value);
  } else if (key == "distance") {
    subject.distance_kinds = sum_of_kinds(value);
  } else if (key == "step") {
    subject.step_kinds = sum_of_kinds(value);
  } else if (key == "batch") {
    subject.batch = whole_number(value);
  } else if (key == "layout") {
    subject.layout = place(value, {"rows", "arrays"}, NEARMISS_ROWS);
  } else if (key == "seconds") {
    into.says_seconds = yes_or_no(value) == 1;
  } else if (key == "bound") {
    into.claims_bound = yes_or_no(value) == 1;
  } else if (!read_contract_line(key, value, subject.contract)) {
    throw Error("found the line '" + std::string(key) +
                "', expected one that fuzz/subjects/PROGRAMS.md lists");
  }
}

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
    read_line(key, blank == std::string::npos ? "" : line.substr(blank + 1), description);
  }
  return description;
}

}  // namespace nearmiss::isolation

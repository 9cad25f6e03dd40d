// Options with numbers as values, as in "NAME:thickness=1e-6:barycentric=0.1".
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace nearmiss {

/// A member of State that is a number, which the user may set by KEY=VALUE.
template <class State>
struct Option {
  const char* key;
  double State::*value;
  double least, most;  ///< the least and the largest value that the user may set
};

/// Sets one option. `text` is KEY=VALUE, and `is_set` marks the options that have been set. Returns false if
/// no option has this key, if the option was already set, or if the value is not allowed.
template <class State, std::size_t n>
bool set_option(const std::array<Option<State>, n>& options, const std::string& text, State& state,
                std::array<bool, n>& is_set) {
  const std::size_t sign = text.find('=');
  if (sign == std::string::npos) return false;
  const char* const number = text.c_str() + sign + 1;
  char* rest = nullptr;
  const double value = std::strtod(number, &rest);
  if (rest == number || *rest != '\0') return false;
  for (std::size_t i = 0; i < n; ++i) {
    const Option<State>& option = options[i];
    if (text.compare(0, sign, option.key) != 0) continue;
    if (is_set[i]) return false;
    is_set[i] = true;
    state.*option.value = value;
    return value >= option.least && value <= option.most;
  }
  return false;
}

/// Sets the options in `text`, such as "tolerance=1e-6:iterations=1000". Returns a description of the first
/// fault, or "" if there is none.
template <class State, std::size_t n>
std::string set_options(const std::array<Option<State>, n>& options, const std::string& text, State& state) {
  std::array<bool, n> is_set{};
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(':', at), text.size());
    const std::string part = text.substr(at, end - at);
    at = end + 1;
    if (set_option(options, part, state, is_set)) continue;
    std::array<char, 128> line{};
    std::string expected;
    for (const Option<State>& option : options) {
      std::snprintf(line.data(), line.size(), "%s%s=NUMBER from %g to %g", expected.empty() ? "" : " or ",
                    option.key, option.least, option.most);
      expected.append(line.data());
    }
    std::string fault = "found '";
    fault.append(part).append("', expected ").append(expected);
    return fault.append(n == 1 ? ", once" : ", each once");
  }
  return "";
}

}  // namespace nearmiss

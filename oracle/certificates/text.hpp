// Certificates as text: JSON with all numbers as strings.
#pragma once

#include <optional>
#include <string>

#include "ccd/query/query.hpp"
#include "oracle/exact/polynomial.hpp"

namespace nearmiss::certificates {

/// x as text, such as "3" or "0x1.8p-3"; "p/q" if x is not a double.
std::string to_text(const exact::Number& x);

/// The beginning of a certificate: from {"kind": to the value of the key "to". Certificates of both claims,
/// "apart" and "meets", begin with the same keys. `to` is the text of a number.
std::string heading(const Query& query, const char* claim, double from, const std::string& to);

/// Returns the certificate, or nothing if the certificate or one of its numbers is longer than the checkers
/// accept.
std::optional<std::string> if_short(std::string certificate);

/// [a,b,...], where text(element) gives the text of each element.
template <class List, class Text>
std::string list(List&& elements, const Text& text) {
  std::string result = "[";
  for (auto&& each : elements) {
    if (result.size() > 1) result += ',';
    result += text(each);
  }
  return result + "]";
}

inline std::string quoted(const std::string& text) { return '"' + text + '"'; }

}  // namespace nearmiss::certificates

#include "fuzz/trial/signatures.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>

#include "ccd/nearmiss_subject.h"
#include "ccd/query/printable.hpp"
#include "oracle/features.hpp"

namespace nearmiss {

namespace {

std::string signature(Kind kind, std::string_view features) {
  return std::string(short_name(kind)).append(" ").append(features);
}

/// The text with each number in it replaced by #. The result is cut to a readable length.
std::string without_numbers(std::string_view text) {
  constexpr std::size_t most = 80;
  std::string result;
  for (const char c : text) {
    const bool digit = c >= '0' && c <= '9';
    const bool goes_on = !result.empty() && result.back() == '#' && (digit || c == '.');
    if (!goes_on) result += digit ? '#' : c;
  }
  if (result.size() <= most) return result;
  result.resize(most);
  return printable(result);
}

/// The signature of a collision with an invalid time has this text after the kind.
constexpr std::string_view invalid_time = "invalid time";

/// "invalid time NaN", for example
std::string invalid_answer(const Verdict& verdict) {
  if (verdict.fault_code != NEARMISS_COLLISION) return "invalid answer";
  return std::string(invalid_time) + (std::isnan(verdict.time) ? " NaN" : "");
}

}  // namespace

std::string contact_signature(const Query& query) {
  if (query.separation > 0) {
    const auto features = approach_features(query);
    return signature(query.kind, features ? to_text(query.kind, *features) : "no-approach");
  }
  const auto features = contact_features(query);
  return signature(query.kind, features ? to_text(query.kind, *features) : "no-contact");
}

std::string report_signature(Kind kind, Stage stage) {
  return signature(kind, stage_names[static_cast<std::size_t>(stage)]);
}

std::string fault_signature(Kind kind, const Verdict& verdict, std::string_view text) {
  const std::string name(fault_names[static_cast<std::size_t>(verdict.fault)]);
  switch (verdict.fault) {
    case Fault::crash: {
      if (verdict.fault_code <= 0) return signature(kind, "exit " + std::to_string(-verdict.fault_code));
      const char* const abbreviation = sigabbrev_np(verdict.fault_code);
      return signature(kind, name + " " + (abbreviation != nullptr ? abbreviation : "of an unknown signal"));
    }
    case Fault::exception:
    case Fault::load:
      return signature(kind, name + " " + without_numbers(text));
    case Fault::error:
      return signature(kind, name + " " + std::to_string(verdict.fault_code));
    case Fault::invalid:
      return signature(kind, invalid_answer(verdict));
    default:
      return signature(kind, name);
  }
}

std::string fault_signature(const Subject& subject, Kind kind, Fault fault, std::int32_t code) {
  const Verdict none{.fault = fault, .fault_code = code};
  return fault_signature(kind, none, subject.fault_text(none));
}

bool is_of_invalid_time(std::string_view text) {
  return std::any_of(kinds.begin(), kinds.end(),
                     [&](Kind kind) { return text.starts_with(signature(kind, invalid_time)); });
}

std::string disagreement_signature(Kind kind, std::string_view text) {
  return text.empty() ? "" : signature(kind, text);
}

}  // namespace nearmiss

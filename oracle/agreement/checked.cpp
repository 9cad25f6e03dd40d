#include "oracle/agreement/checked.hpp"

#include <cmath>
#include <limits>

#include "ccd/query/arithmetic.hpp"
#include "oracle/agreement/methods.hpp"

namespace nearmiss {

certificates::Statement statement_about(const Query& query, std::string_view claim, const Span& span,
                                        bool is_strict) {
  return {.kind = std::string(short_name(query.kind)),
          .x = coordinate_list(query),
          .h = query.separation,
          .claim = std::string(claim),
          .from = span.from,
          .to = span.to,
          .open = span.is_open,
          .strict = is_strict};
}

std::optional<certificates::Statement> proved(const std::optional<std::string>& certificate) {
  if (!certificate) return std::nullopt;
  try {
    return certificates::check(*certificate);
  } catch (const certificates::Refused&) {
    return std::nullopt;
  }
}

namespace {

constexpr double largest = std::numeric_limits<double>::max();

bool is_proved_to_meet(const Query& query, const Span& span) {
  return proved(certify_meets(query, span)) == statement_about(query, "meets", span, false);
}

bool is_proved_apart(const Query& query, const Span& span) {
  return proved(certify_apart(query, span)) == statement_about(query, "apart", span, true);
}

Query with_next_separation(const Query& query, double towards) {
  return with_separation(query, std::nextafter(query.separation, towards));
}

/// Like is_proved_to_meet(), but with the next double above h as the separation. If h is the largest double,
/// returns true without a proof: the next number is infinity, and every distance is at most infinity.
bool is_proved_to_meet_above(const Query& query, const Span& span) {
  return query.separation == largest || is_proved_to_meet(with_next_separation(query, largest), span);
}

/// Whether a certificate proves that the distance is below h > 0 at some time in an interval [0, to] with to
/// < `time`.
bool is_proved_below(const Query& query, double time) {
  const Span span = time > 1 ? Span{} : Span{0, time, true};
  const auto said = proved(certify_meets(query, span, true));
  if (!said || said->to >= time) return false;
  auto expected = statement_about(query, "meets", {}, true);
  expected.to = said->to;
  return *said == expected;
}

}  // namespace

bool is_proved(const Query& query, const Decision& decision) {
  const PlainArithmetic guard;
  if (!decision.is_tie) return proved_answer(query).collision == decision.collision;
  return is_proved_apart(with_next_separation(query, 0), {}) && is_proved_to_meet_above(query, {});
}

std::string time_disagreement(const Query& query, const Decision& decision) {
  const PlainArithmetic guard;
  EarliestTime time(query, decision.known);
  const Enclosure t = time.enclosure();
  if (t.lo > 0 && !is_proved_apart(query, {0, t.lo, true})) return "time (not proved: before)";
  const Span within{t.lo, t.hi};
  const double after = std::nextafter(t.hi, 2.0);
  const bool touches = query.separation > 0 && !time.makes_late(after);
  if (!is_proved_to_meet(query, within) && !(touches && is_proved_to_meet_above(query, within)))
    return "time (not proved: within)";
  if (query.separation == 0) return "";
  if (!touches) return is_proved_below(query, after) ? "" : "time (not proved: below)";
  return is_proved_apart(with_next_separation(query, 0), {0, t.hi}) ? "" : "time (not proved: touches)";
}

std::string disagreement(const Query& query, const Decision& decision, const Answers& answers) {
  std::string text = answers.disagreement(filter_answer(query, decision));
  if (text.empty() && decision.is_tie && !is_proved(query, decision)) text = "tie (not proved)";
  if (text.empty() && (decision.collision || decision.is_tie)) text = time_disagreement(query, decision);
  return text;
}

}  // namespace nearmiss

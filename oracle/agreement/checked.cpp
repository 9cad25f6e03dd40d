#include "oracle/agreement/checked.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ccd/query/arithmetic.hpp"
#include "oracle/agreement/methods.hpp"

namespace nearmiss {

certificates::Statement statement_about(const Query& query, std::string_view claim, const Span& span,
                                        bool is_strict) {
  return {.kind = std::string(short_name(query.kind)),
          .x = {query.x.begin(), query.x.end()},
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

/// Whether a certificate proves that the distance is at most the query's separation in a span.
bool is_proved_to_meet(const Query& query, const Span& span) {
  return proved(certify_meets(query, span)) == statement_about(query, "meets", span, false);
}

bool is_proved_apart(const Query& query, const Span& span) {
  return proved(certify_apart(query, span)) == statement_about(query, "apart", span, true);
}

Query with_next_separation(const Query& query, double towards) {
  return with_separation(query, std::nextafter(query.separation, towards));
}

/// The same for the double above h. There is none above the largest one, for which nothing needs a proof.
bool is_proved_to_meet_above(const Query& query, const Span& span) {
  return query.separation == largest || is_proved_to_meet(with_next_separation(query, largest), span);
}

/// Whether a certificate proves that the distance is below h > 0 before a time.
bool is_proved_below(const Query& query, double time) {
  const Span span = time > 1 ? Span{} : Span{0, time, true};
  const auto said = proved(certify_meets(query, span, true));
  auto expected = statement_about(query, "meets", {0, std::min(time, 1.0)}, true);
  if (said && said->to < expected.to) expected.to = said->to;  // an open span's certificate ends before it
  return said == expected && (time > 1 || said->to < time);
}

/// The complaint about what happens to the distance right after the enclosure of t*, for h > 0.
std::string complaint_after(const Query& query, EarliestTime& time, const Enclosure& t) {
  const double after = std::nextafter(t.hi, 2.0);
  if (time.makes_late(after)) return is_proved_below(query, after) ? "" : "time (not proved: below)";
  return is_proved_apart(with_next_separation(query, 0), {0, t.hi}) ? "" : "time (not proved: touches)";
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
  const bool touches = query.separation > 0 && !time.makes_late(std::nextafter(t.hi, 2.0));
  if (!is_proved_to_meet(query, within) && !(touches && is_proved_to_meet_above(query, within)))
    return "time (not proved: within)";
  return query.separation > 0 ? complaint_after(query, time, t) : "";
}

std::string disagreement(const Query& query, const Decision& decision, const Answers& answers) {
  std::string text = answers.disagreement(filter_answer(query, decision));
  if (text.empty() && decision.is_tie && !is_proved(query, decision)) text = "tie (not proved)";
  if (text.empty() && (decision.collision || decision.is_tie)) text = time_disagreement(query, decision);
  return text;
}

}  // namespace nearmiss

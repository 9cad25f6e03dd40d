#include "oracle/agreement/checked.hpp"

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

/// Whether a certificate proves that the distance is at most the query's separation in a span.
bool is_proved_to_meet(const Query& query, const Span& span) {
  return proved(certify_meets(query, span)) == statement_about(query, "meets", span, false);
}

Query with_next_separation(const Query& query, double towards) {
  return with_separation(query, std::nextafter(query.separation, towards));
}

constexpr double largest = std::numeric_limits<double>::max();

}  // namespace

bool is_proved(const Query& query, const Decision& decision) {
  const PlainArithmetic guard;
  if (!decision.is_tie) return proved_answer(query).collision == decision.collision;
  const Query below = with_next_separation(query, 0);
  return proved(certify_apart(below, {})) == statement_about(below, "apart", {}, true) &&
         is_proved_to_meet(with_next_separation(query, largest), {});
}

std::string time_disagreement(const Query& query, const Decision& decision) {
  const PlainArithmetic guard;
  EarliestTime time(query, decision.known);
  const Enclosure t = time.enclosure();
  const Span before{0, t.lo, true};
  if (t.lo > 0 && proved(certify_apart(query, before)) != statement_about(query, "apart", before, true))
    return "time (not proved: before)";
  const Span within{t.lo, t.hi};
  if (is_proved_to_meet(query, within)) return "";
  const bool touches = query.separation > 0 && !time.makes_late(std::nextafter(t.hi, 2.0));
  if (touches && is_proved_to_meet(with_next_separation(query, largest), within)) return "";
  return "time (not proved: within)";
}

}  // namespace nearmiss

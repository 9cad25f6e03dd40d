#include "oracle/agreement/checked.hpp"

#include <cmath>

#include "ccd/query/arithmetic.hpp"

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

std::string time_disagreement(const Query& query, const Decision& decision) {
  const PlainArithmetic guard;
  EarliestTime time(query, decision.known);
  const Enclosure t = time.enclosure();
  const Span before{0, t.lo, true};
  if (t.lo > 0 && proved(certify_apart(query, before)) != statement_about(query, "apart", before, true))
    return "time (not proved: before)";
  const Span within{t.lo, t.hi};
  const auto certificate = certify_meets(query, within);
  // If the distance touches h at t*, and falls below it later or never, t* may be irrational.
  if (!certificate && query.separation > 0 && !time.makes_late(std::nextafter(t.hi, 2.0))) return "";
  return proved(certificate) == statement_about(query, "meets", within, false) ? ""
                                                                               : "time (not proved: within)";
}

}  // namespace nearmiss

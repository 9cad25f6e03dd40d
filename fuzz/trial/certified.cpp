#include "fuzz/trial/certified.hpp"

#include <cmath>
#include <optional>

#include "oracle/distance.hpp"

namespace nearmiss {

certificates::Statement statement_about(const Query& query, const char* claim, const Span& span,
                                        bool is_strict) {
  return {.kind = std::string(short_name(query.kind)),
          .x = {query.x.begin(), query.x.end()},
          .h = query.separation,
          .claim = claim,
          .from = span.from,
          .to = span.to,
          .open = span.is_open,
          .strict = is_strict};
}

std::string certificate_of(const Finding& finding) {
  const Query& query = finding.shrunk;
  const auto certificate = [&] {
    switch (finding.what) {
      case Finding::What::late:
        return certify_meets(query, {0, finding.time, true}, query.separation > 0);
      case Finding::What::refuted_bound:
        return certify_apart(with_separation(query, separation_and_bound(query, finding.bound)), {});
      default:
        return certify(query);
    }
  };
  return certificate().value_or("");
}

namespace {

/// "" if the certificate proves this.
std::string complaint(const std::optional<std::string>& certificate,
                      const certificates::Statement& statement) {
  if (!certificate) return "no certificate";
  try {
    if (certificates::check(*certificate) == statement) return "";
  } catch (const certificates::Refused&) {
  }
  return "certificate (refused)";
}

/// The complaint about the enclosure of t*: nothing happens before it, and something happens in it.
std::string complaint_about_time(const Query& query, const Decision& decision) {
  EarliestTime time(query, decision.known);
  const Enclosure t = time.enclosure();
  const Span before{0, t.lo, true};
  const Span within{t.lo, t.hi};
  std::string text;
  if (t.lo > 0) text = complaint(certify_apart(query, before), statement_about(query, "apart", before, true));
  if (!text.empty()) return text;
  const auto certificate = certify_meets(query, within);
  // If the distance touches h at t*, and falls below it later or never, t* may be irrational.
  if (!certificate && query.separation > 0 && !time.makes_late(std::nextafter(t.hi, 2.0))) return "";
  return complaint(certificate, statement_about(query, "meets", within, false));
}

}  // namespace

std::string decision_disagreement(const Query& query, const Decision& decision) {
  const bool meets = decision.collision || decision.is_tie;
  const bool is_strict = !meets || (query.separation > 0 && !decision.is_tie);
  return complaint(certify(query), statement_about(query, meets ? "meets" : "apart", {}, is_strict));
}

std::string certificate_disagreement(const Query& query, const Decision& decision) {
  if (decision.is_tie) return "";
  const std::string text = decision_disagreement(query, decision);
  return text.empty() && decision.collision ? complaint_about_time(query, decision) : text;
}

}  // namespace nearmiss

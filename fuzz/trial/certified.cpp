#include "fuzz/trial/certified.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>

#include "oracle/certificates/statements.hpp"
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

/// "" if the certificate proves one of these statements.
std::string complaint(const std::optional<std::string>& certificate,
                      std::initializer_list<certificates::Statement> statements) {
  if (!certificate) return "no certificate";
  try {
    const auto proved = certificates::check(*certificate);
    if (std::ranges::find(statements, proved) != statements.end()) return "";
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
  if (t.lo > 0)
    text = complaint(certify_apart(query, before), {statement_about(query, "apart", before, true)});
  if (!text.empty()) return text;
  const auto certificate = certify_meets(query, within);
  // If the distance touches h at t*, and falls below it later or never, t* may be irrational.
  if (!certificate && query.separation > 0 && !time.makes_late(std::nextafter(t.hi, 2.0))) return "";
  return complaint(certificate, {statement_about(query, "meets", within, false)});
}

/// The complaint about the bounds of the smallest distance.
std::string complaint_about_distance(const Query& query) {
  const auto about = [&](double bound, const char* claim, bool is_strict) {
    return statement_about(with_separation(query, bound), claim, {}, is_strict);
  };
  const auto [lo, hi] = minimum_distance(query);
  const Certificates proofs = certify_distance(query);
  std::string text;
  if (lo > 0)
    text =
        complaint(proofs.front(), {about(lo, "apart", false), about(std::nextafter(lo, 0), "apart", true)});
  if (text.empty() && std::isfinite(hi))
    text = complaint(proofs.back(),
                     {about(hi, "meets", false), about(std::nextafter(hi, HUGE_VAL), "meets", false)});
  return text;
}

}  // namespace

std::string decision_disagreement(const Query& query, const Decision& decision) {
  const bool meets = decision.collision || decision.is_tie;
  const bool is_strict = !meets || (query.separation > 0 && !decision.is_tie);
  return complaint(certify(query), {statement_about(query, meets ? "meets" : "apart", {}, is_strict)});
}

std::string certificate_disagreement(const Query& query, const Decision& decision) {
  if (decision.is_tie) return "";
  std::string text = decision_disagreement(query, decision);
  if (text.empty() && decision.collision) text = complaint_about_time(query, decision);
  return text.empty() ? complaint_about_distance(query) : text;
}

}  // namespace nearmiss

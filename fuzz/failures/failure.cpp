#include "fuzz/failures/failure.hpp"

#include <cmath>
#include <span>

#include "ccd/error.hpp"
#include "fuzz/failures/shrink.hpp"
#include "oracle/features.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {

namespace {

std::string signature(Kind kind, std::string_view features) {
  return std::string(short_name(kind)).append(" ").append(features);
}

std::optional<std::string> miss(const Subject& subject, const Query& query) {
  if (subject.decide(query).hit || !collides(query)) return std::nullopt;
  return contact_signature(query);
}

std::optional<std::string> refuted_bound(const Subject& subject, const Query& query) {
  const Verdict verdict = subject.decide(query);
  if (!verdict.hit) return std::nullopt;
  const double bound = subject.distance_bound(query);
  if (!std::isfinite(bound) || collides(query) || !distance_exceeds(query, bound)) return std::nullopt;
  return report_signature(query.kind, verdict.stage);
}

std::optional<std::string> disagreement(const Query& query) {
  Decision decision;
  decide(std::span(&query, 1), std::span(&decision, 1));
  const std::string found = disagreement_signature(query.kind, ask_all(query), decision.collision);
  return found.empty() ? std::nullopt : std::optional(found);
}

}  // namespace

std::string contact_signature(const Query& query) {
  const auto features = contact_features(query);
  return signature(query.kind, features ? to_text(query.kind, *features) : "no-contact");
}

std::string report_signature(Kind kind, Stage stage) {
  return signature(kind, stage_names[static_cast<std::size_t>(stage)]);
}

std::string disagreement_signature(Kind kind, const Answers& answers, bool collision) {
  std::string parts = answers.disagreement();
  if (answers.exact != collision) parts += parts.empty() ? "filter" : " filter";
  return parts.empty() ? parts : signature(kind, parts);
}

std::optional<std::string> failure(Finding::What what, const Subject* subject, const Query& query) {
  switch (what) {
    case Finding::What::false_negative:
      return miss(*subject, query);
    case Finding::What::refuted_bound:
      return refuted_bound(*subject, query);
    case Finding::What::oracle_disagreement:
      return disagreement(query);
    case Finding::What::truth_mismatch:
      break;
  }
  return std::nullopt;
}

Query shrunk_query(const Finding& finding, const Subject* subject) {
  return shrunk(finding.query, [&](const Query& query) {
    try {
      return failure(finding.what, subject, query) == finding.signature;
    } catch (const Error&) {
      return false;
    }
  });
}

}  // namespace nearmiss

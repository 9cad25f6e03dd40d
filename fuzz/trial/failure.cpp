#include "fuzz/trial/failure.hpp"

#include <cmath>
#include <cstring>
#include <span>

#include "ccd/error.hpp"
#include "fuzz/trial/shrink.hpp"
#include "oracle/features.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {

namespace {

std::string signature(Kind kind, std::string_view features) {
  return std::string(short_name(kind)).append(" ").append(features);
}

std::optional<std::string> miss(const Subject& subject, const Query& query) {
  const Verdict verdict = subject.decide(query);
  if (verdict.hit || verdict.fault != Fault::none || !collides(query)) return std::nullopt;
  return contact_signature(query);
}

std::optional<std::string> refuted_bound(const Subject& subject, const Query& query) {
  const Verdict verdict = subject.decide(query);
  if (!verdict.hit) return std::nullopt;
  const double bound = subject.distance_bound(query);
  if (!std::isfinite(bound) || collides(query) || !distance_exceeds(query, bound)) return std::nullopt;
  return report_signature(query.kind, verdict.stage);
}

std::optional<std::string> fault(const Subject& subject, const Query& query) {
  const Verdict verdict = subject.decide(query);
  if (verdict.fault == Fault::none) return std::nullopt;
  return fault_signature(query.kind, verdict);
}

std::optional<std::string> disagreement(const Query& query) {
  Decision decision;
  decide(std::span(&query, 1), std::span(&decision, 1));
  const std::string found = disagreement_signature(query.kind, ask_all(query), decision.by_filter());
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

std::string fault_signature(Kind kind, const Verdict& verdict) {
  const std::string name(fault_names[static_cast<std::size_t>(verdict.fault)]);
  switch (verdict.fault) {
    case Fault::crash: {
      if (verdict.fault_code <= 0) return signature(kind, "exit " + std::to_string(-verdict.fault_code));
      const char* const abbreviation = sigabbrev_np(verdict.fault_code);
      return signature(kind, name + " " + (abbreviation != nullptr ? abbreviation : "of an unknown signal"));
    }
    case Fault::error:
      return signature(kind, name + " " + std::to_string(verdict.fault_code));
    default:
      return signature(kind, name);
  }
}

std::string disagreement_signature(Kind kind, const Answers& answers, std::optional<bool> by_filter) {
  const std::string parts = answers.disagreement(by_filter);
  return parts.empty() ? parts : signature(kind, parts);
}

std::optional<std::string> failure(Finding::What what, const Subject* subject, const Query& query) {
  switch (what) {
    case Finding::What::false_negative:
      return miss(*subject, query);
    case Finding::What::refuted_bound:
      return refuted_bound(*subject, query);
    case Finding::What::fault:
      return fault(*subject, query);
    case Finding::What::oracle_disagreement:
      return disagreement(query);
    case Finding::What::truth_mismatch:
      break;
  }
  return std::nullopt;
}

Query shrunk_query(const Finding& finding, const Subject* subject) {
  // A query that is over its limit takes as long as that each time.
  constexpr int most_late = 8;
  int late = 0;
  return shrunk(finding.query, [&](const Query& query) {
    try {
      if (late == most_late) return false;
      const auto signature = failure(finding.what, subject, query);
      late += signature && signature->ends_with(fault_names[static_cast<std::size_t>(Fault::time)]) ? 1 : 0;
      return signature == finding.signature;
    } catch (const Error&) {
      return false;
    }
  });
}

}  // namespace nearmiss

#include "fuzz/trial/sieve.hpp"

#include <algorithm>
#include <cmath>

#include "fuzz/parallel.hpp"
#include "fuzz/trial/shrunk_finding.hpp"
#include "fuzz/trial/signatures.hpp"

namespace nearmiss {

namespace {

/// The subject's time for the shrunk query. If it does not answer as before, that of the original query stays.
double time_of_shrunk(const Finding& finding, const Subject& subject) {
  const double time = subject.decide(finding.shrunk).time;
  return std::isnan(time) ? finding.time : time;
}

}  // namespace

const Subject* Sieve::subject_of(const Finding& finding) const {
  const auto same = [&](const auto& subject) { return subject->name() == finding.subject; };
  const auto subject = std::find_if(subjects_.begin(), subjects_.end(), same);
  return subject == subjects_.end() ? nullptr : subject->get();  // findings of the oracle have no subject
}

void Sieve::know(std::span<const Finding> kept) {
  for (const Finding& finding : kept) first_.take(finding);
}

void Sieve::sift(std::vector<Finding>& findings) {
  std::erase_if(findings, [&](const Finding& f) { return !first_.take(f); });
  shrink(findings);
}

void Sieve::shrink(std::vector<Finding>& findings) const {
  in_parallel(jobs_, findings.size(), [&](std::size_t i) {
    Finding& finding = findings[i];
    if (finding.is_shrunk) return;
    try {
      // Every step would take as long as the time limit. `nearmiss shrink` does it.
      const bool is_slow = finding.what == Finding::What::fault && is_of_time_limit(finding.signature);
      if (!is_slow) finding.shrunk = shrunk_query(finding, subject_of(finding), stop_, limits_in_campaign);
      if (finding.what == Finding::What::late && finding.shrunk != finding.query)
        finding.time = time_of_shrunk(finding, *subject_of(finding));
      finding.is_shrunk = true;
    } catch (const Stopped&) {  // the finding stays as it is
    }
  });
}

}  // namespace nearmiss

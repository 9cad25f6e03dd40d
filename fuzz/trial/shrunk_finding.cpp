#include "fuzz/trial/shrunk_finding.hpp"

#include "ccd/error.hpp"
#include "fuzz/subjects/isolation/plugin_file.hpp"
#include "fuzz/trial/judge.hpp"
#include "fuzz/trial/shrink.hpp"
#include "fuzz/trial/signatures.hpp"
#include "fuzz/trial/small_queries.hpp"

namespace nearmiss {

namespace {

/// What was found in the last moment of a campaign's time is still shrunk.
constexpr std::chrono::milliseconds grace{1000};

Query shrunk_failure_of_subject(const Finding& finding, const Subject& subject, const Stop& stop) {
  constexpr int most_late = 8;  // each query over its time limit takes the full limit
  int late = 0;
  const Judge judge(subject);
  const auto fails = [&](const Query& query) {
    stop.check(grace);
    try {
      if (late == most_late) return false;
      const auto failure = judge.failure(query);
      late += failure && is_of_time_limit(failure->signature) ? 1 : 0;
      return failure == Failure{finding.what, finding.signature};
    } catch (const isolation::PluginChanged&) {
      throw;
    } catch (const Error&) {
      return false;
    }
  };
  const bool every_query_is_slow = is_of_time_limit(finding.signature);
  const auto small =
      every_query_is_slow ? std::nullopt : simplest_small_failure(finding, subject, fails, stop, grace);
  return subject.rounded(shrunk(small.value_or(finding.query), fails));
}

}  // namespace

Query shrunk_query(const Finding& finding, const Subject* subject, const Stop& stop) {
  switch (finding.what) {
    case Finding::What::truth_mismatch:
      return finding.query;
    case Finding::What::oracle_disagreement:
      return shrunk(finding.query, [&](const Query& query) {
        stop.check(grace);
        return oracle_failure(query) == Failure{finding.what, finding.signature};
      });
    default:
      return shrunk_failure_of_subject(finding, *subject, stop);
  }
}

}  // namespace nearmiss

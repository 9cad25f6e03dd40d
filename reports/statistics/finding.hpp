// Findings, and signatures (ways to fail).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "ccd/query/query.hpp"
#include "reports/statistics/query_class.hpp"

namespace nearmiss {

/// A query on which a subject or the oracle failed.
struct Finding {
  enum class What : std::uint8_t {
    false_negative,
    refuted_bound,
    oracle_disagreement,
    truth_mismatch,
    fault,
    late,       ///< the subject's time is later than t*, although the subject promises a lower bound of t*
    committed,  ///< a promised lower bound is sound, but the rounded step to it has contact before its end
    /// The rounded step has contact before its end, although the subject promises a step without contact.
    unsafe_step
  };

  What what{};
  std::string subject;  ///< empty if the oracle failed
  std::string family;
  Query query;
  std::string provenance;
  double ratio = 0;  ///< distance divided by bound, if a bound was refuted; time - t*, if the time is late
  std::string signature = {};  ///< the way in which the query fails, such as "vt simple-root inside on-edge"
  /// The simplest known query that fails in the same way and has the same class as `query`. It may be
  /// `query` itself.
  Query shrunk = {};
  std::uint64_t place = 0;  ///< position of the query's case in the order of the whole campaign
  double time = 0;          ///< the subject's time for the shrunk query, if the finding has_time()
  bool is_shrunk = false;   ///< whether shrinking is finished
  QueryClass query_class = QueryClass::unclassified;
  Query simplest = {};  ///< the simplest known query that fails in the same way, of any class; often `shrunk`
  QueryClass simplest_class = QueryClass::unclassified;
  /// The earlier version of the subject's CCD, if that version does not fail on `query`; "" otherwise.
  std::string broken_since = {};
  double bound = 0;  ///< the bound that the subject claims for the shrunk query, if it is refuted
  Query step = {};   ///< the rounded step to `time`, if the finding has_step()
  /// A proof that the oracle is right where it contradicts the subject on the shrunk query, as a line of JSON
  /// (tools/certificates/README.md); "" without a proof.
  std::string certificate = {};
  /// For a fault: the end of the text that the subject's process wrote to standard error, as printable lines;
  /// "" if the process wrote nothing. After a crash, the text includes the functions on the stack.
  std::string errors = {};

  bool operator==(const Finding&) const = default;
};

/// The names of the sorts of failure, as files and reports write them, in the order of the enumeration.
inline constexpr std::array<std::string_view, 8> what_names{
    "false-negative", "refuted-bound", "oracle-disagreement", "truth-mismatch",
    "fault",          "late",          "committed",           "unsafe-step"};

constexpr std::string_view name(Finding::What what) { return what_names[static_cast<std::size_t>(what)]; }

/// Whether a finding of this sort is about the rounded step to the time that the subject gave.
constexpr bool has_step(Finding::What what) {
  return what == Finding::What::committed || what == Finding::What::unsafe_step;
}

/// Whether a finding of this sort stores the time that the subject gave.
constexpr bool has_time(Finding::What what) { return what == Finding::What::late || has_step(what); }

/// Whether reports show findings of this sort without counting them as failures. Such a finding breaks no
/// promise. Therefore it does not count as a failure of a version, is not a new way to fail since a baseline,
/// and does not make a user's test fail.
constexpr bool is_only_shown(Finding::What what) { return what == Finding::What::committed; }

/// A way to fail.
struct Signature {
  Finding::What what{};
  std::string subject;
  std::string text;  ///< Finding::signature

  bool operator==(const Signature&) const = default;
  bool operator<(const Signature& other) const {
    return std::tie(what, subject, text) < std::tie(other.what, other.subject, other.text);
  }
};

inline Signature signature_of(const Finding& finding) {
  return {finding.what, finding.subject, finding.signature};
}

/// The largest number of findings of each signature and class that are kept and shown; Statistics::seen
/// counts all findings.
inline constexpr std::size_t findings_kept = 3;

/// Takes the findings of a campaign one by one, in their order, and picks the first findings of each
/// signature in each class of queries. If an earlier version of the CCD does not fail on the query of a
/// finding, the finding is counted separately.
class FirstFindings {
 public:
  /// Counts the finding. Returns its number among the findings of its signature and class, from 1 on.
  std::size_t count(const Finding& finding) {
    return ++counted_[{signature_of(finding), finding.query_class, finding.broken_since}];
  }
  /// Counts the finding. Returns whether the finding is among the first `findings_kept` findings of its
  /// signature and class.
  bool take(const Finding& finding) { return count(finding) <= findings_kept; }

 private:
  std::map<std::tuple<Signature, QueryClass, std::string>, std::size_t> counted_;
};

}  // namespace nearmiss

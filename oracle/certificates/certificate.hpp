// Certificates: proofs of the oracle's answers about a query. A short program checks them with fractions.
// tools/certificates/README.md describes their form.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ccd/query/query.hpp"
#include "oracle/earliest_time.hpp"

namespace nearmiss {

/// The part [from, to] of the step that a certificate is about, with 0 <= from <= to <= 1.
struct Span {
  double from = 0;
  double to = 1;
  bool is_open = false;  ///< whether `to` itself is excluded
};

/// A proof that the distance is always above the query's separation h in a part of the step. If `is_strict`
/// is false, the proof may show only that the distance is never below h > 0. Returns nothing if the statement
/// is wrong, or if no proof is found. If `is_known` is true, the caller knows that the distance is above h in
/// the span. Then the function does not decide the query again.
std::optional<std::string> certify_apart(const Query& query, const Span& span, bool is_strict = true,
                                         bool is_known = false);

/// A proof that the distance is at most the query's separation h at some time in a part of the step. If
/// `is_strict` is true, the proof shows that the distance is below h > 0 at that time. If the span is open,
/// the interval in the certificate ends before the span's `to`: at the next smaller double if possible,
/// otherwise at a fraction. Returns nothing if the statement is wrong, or if no proof is found. `known` has
/// the times that a decision of the query has found.
std::optional<std::string> certify_meets(const Query& query, const Span& span, bool is_strict = false,
                                         const KnownTimes& known = {});

/// The certificate of decide(query). If the smallest distance is exactly h > 0, the certificate proves that
/// the distance is at most h. The result is nothing if no proof is found.
std::optional<std::string> certify(const Query& query);

/// The certificates of several statements. A statement without a proof has no value.
using Certificates = std::vector<std::optional<std::string>>;

/// Proofs of the narrowest enclosure [lo, hi] of the earliest time. The first certificate proves that the
/// distance is above h in [0, lo); there is none if lo is 0. The next one proves that the distance is at most
/// h at some time in [lo, hi]. If the distance is always above h, there is only one certificate, which proves
/// this.
Certificates certify_time(const Query& query);

/// Proofs of the enclosure [lo, hi] that minimum_distance(query) gives. One certificate proves that the
/// smallest distance is at least lo; there is none if lo is 0. The other one proves that it is at most hi;
/// there is none if hi is infinite. If the distance equals lo or hi only at irrational times, there may be no
/// proof of this bound. Then the proof has the next smaller double in place of lo, or the next larger double
/// in place of hi.
Certificates certify_distance(const Query& query);

}  // namespace nearmiss

// The oracle's answers about one query.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ccd/query/query.hpp"
#include "oracle/agreement/answers.hpp"
#include "oracle/oracle.hpp"
#include "reports/statistics/query_class.hpp"

namespace nearmiss {

/// The constructor gets or computes the oracle's decision; each further answer is computed at most once. The
/// query must outlive this object.
class Truth {
 public:
  explicit Truth(const Query& query);
  Truth(const Query& query, const Decision& decision) : query_(query), decision_(decision) {}

  [[nodiscard]] const Query& query() const { return query_; }
  [[nodiscard]] const Decision& decision() const { return decision_; }
  [[nodiscard]] bool collision() const { return decision_.collision; }

  [[nodiscard]] Answers ask_methods() const;

  /// Whether there is a time t*, the earliest time at which the distance is at most the separation. There is
  /// one if the query is a collision or a tie.
  [[nodiscard]] bool has_time() const { return decision_.collision || decision_.is_tie; }

  /// Returns the signature of a disagreement, or "" if the methods agree. They disagree if `answers` differ
  /// from the decision, or if there is no proof of a tie or of an earliest time.
  [[nodiscard]] std::string disagreement(const Answers& answers) const;

  /// Whether the smallest distance is exactly the separation h > 0. Then both answers, collision and no
  /// collision, are right.
  [[nodiscard]] bool is_tie() const { return decision_.is_tie; }

  /// The signature of the first contact.
  const std::string& contact();

  QueryClass query_class();

  /// The earliest time at which the distance is at most h. The query must be a collision or a tie.
  EarliestTime& time();
  /// The largest speed of a vertex of one primitive relative to a vertex of the other primitive, divided by
  /// B, the size of the pair (pair_bound). The result is rounded.
  [[nodiscard]] double relative_speed() const;

  /// The smallest distance of the primitives in a false positive, minus the separation, divided by a unit of
  /// length.
  struct Distance {
    double ratio;  ///< an upper bound of the quotient; it is in the same bin of a Histogram as the quotient
    bool exceeds;  ///< whether the quotient is above 1; this is decided exactly
  };
  Distance distance(double unit);
  /// Returns Distance::exceeds for this unit, without computing the ratio.
  [[nodiscard]] bool exceeds(double unit) const;

  /// Returns Distance::ratio for this unit with a relative accuracy of 1/1000. `ratio` must be the ratio that
  /// distance(unit) returned. If `ratio` is in the first bin of a Histogram, returns `ratio` unchanged.
  [[nodiscard]] double precise_ratio(double unit, double ratio) const;

 private:
  [[nodiscard]] Distance measured_distance(double unit) const;

  const Query& query_;
  Decision decision_;
  std::string contact_;
  std::optional<EarliestTime> time_;
  std::optional<QueryClass> query_class_;
  std::vector<std::pair<double, Distance>> distances_;  // computed distances by unit
};

}  // namespace nearmiss

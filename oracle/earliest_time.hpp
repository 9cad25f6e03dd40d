// The time at which two primitives first share a point, or first come within the separation of each other.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "ccd/query/query.hpp"
#include "oracle/arithmetic/enclosure.hpp"
#include "oracle/within_separation.hpp"

namespace nearmiss {

namespace exact {
struct FirstApproach;
}

/// Results of a decision, with which the search for the earliest time can start.
struct KnownTimes {
  std::optional<KnownApproach> approach;  ///< for h > 0: the facts that certified bounds prove
  std::shared_ptr<const exact::FirstApproach>
      exactly;  ///< the first approach, if exact arithmetic found it; for h = 0, the first contact
};

/// The time t* in [0, 1] at which the distance of the primitives is first at most h, the separation. For h =
/// 0, the primitives first share a point at t*. Arithmetic with certified bounds encloses t* first; exact
/// arithmetic is used only for a question that this enclosure does not answer.
class EarliestTime {
 public:
  /// The distance must be at most h at some time in [0, 1].
  explicit EarliestTime(const Query& query) : EarliestTime(query, KnownTimes{}) {}
  /// Starts from `known`, the results of a decision of the query. These results save time, but change no
  /// answer.
  EarliestTime(const Query& query, const KnownTimes& known);

  /// The enclosure of t* by certified bounds in double.
  [[nodiscard]] const Enclosure& known() const { return rough_.time; }

  /// Whether t* < time. The answer is exact.
  [[nodiscard]] bool is_before(double time);

  /// Whether a subject that reports `time` is late. For h = 0, this means that t* < time. For h > 0, it means
  /// that the distance is below h at some time before `time`. A distance of exactly h does not count, because
  /// a subject is free to report it or not. The answer is exact.
  [[nodiscard]] bool makes_late(double time);

  /// An enclosure of t* that is at most `width` wide, or as narrow as doubles allow. Both ends are t* if t*
  /// is a double and `width` is 0. The enclosure depends only on the query and the width.
  Enclosure enclosure(double width = 0);

  /// t* as a rational number, "p/q" or "p" in lowest terms; "" if it is irrational.
  [[nodiscard]] std::string rational();

 private:
  /// The narrowest enclosure that certified bounds give.
  const KnownTime& narrow();
  const exact::FirstApproach& exact();

  Query query_;
  KnownTime rough_;
  bool is_certified_ =
      true;  ///< whether certified bounds enclose t*, and show that the distance falls below h > 0
  std::optional<KnownTime> narrow_;  ///< computed on first use, like `exact_`
  std::shared_ptr<const exact::FirstApproach> exact_;
};

}  // namespace nearmiss

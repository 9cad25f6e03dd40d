// The search for the first time at which the distance is below a bound, in double, for the many queries that are easy.
#pragma once

#include <array>
#include <cstddef>

#include "oracle/distance/approach.hpp"
#include "oracle/distance/closest.hpp"
#include "oracle/distance/separation.hpp"

namespace nearmiss::certified {

/// Looks at a few times of the step in double. It keeps the parts of the step that no certified bound covers, and looks into the
/// first of them until nothing is left or the distance is below `low` at some time. It gives up early, because DistanceSearch
/// decides what remains.
class QuickSearch {
 public:
  /// As for first_time_below().
  QuickSearch(const VertexDifferences& differences, double low, double required)
      : differences_(differences), low_(low), required_(required) {}

  /// Whether the distance falls below `low`. If it does, the time contains the first such time. Neither `never` nor `comes` is
  /// set if the search gives up.
  FirstTime decide();

  /// Encloses the first time in at most `width`, from what decide() found; gives it back if the search gives up.
  FirstTime narrow(const FirstTime& known, double width);

 private:
  /// An open part of the step that no certified bound covers, and the time to look at next.
  struct Gap {
    double lo, hi, guess;
  };
  static constexpr std::size_t most_gaps = 8;
  static constexpr int most_times = 16;

  /// Looks at a time in the first gap, which is replaced by what the bounds around this time leave of it. False if the search must
  /// give up.
  bool look_into_first_gap();
  /// Estimates when the distance falls below `low_` in a gap at whose end it is below.
  [[nodiscard]] double crossing_in(const Gap& gap) const;
  [[nodiscard]] bool is_low(double t) const;

  bool push(double lo, double hi, double guess);

  const VertexDifferences& differences_;
  double low_, required_;
  std::array<Gap, most_gaps> gaps_{};  ///< the first one is the last in this list
  std::size_t gap_count_ = 0;
  bool comes_ = false;
  double low_time_ = 1;  ///< if it comes, a time at which the distance certainly is below `low_`
};

}  // namespace nearmiss::certified

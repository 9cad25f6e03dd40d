// A fast search for the first time at which the distance is below a bound. For most queries, a few times in
// double suffice.
#pragma once

#include <array>
#include <cstddef>

#include "oracle/distance/approach.hpp"
#include "oracle/distance/closest.hpp"

namespace nearmiss::certified {

/// Because of rounding, the end of a covered range, t + a or t - a, is moved towards t by this number. If
/// this end is in [0, 1], the roundings of the sum and of this correction are at most 2^-54 each. If t + a is
/// above 1 or t - a is below 0, the range reaches the end or the beginning of the step, and rounding does not
/// matter.
inline constexpr double time_rounding = 0x1p-53;

/// Looks at a few times of the step in double. The search keeps a list of gaps, the parts of the step that no
/// certified bound covers. It looks into the first gap again and again until no gap is left, or the distance
/// is below `low` at some time. The search gives up early, because DistanceSearch decides the queries that
/// remain.
class QuickSearch {
 public:
  /// `low` and `required` are as for first_time_below() (approach.hpp).
  QuickSearch(const VertexDifferences& differences, double low, double required)
      : differences_(differences), low_(low), required_(required) {}

  /// Whether the distance falls below `low`. If it does, the enclosure contains the first time at which the
  /// distance is below `low`, and the distance is at least `required` before the enclosure. If the search
  /// gives up, neither `never` nor `comes` is set.
  FirstTime decide();

  /// Narrows the enclosure in `known` to at most `width`. `known` must be a result of decide() or
  /// first_time_below(). If the search gives up, the enclosure remains as it is.
  FirstTime narrow(const FirstTime& known, double width);

 private:
  /// A part (lo, hi) of the step that no bound covers, and the time in it at which the search looks next.
  struct Gap {
    double lo, hi, guess;
  };
  struct Crossing {
    double time;
    ClosestFeatures features;  ///< the features of the closest points around that time
  };
  static constexpr std::size_t most_gaps = 8;
  static constexpr int most_times = 24;

  void start(const Gap& gap);
  /// Adds a gap before all others. The search will look at `nearest` if that time is in the gap, else at
  /// `guess`. Returns false if there are too many gaps.
  bool add(double lo, double hi, double nearest, double guess);
  [[nodiscard]] const Gap& first_gap() const { return gaps_[count_ - 1]; }

  /// Looks at a time in the first gap. If the distance is below `low` at this time, the gap is cut off at the
  /// time, and the later gaps are dropped. Otherwise, the parts of the gap that the bounds around this time
  /// do not cover replace the gap. Returns false if the bounds cover nothing, or leave too many gaps.
  bool look_into_first_gap();
  /// Requires that the distance is below `low` at the end of the first gap. Estimates when the distance falls
  /// below `low`. If the distance is certainly below `low` just after that time, moves the end of the gap
  /// there. Then chooses the next time to look at.
  void look_for_crossing();
  /// Estimates the time in the first gap at which the distance falls below `low`; 0 if the distance may be
  /// below `low` from the beginning of the step.
  [[nodiscard]] Crossing crossing() const;

  const VertexDifferences& differences_;
  double low_, required_;
  std::array<Gap, most_gaps> gaps_{};  ///< the gaps, from the last in the step to the first
  std::size_t count_ = 0;
  bool comes_ = false;
  double width_ = 0;     ///< for narrow(): the width that the enclosure may have
  double low_time_ = 1;  ///< if `comes_`, a time at which the distance is certainly below `low`
};

}  // namespace nearmiss::certified

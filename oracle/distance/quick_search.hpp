// A fast search for the first time at which the distance is below a bound. Most queries need only a few
// times, looked at in double.
#pragma once

#include <array>
#include <cstddef>

#include "oracle/distance/approach.hpp"
#include "oracle/distance/closest.hpp"

namespace nearmiss::certified {

/// How far the end of a covered range, t + a or t - a, is moved inward, because its computation rounds. Ends
/// are in [0, 1], where the two roundings, of the sum and of this correction, are at most 2^-54 each. A sum
/// above 1 covers the step up to its end, and a difference below 0 covers it from its beginning.
inline constexpr double time_rounding = 0x1p-53;

/// Looks at a few times of the step in double. It keeps a list of gaps, which are the parts of the step that
/// no certified bound covers, and looks into the first gap until none is left or the distance is below `low`
/// at some time. It gives up early, because DistanceSearch decides what remains.
class QuickSearch {
 public:
  /// `low` and `required` are as for first_time_below() (approach.hpp).
  QuickSearch(const VertexDifferences& differences, double low, double required)
      : differences_(differences), low_(low), required_(required) {}

  /// Whether the distance falls below `low`. If so, the enclosure contains the first such time, and the
  /// distance is at least `required` before it. If the search gives up, neither `never` nor `comes` is set.
  FirstTime decide();

  /// Narrows the enclosure in `known`, a result of decide() or first_time_below(), to at most `width`. If the
  /// search gives up, the enclosure remains as it is.
  FirstTime narrow(const FirstTime& known, double width);

 private:
  /// The open interval (lo, hi), in which the search looks at `guess` next.
  struct Gap {
    double lo, hi, guess;
  };
  struct Crossing {
    double time;
    ClosestFeatures features;  ///< the features of the closest points around that time
  };
  static constexpr std::size_t most_gaps = 8;
  static constexpr int most_times = 24;

  /// Starts with one gap.
  void start(const Gap& gap);
  /// Adds a gap before all others. The search looks at `nearest` if that time is inside, else at `guess`.
  /// False if there are too many gaps.
  bool add(double lo, double hi, double nearest, double guess);
  [[nodiscard]] const Gap& first_gap() const { return gaps_[count_ - 1]; }

  /// Looks at a time in the first gap. If the distance is below `low` at this time, the gap ends there, and
  /// the later gaps are dropped. Otherwise, the parts of the gap that the bounds around this time do not
  /// cover replace the gap. Returns false if the bounds cover nothing, or leave too many gaps.
  bool look_into_first_gap();
  /// Requires that the distance is below `low` at the end of the first gap. Estimates when the distance falls
  /// below `low`. Moves the end to just after that time if the distance is certainly below `low` there. Then
  /// chooses the next time to look at.
  void look_for_crossing();
  /// Estimates the time in the first gap at which the distance falls below `low`, given that it is below
  /// `low` at the end of the gap; 0 if it may be below `low` from the beginning.
  [[nodiscard]] Crossing crossing() const;

  const VertexDifferences& differences_;
  double low_, required_;
  std::array<Gap, most_gaps> gaps_{};  ///< from the last to the first
  std::size_t count_ = 0;
  bool comes_ = false;
  double width_ = 0;     ///< for narrow()
  double low_time_ = 1;  ///< with `comes_`, a time at which the distance is certainly below `low`
};

}  // namespace nearmiss::certified

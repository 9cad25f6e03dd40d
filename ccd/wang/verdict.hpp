// The answer of a CCD to one query.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

namespace nearmiss {

/// Which test accepted a pair.
enum class Stage : std::uint8_t {
  none,         ///< no collision was reported
  proximity,    ///< area, height and barycentric tests of VT or EE; in advance.hpp, the test of the distance
  ve_end,       ///< VE, KKT case 1: t = 0 or t = 1
  ve_minimum,   ///< VE, KKT case 2: minimum of one quadratic piece
  ve_equal,     ///< VE, KKT case 3: two components of the edge have the same magnitude
  ve_zero,      ///< VE, KKT case 4: a component of the cross product vanishes
  vv,           ///< VV (KKT case 5)
  filter,       ///< certified arithmetic in double
  exact,        ///< exact arithmetic
  unspecified,  ///< the subject does not say which test accepted the pair; no plug-in says it
  unknown,      ///< no test: the subject cannot decide the pair, which then counts as a collision
};

inline constexpr std::size_t stage_count = 11;

/// Names of the stages, in order, as used in files and reports.
inline constexpr std::array<std::string_view, stage_count> stage_names{
    "none", "proximity", "ve-end", "ve-minimum",  "ve-equal", "ve-zero",
    "vv",   "filter",    "exact",  "unspecified", "unknown"};

/// Why a pair was not reported.
enum class Rejection : std::uint8_t {
  untold,   ///< a collision was reported, or the subject does not say
  planes,   ///< plane culling
  apart,    ///< the vectors are too large for a pair that collides (§4.1)
  no_root,  ///< the cubic has no root in [0, 1]
  culled,   ///< VE culling (§5): VE tests were not needed
  tests,    ///< all tests of the algorithm failed
  filter,   ///< certified arithmetic in double
  finer,    ///< the algorithm with a scalar of more bits
  exact,    ///< exact arithmetic
};

inline constexpr std::size_t rejection_count = 9;

/// Names of the rejections, in order, as used in files and reports.
inline constexpr std::array<std::string_view, rejection_count> rejection_names{
    "untold", "planes", "apart", "no-root", "culled", "tests", "filter", "finer", "exact"};

/// Why a subject gave no answer. In the comments below, "it" is the subject.
enum class Fault : std::uint8_t {
  none,
  error,         ///< it reported an error, or a bound that is not a distance
  crash,         ///< its process ended
  time,          ///< it exceeded its time limit
  memory,        ///< it exceeded its memory limit
  exception,     ///< it threw an exception that it did not catch
  protocol,      ///< it wrote to nearmiss's channels, or closed them
  not_asked,     ///< it does not decide this kind, or was dropped for exceeding its time limit too often
  invalid,       ///< it gave an unknown answer, or a collision without the time that it promises
  load,          ///< it could not be loaded again after it had failed
  contract,      ///< it was not asked, because the query breaks its contract
  inconsistent,  ///< it gave another answer when it was asked again among other queries
};

inline constexpr std::size_t fault_count = 12;

/// Names of the faults, in order, as used in files and reports.
inline constexpr std::array<std::string_view, fault_count> fault_names{
    "none",     "error",     "crash",   "time", "memory",   "exception",
    "protocol", "not-asked", "invalid", "load", "contract", "inconsistent"};

/// A subject's answer to one query.
struct Verdict {
  bool hit = false;
  Stage stage = Stage::none;
  /// In [0, 1] for a hit; NaN if unknown. If the answer is invalid, the time as the subject gave it.
  double time = std::numeric_limits<double>::quiet_NaN();
  Fault fault = Fault::none;  ///< if not `none`, there is no answer
  Rejection rejection = Rejection::untold;
  /// For an error or an invalid answer, the return value; for a crash, the signal or the negated exit code;
  /// for an exception or a failure to load, a number that Subject::fault_text turns into a message.
  std::int32_t fault_code = 0;

  static Verdict accepted(Stage stage, double time) { return {.hit = true, .stage = stage, .time = time}; }
  static Verdict rejected(Rejection rejection) { return {.rejection = rejection}; }
};

}  // namespace nearmiss

// The answer of a CCD to one query.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

namespace nearmiss {

/// The test that accepted a pair.
enum class Stage : std::uint8_t {
  none,         ///< no collision was reported
  proximity,    ///< the area, height and barycentric tests; in advance.hpp, the test of the distance
  ve_end,       ///< Algorithm 2 (VE), KKT case 1: t = 0 or t = 1
  ve_minimum,   ///< VE, KKT case 2: the minimum of a quadratic piece
  ve_equal,     ///< VE, KKT case 3: two components of the edge have the same magnitude
  ve_zero,      ///< VE, KKT case 4: a component of the cross product is 0
  vv,           ///< Algorithm 1 (VV), KKT case 5 of VE
  filter,       ///< certified arithmetic in double
  exact,        ///< exact arithmetic
  unspecified,  ///< the subject does not say which test accepted the pair (plug-ins never say)
  unknown,      ///< no test: the subject cannot decide the pair, which then counts as a collision
};

inline constexpr std::size_t stage_count = 11;

/// The names of the stages in files and reports.
inline constexpr std::array<std::string_view, stage_count> stage_names{
    "none", "proximity", "ve-end", "ve-minimum",  "ve-equal", "ve-zero",
    "vv",   "filter",    "exact",  "unspecified", "unknown"};

/// Why a subject did not report a pair: what ruled a collision out.
enum class Rejection : std::uint8_t {
  untold,   ///< a collision was reported, or the subject does not say why none was reported
  planes,   ///< plane culling
  apart,    ///< the relative vectors are too large for a pair that collides (§4.1)
  no_root,  ///< the cubic has no root in [0, 1]
  culled,   ///< VE culling (§5): the vertex-edge tests were not needed
  tests,    ///< no test of the algorithm accepted the pair
  filter,   ///< certified arithmetic in double
  finer,    ///< the algorithm with a scalar of more bits
  exact,    ///< exact arithmetic
};

inline constexpr std::size_t rejection_count = 9;

/// The names of the rejections in files and reports.
inline constexpr std::array<std::string_view, rejection_count> rejection_names{
    "untold", "planes", "apart", "no-root", "culled", "tests", "filter", "finer", "exact"};

/// Why a subject gave no answer. In the comments of the faults, "it" is the subject.
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
  inconsistent,  ///< it gave another answer when it was asked the query again, among other queries
};

inline constexpr std::size_t fault_count = 12;

/// The names of the faults in files and reports.
inline constexpr std::array<std::string_view, fault_count> fault_names{
    "none",     "error",     "crash",   "time", "memory",   "exception",
    "protocol", "not-asked", "invalid", "load", "contract", "inconsistent"};

struct Verdict {
  bool hit = false;
  Stage stage = Stage::none;
  /// The time of impact: in [0, 1] if the verdict is a hit, NaN if the time is unknown. If the answer is
  /// invalid, this is the time that the subject gave, whatever its value.
  double time = std::numeric_limits<double>::quiet_NaN();
  Fault fault = Fault::none;  ///< if not `none`, there is no answer
  Rejection rejection = Rejection::untold;
  /// For an error or an invalid answer, the number that the subject answered. For a crash, the signal or the
  /// negated exit code. For an exception or a failure to load, a number from which Subject::fault_text()
  /// finds the message.
  std::int32_t fault_code = 0;

  static Verdict accepted(Stage stage, double time) { return {.hit = true, .stage = stage, .time = time}; }
  static Verdict rejected(Rejection rejection) { return {.rejection = rejection}; }
};

}  // namespace nearmiss

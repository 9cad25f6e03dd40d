// The interface of all CCDs on trial.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ccd/query/query.hpp"
#include "ccd/wang/verdict.hpp"

namespace nearmiss {

/// The meaning of the time that a subject gives for a collision, relative to t*, the earliest time at which
/// the distance is at most h.
enum class TimeSort : std::uint8_t {
  none,         ///< nothing
  estimate,     ///< the time is near t*
  lower_bound,  ///< the time is not after t*
  free_step,    ///< a lower bound; also, the step to the rounded positions at this time has no collision
};

/// The names of the sorts of times in reports.
inline constexpr std::array<std::string_view, 4> time_sort_names{"none", "estimate", "lower-bound",
                                                                 "free-step"};

constexpr std::string_view name(TimeSort sort) { return time_sort_names[static_cast<std::size_t>(sort)]; }

/// Whether times of this sort are not after t*.
constexpr bool is_lower_bound(TimeSort sort) { return sort >= TimeSort::lower_bound; }

/// The assumptions that a subject makes about its queries. The subject is not judged on queries that violate
/// an assumption. A field that is 0 or false makes no assumption.
struct Contract {
  bool apart_at_start = false;  ///< the distance of the primitives at t = 0 exceeds `apart_by` and h
  /// The volume that the vertices span, as a function of time, has at most one root in [0, 1], and this root
  /// is simple.
  bool one_root = false;
  double apart_by = 0;  ///< used with apart_at_start
  double grid = 0;      ///< a power of two of which every coordinate is a multiple
  double shortest = 0;  ///< all edges, at t = 0 and t = 1, are at least this long
  double longest = 0;   ///< all edges, and the paths of all vertices, are at most this long

  bool operator==(const Contract&) const = default;
};

/// A subject's answer when it is asked for its distance bound.
struct BoundAnswer {
  double bound = std::numeric_limits<double>::quiet_NaN();  ///< the number that the subject gives
  Fault fault = Fault::none;                                ///< if not `none`, there is no bound
  std::int32_t fault_code = 0;                              ///< as in Verdict

  /// The answer that gives `bound`. If the bound is negative or NaN, the answer has the fault `error`.
  static BoundAnswer given(double bound) { return {bound, bound >= 0 ? Fault::none : Fault::error}; }

  /// The bound, or NaN if a fault left the answer without a bound.
  [[nodiscard]] double bound_or_nan() const {
    return fault == Fault::none ? bound : std::numeric_limits<double>::quiet_NaN();
  }
};

/// A subject's answer when it is asked for the distance of two primitives.
struct DistanceAnswer {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  double distance = none;
  /// For each vertex, its weight in the closest point of its primitive. The weights of each primitive add up
  /// to 1. All weights are NaN if the subject gives no weights.
  std::array<double, 4> weights{none, none, none, none};
  Fault fault = Fault::none;    ///< if not `none`, there is no distance
  std::int32_t fault_code = 0;  ///< as in Verdict

  /// The answer that gives `distance` and `weights`. If the distance is negative or not finite, the answer
  /// has the fault `invalid`.
  static DistanceAnswer given(double distance, const std::array<double, 4>& weights) {
    const bool is_distance = distance >= 0 && distance <= std::numeric_limits<double>::max();
    return {distance, weights, is_distance ? Fault::none : Fault::invalid};
  }
};

/// A subject's answer when it is asked to filter a step.
struct StepAnswer {
  std::array<double, 12> y{};  ///< the positions to which the vertices may move: x, y, z of each vertex
  /// The subject claims that the distance of the primitives never falls below this length.
  double clearance = std::numeric_limits<double>::quiet_NaN();
  Fault fault = Fault::none;    ///< if not `none`, there is no answer
  std::int32_t fault_code = 0;  ///< as in Verdict

  /// The answer that gives the positions `y` of `vertices` vertices, and `clearance`. If a number is not
  /// finite, or the clearance is negative, the answer has the fault `invalid`.
  static StepAnswer given(const std::array<double, 12>& y, double clearance, int vertices) {
    constexpr double most = std::numeric_limits<double>::max();
    bool is_finite = clearance >= 0 && clearance <= most;
    for (int i = 0; i < 3 * vertices; ++i) {
      const double c = y[static_cast<std::size_t>(i)];
      is_finite = is_finite && c >= -most && c <= most;
    }
    return {y, clearance, is_finite ? Fault::none : Fault::invalid};
  }
};

/// The time that a subject takes to decide a batch, measured by a Stopwatch in the thread or process that
/// decides. The time that an empty subject takes for the same queries is subtracted.
struct BatchTime {
  std::size_t queries = 0;  ///< the timed queries; queries of a part in which a process failed do not count
  std::uint64_t nanoseconds = 0;
  /// The time without the copies to and from a device; 0 if the subject does not give this time.
  std::uint64_t kernel_nanoseconds = 0;
};

/// A CCD on trial: a pure function of the query. The built-in subjects compute in plain arithmetic
/// (arithmetic.hpp), whatever the caller's mode.
class Subject {
 public:
  Subject() = default;
  Subject(const Subject&) = delete;
  Subject& operator=(const Subject&) = delete;
  virtual ~Subject() = default;

  /// The name of the subject in reports. A plug-in has the name that its detector gives itself.
  [[nodiscard]] virtual const std::string& name() const = 0;

  /// Throws Error if a coordinate is not finite.
  [[nodiscard]] virtual Verdict decide(const Query& query) const = 0;

  /// verdicts[i] = decide(queries[i]); both spans have the same length.
  virtual void decide(std::span<const Query> queries, std::span<Verdict> verdicts) const {
    for (std::size_t i = 0; i < queries.size(); ++i) verdicts[i] = decide(queries[i]);
  }

  /// Decides the queries as decide() does, and returns how long the decisions took.
  virtual BatchTime decide_timed(std::span<const Query> queries, std::span<Verdict> verdicts) const;

  /// Measures how long the subject takes to decide each query on its own. Writes the shortest time of three
  /// tries, in ns, or nothing if the subject does not answer the query.
  virtual void time_each(std::span<const Query> queries,
                         std::span<std::optional<std::uint64_t>> nanoseconds) const;

  /// The distance bound that the subject claims: if the subject reports the query falsely, the smallest
  /// distance exceeds the separation by at most this length, in the query's unit. The result is infinity if
  /// the subject claims no bound, or a bound above the largest double, and NaN if the subject fails to
  /// answer.
  [[nodiscard]] virtual double distance_bound(const Query& query) const = 0;

  /// The distance bound that the subject claims, or the fault because of which the subject gave no bound.
  [[nodiscard]] virtual BoundAnswer ask_bound(const Query& query) const {
    return BoundAnswer::given(distance_bound(query));
  }

  virtual void ask_bounds(std::span<const Query> queries, std::span<BoundAnswer> bounds) const {
    for (std::size_t i = 0; i < queries.size(); ++i) bounds[i] = ask_bound(queries[i]);
  }

  [[nodiscard]] virtual bool gives_distance(Kind /*kind*/) const { return false; }

  /// The distance of the primitives at t = 0, for a kind for which the subject gives distances.
  [[nodiscard]] virtual DistanceAnswer ask_distance(const Query& /*query*/) const {
    return {.fault = Fault::not_asked};
  }

  [[nodiscard]] virtual bool filters_step(Kind /*kind*/) const { return false; }

  /// The safe part of the query's step, for a kind for which the subject filters steps.
  [[nodiscard]] virtual StepAnswer ask_step(const Query& /*query*/) const {
    return {.fault = Fault::not_asked};
  }

  /// Whether the subject claims a distance bound. A subject claims a bound for all queries or for no query.
  [[nodiscard]] virtual bool claims_bound() const { return true; }

  /// Whether the subject decides queries of a kind. nearmiss asks a subject only queries of the kinds that it
  /// decides.
  [[nodiscard]] virtual bool decides(Kind kind) const { return is_of_meshes(kind); }

  /// Whether the subject decides queries of a kind with a separation h > 0. If not, nearmiss asks the subject
  /// only for contact.
  [[nodiscard]] virtual bool takes_separation(Kind /*kind*/) const { return false; }

  /// Whether the subject is asked queries of this kind, with a separation h > 0 if `has_separation` is true.
  [[nodiscard]] bool is_asked(Kind kind, bool has_separation) const {
    return decides(kind) && (!has_separation || takes_separation(kind));
  }

  /// The meaning of the time in a verdict that reports a collision.
  [[nodiscard]] virtual TimeSort time_sort() const { return TimeSort::none; }

  [[nodiscard]] virtual Contract contract() const { return {}; }

  /// Whether the subject rounds coordinates to fewer digits than a double has.
  [[nodiscard]] virtual bool rounds() const { return false; }

  /// The query with the coordinates rounded as the subject rounds them. The subject is judged on this query.
  [[nodiscard]] virtual Query rounded(const Query& query) const { return query; }

  /// The message for the fault in a verdict of this subject: what() of an exception, or why the subject could
  /// not be loaded; "" for any other verdict.
  [[nodiscard]] virtual std::string fault_text(const Verdict& /*verdict*/) const { return {}; }

  /// The last lines that the subject's process wrote to standard error before it ended with the verdict's
  /// fault, and the stack of the crash if it is known. "" if nothing is known.
  [[nodiscard]] virtual std::string fault_errors(const Verdict& /*verdict*/) const { return {}; }

  /// D, √δ, √ψ, S and ∛μ are the tolerances that decide whether the subject accepts a pair. Returns the
  /// smallest factor by which these tolerances must be multiplied for the subject to report the query. The
  /// factor is at most 1 if the subject reports the query without this change. The factor shows directed
  /// search how near the query is to the opposite answer. The factor is accurate to a few bits, and is NaN if
  /// the subject does not give it.
  [[nodiscard]] virtual double needed_tolerance(const Query& /*query*/) const {
    return std::numeric_limits<double>::quiet_NaN();
  }

 protected:
  /// A subject that computes nothing. The run time of the empty subject is the overhead of the calls, and is
  /// subtracted from the run time of this subject.
  [[nodiscard]] virtual const Subject& empty() const;
};

struct SubjectInfo {
  std::string_view name;
  std::string_view about;
};

/// The built-in subjects, in the order in which `nearmiss subjects` lists them.
std::vector<SubjectInfo> subjects();

/// The suffix in the name of a subject that uses the bound B of a scene for every pair of the scene.
inline constexpr std::string_view of_scene = "@scene";

/// Makes a built-in subject from its name, or a Plugin from a name with a '/'. NAME may end in options,
/// :KEY=NUMBER. NAME@B gives the subject the bound B; NAME and NAME@scene give it `given_bound`. Both bounds
/// are in the queries' unit of length. The given bound replaces every pair's own bound B (§5 of the paper);
/// subjects that use no bound B ignore the given bound. Throws Error for an unknown name or option, or an
/// unusable plug-in.
std::unique_ptr<Subject> make_subject(std::string_view name_or_path,
                                      std::optional<double> given_bound = std::nullopt);

/// Makes a subject as make_subject() does, but returns null for an unknown name.
std::unique_ptr<Subject> try_make_subject(std::string_view name_or_path, std::optional<double> given_bound);

/// A subject's name without its suffix, and the bound that the suffix gives.
struct SplitName {
  std::string_view name;
  std::optional<double> bound;
};
/// Splits the suffix "@B" or "@scene" off a name. The suffix "@B" gives the bound B. A name with the suffix
/// "@scene", or without a suffix, gives `given_bound`. If there is no `given_bound`, "@scene" stays in the
/// name. The name of a plug-in has no suffix. Throws Error if B is a number that is not positive and finite.
SplitName split_bound(std::string_view name, std::optional<double> given_bound);

/// Throws an Error that says that the subject `name` found a coordinate that is not finite.
[[noreturn, gnu::cold]] void refuse_coordinates(std::string_view name);

/// Throws an Error that says that the name is unknown, or that the subject has no options.
[[noreturn]] void refuse_subject(std::string_view name, std::span<const SubjectInfo> known);

}  // namespace nearmiss

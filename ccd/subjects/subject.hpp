// The interface through which any CCD is put on trial.
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

/// For a collision: what a subject says about t*, the earliest time at which the distance is at most h.
enum class TimeSort : std::uint8_t {
  none,         ///< nothing
  estimate,     ///< a time near t*
  lower_bound,  ///< a time that is not after t*: nothing happens before it
  free_step,    ///< a lower bound; nothing happens on the step to the rounded positions at that time, either
};

/// Names of the sorts of time in reports, in order.
inline constexpr std::array<std::string_view, 4> time_sort_names{"none", "estimate", "lower-bound",
                                                                 "free-step"};

constexpr std::string_view name(TimeSort sort) { return time_sort_names[static_cast<std::size_t>(sort)]; }

/// Whether times of this sort promise that nothing happens before them.
constexpr bool is_lower_bound(TimeSort sort) { return sort >= TimeSort::lower_bound; }

/// A subject's assumptions. It is not judged on queries that violate them. A field that is 0 or false assumes
/// nothing.
struct Contract {
  bool apart_at_start = false;  ///< the distance of the primitives at t = 0 exceeds `apart_by` and h
  bool one_root = false;  ///< the volume that the vertices span has at most one root in [0, 1], a simple one
  double apart_by = 0;    ///< used with apart_at_start
  double grid = 0;        ///< a power of two of which every coordinate is a multiple
  double shortest = 0;    ///< all edges, at t = 0 and t = 1, are at least this long
  double longest = 0;     ///< all these edges, and the paths of the vertices, are at most this long

  bool operator==(const Contract&) const = default;
};

/// A subject's answer when it is asked for its distance bound.
struct BoundAnswer {
  double bound = std::numeric_limits<double>::quiet_NaN();  ///< as the subject gives it
  Fault fault = Fault::none;                                ///< if not `none`, there is no bound
  std::int32_t fault_code = 0;                              ///< as in Verdict

  /// A number that a subject gave as its bound; an error if it is not a distance.
  static BoundAnswer given(double bound) { return {bound, bound >= 0 ? Fault::none : Fault::error}; }

  /// The bound as Subject::distance_bound returns it, or NaN if there is no bound.
  [[nodiscard]] double bound_or_nan() const {
    return fault == Fault::none ? bound : std::numeric_limits<double>::quiet_NaN();
  }
};

/// A subject's answer when it is asked for the distance of two primitives.
struct DistanceAnswer {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  double distance = none;
  /// The weights of the vertices in the closest points. Those of each primitive add up to 1. NaN if the
  /// subject gives none.
  std::array<double, 4> weights{none, none, none, none};
  Fault fault = Fault::none;    ///< if not `none`, there is no distance
  std::int32_t fault_code = 0;  ///< as in Verdict

  /// A number that a subject gave as the distance; a fault if it is not a distance.
  static DistanceAnswer given(double distance, const std::array<double, 4>& weights) {
    const bool is_distance = distance >= 0 && distance <= std::numeric_limits<double>::max();
    return {distance, weights, is_distance ? Fault::none : Fault::invalid};
  }
};

/// A subject's answer when it is asked to filter a step.
struct StepAnswer {
  std::array<double, 12> y{};  ///< the positions to which the vertices may move; x, y, z of each
  double clearance = std::numeric_limits<double>::quiet_NaN();  ///< the clearance that it claims on the way
  Fault fault = Fault::none;                                    ///< if not `none`, there is no answer
  std::int32_t fault_code = 0;                                  ///< as in Verdict

  /// The step that a subject gave for this many vertices; a fault if it is not finite, or the clearance is
  /// negative.
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

/// The time that some answers took, in the deciding thread or in the subject's own process. The time of an
/// empty subject for the same queries is subtracted; waiting for a processor does not count (stopwatch.hpp).
struct BatchTime {
  std::size_t queries = 0;  ///< timed queries; a part of a batch in which a process failed does not count
  std::uint64_t nanoseconds = 0;
  std::uint64_t kernel_nanoseconds =
      0;  ///< the part without copies to a device; 0 if the subject does not say
};

/// A CCD on trial: a pure function of the query. The built-in subjects compute in plain arithmetic
/// (arithmetic.hpp), whatever the caller's mode.
class Subject {
 public:
  Subject() = default;
  Subject(const Subject&) = delete;
  Subject& operator=(const Subject&) = delete;
  virtual ~Subject() = default;

  /// Name on the command line and in reports; for a plug-in, the name that it gives itself.
  [[nodiscard]] virtual const std::string& name() const = 0;

  /// Throws Error if a coordinate is not finite.
  [[nodiscard]] virtual Verdict decide(const Query& query) const = 0;

  /// verdicts[i] = decide(queries[i]); both spans have the same length.
  virtual void decide(std::span<const Query> queries, std::span<Verdict> verdicts) const {
    for (std::size_t i = 0; i < queries.size(); ++i) verdicts[i] = decide(queries[i]);
  }

  /// Decides the queries and measures how long that took.
  virtual BatchTime decide_timed(std::span<const Query> queries, std::span<Verdict> verdicts) const;

  /// The time of each query on its own, in ns: the shortest of three tries, or nothing if there is no answer.
  virtual void time_each(std::span<const Query> queries,
                         std::span<std::optional<std::uint64_t>> nanoseconds) const;

  /// The largest distance of a false positive, less the query's separation, that this subject claims, in the
  /// query's unit of length. It is infinity if the subject claims nothing or more than the largest double,
  /// and NaN if it fails to answer.
  [[nodiscard]] virtual double distance_bound(const Query& query) const = 0;

  /// The distance bound, or why the subject fails to give it.
  [[nodiscard]] virtual BoundAnswer ask_bound(const Query& query) const {
    return BoundAnswer::given(distance_bound(query));
  }

  /// bounds[i] = ask_bound(queries[i]); both spans have the same length.
  virtual void ask_bounds(std::span<const Query> queries, std::span<BoundAnswer> bounds) const {
    for (std::size_t i = 0; i < queries.size(); ++i) bounds[i] = ask_bound(queries[i]);
  }

  /// Whether the subject gives distances of primitives of a kind.
  [[nodiscard]] virtual bool gives_distance(Kind /*kind*/) const { return false; }

  /// The distance of the primitives at t = 0, for a kind for which the subject gives distances.
  [[nodiscard]] virtual DistanceAnswer ask_distance(const Query& /*query*/) const {
    return {.fault = Fault::not_asked};
  }

  /// Whether the subject filters steps of primitives of a kind.
  [[nodiscard]] virtual bool filters_step(Kind /*kind*/) const { return false; }

  /// The part of the query's step that is safe, for a kind for which the subject filters steps.
  [[nodiscard]] virtual StepAnswer ask_step(const Query& /*query*/) const {
    return {.fault = Fault::not_asked};
  }

  /// Whether the subject claims a bound; it does so for all queries or for none.
  [[nodiscard]] virtual bool claims_bound() const { return true; }

  /// Whether the subject decides queries of a kind. It is not asked about other kinds.
  [[nodiscard]] virtual bool decides(Kind kind) const { return is_of_meshes(kind); }

  /// Whether the subject answers queries of a kind with a separation h > 0. If not, it is not asked about
  /// them.
  [[nodiscard]] virtual bool takes_separation(Kind /*kind*/) const { return false; }

  /// Whether the subject is asked queries of a kind, with or without separations h > 0.
  [[nodiscard]] bool is_asked(Kind kind, bool has_separation) const {
    return decides(kind) && (!has_separation || takes_separation(kind));
  }

  /// What the time of a verdict means, for collisions.
  [[nodiscard]] virtual TimeSort time_sort() const { return TimeSort::none; }

  /// The subject's assumptions.
  [[nodiscard]] virtual Contract contract() const { return {}; }

  /// Whether the subject rounds coordinates to fewer digits than those of double.
  [[nodiscard]] virtual bool rounds() const { return false; }

  /// The query that the subject decides and is judged on; its coordinates are rounded if the subject rounds.
  [[nodiscard]] virtual Query rounded(const Query& query) const { return query; }

  /// The message behind a fault in one of this subject's verdicts: what an exception said, or why the subject
  /// could not be loaded; "" for any other verdict.
  [[nodiscard]] virtual std::string fault_text(const Verdict& /*verdict*/) const { return {}; }

  /// The last lines that the subject's process wrote to standard error before it last ended with such a
  /// fault, and the stack of the crash if that is known. "" if nothing is known.
  [[nodiscard]] virtual std::string fault_errors(const Verdict& /*verdict*/) const { return {}; }

  /// How near the query is to the other answer. All accepting tolerances, taken as lengths (D, ψ^½, S, μ^⅓),
  /// must be multiplied by this factor so that the subject just reports the query. The factor is at most 1 if
  /// the subject reports the query, and larger otherwise. It guides directed search, is accurate to a few
  /// bits, and is NaN if the subject does not say.
  [[nodiscard]] virtual double needed_tolerance(const Query& /*query*/) const {
    return std::numeric_limits<double>::quiet_NaN();
  }

 protected:
  /// A subject that decides nothing, but is asked in the same way as this subject. The time of the empty
  /// subject is subtracted from the time of this one.
  [[nodiscard]] virtual const Subject& empty() const;
};

/// A built-in subject's name and a one-line description.
struct SubjectInfo {
  std::string_view name;
  std::string_view about;
};

/// The built-in subjects, in the order in which `nearmiss subjects` lists them.
std::vector<SubjectInfo> subjects();

/// Suffix of the name of a subject that uses the scene's bound for every pair.
inline constexpr std::string_view of_scene = "@scene";

/// Makes a built-in subject from its name, or a plug-in from its path (any name with a '/'). A bound may be
/// given as NAME@B, or as `given_bound` for NAME and NAME@scene, in the queries' unit of length. It replaces
/// every pair's own bound B (§5 of the paper: per scene, or given by the user); subjects without B ignore it.
/// NAME may end in options, :KEY=NUMBER. Throws Error for an unknown name or option or an unusable plug-in.
std::unique_ptr<Subject> make_subject(std::string_view name_or_path,
                                      std::optional<double> given_bound = std::nullopt);

/// As make_subject, but returns nothing for an unknown name.
std::unique_ptr<Subject> try_make_subject(std::string_view name_or_path, std::optional<double> given_bound);

/// A name without its suffix "@B" or "@scene", and the bound that the suffix gives. If there is no suffix,
/// the bound is `given_bound`. The path of a plug-in never has a suffix. Throws Error if B is a number that
/// is not positive and finite.
struct SplitName {
  std::string_view name;
  std::optional<double> bound;
};
SplitName split_bound(std::string_view name, std::optional<double> given_bound);

/// Throws an Error: the subject `name` found a coordinate that is not finite.
[[noreturn, gnu::cold]] void refuse_coordinates(std::string_view name);

/// Throws an Error that lists the known names.
[[noreturn]] void refuse_subject(std::string_view name, std::span<const SubjectInfo> known);

}  // namespace nearmiss

#include "fuzz/subjects/defects.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "ccd/advance.hpp"
#include "ccd/error.hpp"
#include "ccd/excerpt.hpp"
#include "ccd/wang.hpp"
#include "ccd/wang_time.hpp"
#include "corpus/query_text.hpp"

namespace nearmiss {

namespace {

constexpr std::string_view prefix = "defect:";

template <class T>
constexpr std::array tolerance_members{&Tolerances<T>::delta, &Tolerances<T>::D2,      &Tolerances<T>::rho,
                                       &Tolerances<T>::psi,   &Tolerances<T>::lambda2, &Tolerances<T>::S,
                                       &Tolerances<T>::mu,    &Tolerances<T>::tau,     &Tolerances<T>::eta};

constexpr std::array tolerance_table{
    NamedTolerance{"delta", &Tolerances<double>::delta, 2, true},
    NamedTolerance{"D2", &Tolerances<double>::D2, 2, true},
    NamedTolerance{"rho", &Tolerances<double>::rho, 2, false},
    NamedTolerance{"psi", &Tolerances<double>::psi, 2, true},
    NamedTolerance{"lambda2", &Tolerances<double>::lambda2, 2, false},
    NamedTolerance{"S", &Tolerances<double>::S, 1, true},
    NamedTolerance{"mu", &Tolerances<double>::mu, 3, true},
    NamedTolerance{"tau", &Tolerances<double>::tau, 2, false},
    NamedTolerance{"eta", &Tolerances<double>::eta, 1, false},
};

constexpr std::uint64_t bit_of(Step step) { return std::uint64_t{1} << static_cast<unsigned>(step); }

/// Steps with some left out, and with multiples of the paper's tolerances for double.
struct DefectiveSteps {
  std::uint64_t left_out = 0;  ///< one bit for each step
  Tolerances<double> factors{1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
  const NamedTolerance* changed = nullptr;  ///< the tolerance that the defect changes, if any

  /// The same steps with the changed tolerance loosened by s. If none is changed, all accepting tolerances
  /// are loosened, as lengths.
  [[nodiscard]] DefectiveSteps loosened(double s) const {
    DefectiveSteps steps = *this;
    if (changed != nullptr) {
      steps.factors.*changed->value *= changed->accepts ? s : 1 / s;
    } else {
      for (const NamedTolerance& each : tolerance_table)
        if (each.accepts) steps.factors.*each.value *= std::pow(s, each.dimension);
    }
    return steps;
  }

  [[nodiscard]] bool does(Step step) const { return (left_out & bit_of(step)) == 0; }

  template <class T>
  [[nodiscard]] Tolerances<T> tolerances(T B) const {
    const auto paper = paper_tolerances(static_cast<double>(B));
    Tolerances<T> tol{};
    for (std::size_t i = 0; i < tolerance_table.size(); ++i) {
      const auto member = tolerance_members<double>[i];
      tol.*tolerance_members<T>[i] = static_cast<T>(paper.*member * factors.*member);
    }
    return tol;
  }
};

/// The sound subjects of which defects are made.
enum class Sound : std::uint8_t { wang, wang_time, advance };
constexpr std::array<std::string_view, 3> sound_names{"wang", "wang-time", "advance"};

/// The change that makes a sound subject defective.
struct Change {
  Sound sound = Sound::wang;
  DefectiveSteps steps = {};
  bool in_float = false;  ///< of wang-time, the time alone
};

template <Kind kind>
Verdict decide_by(const Change& change, const Query& query, const DefectiveSteps& steps) {
  if (change.sound == Sound::advance) return advance<kind, double>(query, steps);
  if (change.sound == Sound::wang_time) {
    Verdict verdict = wang_time<kind, double, WangOptions{}>(query, std::nullopt, steps);
    if (verdict.hit && change.in_float) verdict.time = detail::contactless_until<kind, float>(query, steps);
    return verdict;
  }
  return change.in_float ? wang<kind, float, WangOptions{}>(query, std::nullopt, steps)
                         : wang<kind, double, WangOptions{}>(query, std::nullopt, steps);
}

class DefectiveSubject final : public Subject {
 public:
  DefectiveSubject(std::string_view name, const Change& change)
      : name_(name),
        change_(change),
        sound_(make_subject(sound_names[static_cast<std::size_t>(change.sound)])) {}

  [[nodiscard]] const std::string& name() const override { return name_; }

  using Subject::decide;
  [[nodiscard]] Verdict decide(const Query& query) const override {
    if (!is_finite(query)) refuse_coordinates(name_);
    return decide(query, change_.steps);
  }

  [[nodiscard]] double distance_bound(const Query& query) const override {
    return sound_->distance_bound(query);
  }
  [[nodiscard]] bool takes_separation() const override { return sound_->takes_separation(); }
  [[nodiscard]] TimeSort time_sort() const override { return sound_->time_sort(); }

  [[nodiscard]] double needed_tolerance(const Query& query) const override {
    if (change_.sound == Sound::advance) return sound_->needed_tolerance(query);
    return least_loosening([&](double s) { return decide(query, change_.steps.loosened(s)).hit; });
  }

 private:
  [[nodiscard]] Verdict decide(const Query& query, const DefectiveSteps& steps) const {
    return query.kind == Kind::vertex_triangle ? decide_by<Kind::vertex_triangle>(change_, query, steps)
                                               : decide_by<Kind::edge_edge>(change_, query, steps);
  }

  std::string name_;
  Change change_;
  std::unique_ptr<Subject> sound_;
};

struct LeftOut {
  std::string_view name, about;
  std::array<Step, 3> steps;  ///< the left-out steps; one is repeated if there are fewer than three
  Sound of = Sound::wang;
};

constexpr LeftOut left_out(std::string_view name, Step step, std::string_view about, Sound of = Sound::wang) {
  return {name, about, {step, step, step}, of};
}

constexpr std::array left_out_table{
    left_out("both-ends", Step::both_ends, "plane culling looks at t = 0 alone"),
    left_out("touching", Step::touching_meets, "plane culling takes touching primitives for separate"),
    left_out("velocity", Step::velocity_in_bound, "B = E, without the velocities"),
    left_out("normalisation", Step::normalisation, "no powers of two against over- and underflow"),
    left_out("overflow", Step::overflow, "a velocity that is not a number goes unseen where B is in range"),
    left_out("reordering", Step::reordering, "edge-edge with the end points in their given order"),
    left_out("closest-pair", Step::closest_pair, "edges whose given first end points are beyond B are apart"),
    left_out("discriminant", Step::clamped_discriminant, "a negative discriminant has no root"),
    left_out("solver", Step::solver, "no root where F is monotone"),
    left_out("clear-of-mu", Step::clear_of_mu, "F of one sign ends it, however near 0 it is"),
    left_out("solver-start", Step::solver_start, "no root at t = 0 by its residual"),
    left_out("solver-end", Step::solver_end, "no root at t = 1 by its residual"),
    left_out("double-roots", Step::double_roots, "no root at a critical point by its residual"),
    left_out("first-interval", Step::first_interval, "the solver skips the first of several intervals"),
    left_out("middle-interval", Step::middle_interval, "the solver skips the middle one of three intervals"),
    left_out("last-interval", Step::last_interval, "the solver skips the last of several intervals"),
    left_out("residual", Step::residual, "the solver stops on |dt| < 2^-20 in place of |F| <= mu"),
    left_out("proximity", Step::proximity, "no area, height and barycentric tests"),
    left_out("proximity-end", Step::proximity_end, "no proximity test at t = 1"),
    left_out("vertex-edge", Step::vertex_edge, "no vertex-edge tests"),
    left_out("last-edge", Step::last_edge, "vertex-edge tests for one pair fewer"),
    left_out("culling-rounding", Step::culling_rounding, "vertex-edge culling without its rounding terms"),
    left_out("culling-spread", Step::culling_spread, "vertex-edge culling as if the root were exact"),
    left_out("culling-bracket", Step::culling_bracket, "vertex-edge culling trusts the slope at the root"),
    left_out("ve-start", Step::ve_start, "vertex-edge without t = 0"),
    left_out("ve-end", Step::ve_end, "vertex-edge without t = 1"),
    left_out("ve-minimum", Step::ve_minimum, "vertex-edge without KKT case 2"),
    left_out("ve-equal", Step::ve_equal, "vertex-edge without KKT case 3"),
    left_out("ve-zero", Step::ve_zero, "vertex-edge without KKT case 4"),
    left_out("vv", Step::vv, "no vertex-vertex tests"),
    left_out("ties", Step::ties, "comparisons that accept are strict"),
    left_out("inside", Step::inside,
             "a root counts wherever the vertex or the edges are in the common plane"),
    LeftOut{"start", "t = 0 is tested nowhere", {Step::solver_start, Step::ve_start, Step::ve_start}},
    LeftOut{"end", "t = 1 is tested nowhere", {Step::solver_end, Step::proximity_end, Step::ve_end}},
    left_out("later-root", Step::earliest_root, "the time of the last root in place of the first",
             Sound::wang_time),
    left_out("upper-end", Step::lower_end, "the upper end of the root's interval", Sound::wang_time),
    left_out("middle", Step::beside_root, "the middle of the root's interval", Sound::wang_time),
    left_out("time-rounding", Step::time_rounding, "the time of a plane without its rounding errors",
             Sound::wang_time),
    left_out("time-vertex", Step::last_vertex, "the time of a plane without the last vertex",
             Sound::wang_time),
    left_out("step-rounding", Step::advance_rounding, "steps without their rounding errors", Sound::advance),
    left_out("step-vertex", Step::last_vertex, "steps without the last vertex", Sound::advance),
    left_out("rest-of-step", Step::whole_step, "velocities of the rest of the step", Sound::advance),
    left_out("lines", Step::inside, "the distance of planes and lines, not of triangles and edges",
             Sound::advance),
    left_out("boxes-at-start", Step::both_ends, "boxes are compared at t = 0 alone", Sound::advance),
    left_out("contact", Step::separation, "the separation is added to boxes alone", Sound::advance),
    left_out("float-separation", Step::separation_in_full, "the square of the separation in float",
             Sound::advance),
    left_out("gives-up", Step::cannot_tell, "no collision after the last iteration", Sound::advance),
};

/// Defects in float, and the subjects of which they are made.
struct InFloat {
  std::string_view name, about;
  Sound of;
};
constexpr std::array in_float_table{
    InFloat{"float", "float, with the tolerances for double", Sound::wang},
    InFloat{"time-float", "the time of a computation in float", Sound::wang_time},
};

/// Applies the factor in "TOLERANCE*FACTOR" to `steps`; false if `name` has another form.
bool take_factor(std::string_view name, DefectiveSteps& steps) {
  const std::size_t star = name.find('*');
  if (star == std::string_view::npos) return false;
  for (const NamedTolerance& tolerance : tolerance_table) {
    if (tolerance.name != name.substr(0, star)) continue;
    const double factor = parse_number(name.substr(star + 1), name);
    if (factor < 0) throw Error(fmt::format("{}: found the factor {}, expected 0 or more", name, factor));
    steps.factors.*tolerance.value = factor;
    steps.changed = &tolerance;
    return true;
  }
  return false;
}

std::vector<Defect> make_library() {
  std::vector<Defect> library;
  for (const NamedTolerance& tolerance : tolerance_table) {
    const auto add = [&](double factor) {
      library.push_back({scaled_tolerance(tolerance.name, factor),
                         fmt::format("the tolerance {} times {}", tolerance.name, factor)});
    };
    for (const double factor : {0.5, 0.1, 0.01, 0.0}) add(factor);
    if (tolerance.accepts) continue;
    for (const double factor : {10.0, 100.0}) add(factor);
  }
  for (const LeftOut& each : left_out_table)
    library.push_back({fmt::format("{}{}", prefix, each.name), std::string(each.about)});
  for (const InFloat& each : in_float_table)
    library.push_back({fmt::format("{}{}", prefix, each.name), std::string(each.about)});
  return library;
}

}  // namespace

std::span<const NamedTolerance> named_tolerances() { return tolerance_table; }

std::string scaled_tolerance(std::string_view tolerance, double factor) {
  return fmt::format("{}{}*{}", prefix, tolerance, factor);
}

std::span<const Defect> defects() {
  static const std::vector<Defect> library = make_library();
  return library;
}

std::unique_ptr<Subject> try_make_defect(std::string_view name) {
  if (!name.starts_with(prefix)) return nullptr;
  const std::string_view defect = name.substr(prefix.size());
  Change change;
  bool known = take_factor(defect, change.steps);
  for (const InFloat& each : in_float_table) {
    if (each.name != defect) continue;
    known = true;
    change = {.sound = each.of, .in_float = true};
  }
  for (const LeftOut& each : left_out_table) {
    if (each.name != defect) continue;
    known = true;
    change.sound = each.of;
    for (const Step step : each.steps) change.steps.left_out |= bit_of(step);
  }
  if (!known)
    throw Error(
        fmt::format("unknown defect '{}', expected one that 'nearmiss subjects' lists", excerpt(name)));
  return std::make_unique<DefectiveSubject>(name, change);
}

}  // namespace nearmiss

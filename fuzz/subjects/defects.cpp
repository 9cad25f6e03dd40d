#include "fuzz/subjects/defects.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "ccd/error.hpp"
#include "ccd/excerpt.hpp"
#include "ccd/wang.hpp"
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

  [[nodiscard]] bool does(Step step) const { return (left_out >> static_cast<unsigned>(step) & 1) == 0; }

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

class DefectiveSubject final : public Subject {
 public:
  DefectiveSubject(std::string_view name, const DefectiveSteps& steps, bool in_float)
      : name_(name), steps_(steps), in_float_(in_float) {}

  [[nodiscard]] const std::string& name() const override { return name_; }

  using Subject::decide;
  [[nodiscard]] Verdict decide(const Query& query) const override {
    if (!is_finite(query)) refuse_coordinates(name_);
    return decide(query, steps_);
  }

  [[nodiscard]] double distance_bound(const Query& query) const override {
    return wang_->distance_bound(query);
  }

  [[nodiscard]] double needed_tolerance(const Query& query) const override {
    return least_loosening([&](double s) { return decide(query, steps_.loosened(s)).hit; });
  }

 private:
  [[nodiscard]] Verdict decide(const Query& query, const DefectiveSteps& steps) const {
    return in_float_ ? decide_in<float>(query, steps) : decide_in<double>(query, steps);
  }

  template <class T>
  static Verdict decide_in(const Query& query, const DefectiveSteps& steps) {
    return query.kind == Kind::vertex_triangle
               ? wang<Kind::vertex_triangle, T, WangOptions{}>(query, std::nullopt, steps)
               : wang<Kind::edge_edge, T, WangOptions{}>(query, std::nullopt, steps);
  }

  std::string name_;
  DefectiveSteps steps_;
  bool in_float_;
  std::unique_ptr<Subject> wang_ = make_subject("wang");
};

struct LeftOut {
  std::string_view name, about;
  std::array<Step, 3> steps;  ///< the left-out steps; one is repeated if there are fewer than three
};

constexpr LeftOut left_out(std::string_view name, Step step, std::string_view about) {
  return {name, about, {step, step, step}};
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
    LeftOut{"start", "t = 0 is tested nowhere", {Step::solver_start, Step::ve_start, Step::ve_start}},
    LeftOut{"end", "t = 1 is tested nowhere", {Step::solver_end, Step::proximity_end, Step::ve_end}},
};

constexpr std::string_view in_float_name = "float";

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
  library.push_back({fmt::format("{}{}", prefix, in_float_name), "float, with the tolerances for double"});
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
  DefectiveSteps steps;
  bool known = defect == in_float_name || take_factor(defect, steps);
  for (const LeftOut& each : left_out_table) {
    if (each.name != defect) continue;
    known = true;
    for (const Step step : each.steps) steps.left_out |= std::uint64_t{1} << static_cast<unsigned>(step);
  }
  if (!known)
    throw Error(
        fmt::format("unknown defect '{}', expected one that 'nearmiss subjects' lists", excerpt(name)));
  return std::make_unique<DefectiveSubject>(name, steps, defect == in_float_name);
}

}  // namespace nearmiss

#include "fuzz/studies/audit.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "ccd/wang/bounds/constraints.hpp"
#include "ccd/wang/cubic.hpp"
#include "ccd/wang/ve_culling.hpp"

namespace nearmiss {

namespace {

constexpr double none = RoundingConstant::none;

constexpr std::string_view b1 = "B eps";
constexpr std::string_view b2 = "B^2 eps";
constexpr std::string_view b3 = "B^3 eps";
constexpr std::string_view b4 = "B^4 eps";
constexpr std::string_view b2_root = "B^2 eps^1/2";
constexpr std::string_view line = "B^4 eps / (eta N)";

constexpr std::string_view beyond = "relative positions of edges are within 2B (§4.1 has B)";
constexpr std::string_view exact = "of exact vectors";
constexpr std::string_view appendix =
    "the paper's appendix is missing; derived in ccd/wang/bounds/solver_errors.hpp";

constexpr std::string_view extents = "bound_needs, ccd/wang/motion.hpp";
constexpr std::string_view margin = "bound_margin - bound_needs, ccd/wang/motion.hpp";
constexpr std::string_view value = "evaluation_error, ccd/wang/ve_culling.hpp";
constexpr std::string_view inside = "weight_error, ccd/wang/ve_culling.hpp";
constexpr std::string_view spread = "spread_error, ccd/wang/ve_culling.hpp";
constexpr std::string_view culling = "weight_error + spread_error, ccd/wang/ve_culling.hpp";

// The bounds that Theorem 4.1 of the paper gives for the rounding errors of the barycentric tests, in units
// of B⁴ε.
constexpr double inside_vt = 564;
constexpr double inside_ee = 360;
constexpr double inside_ee_far = 540;  // if components of p, the relative position, are up to 2B

std::string_view first_broken(const Tolerances<double>& tol, double eps,
                              const RoundingErrors<double>& errors) {
  // The edge length E in constraint (3) of the paper. The edge length E in constraint (2) is 21/16 of this
  // length.
  const double E = 4 * std::sqrt(eps);
  for (const auto& each : constraints(tol, 21 * E / 16, E, errors))
    if (!(each.more >= each.less)) return each.about;
  return "";
}

}  // namespace

std::vector<RoundingConstant> rounding_bounds() {
  const auto printed = printed_errors(1.0);
  return {
      {"VV: x.v", "4.2", b2, 9, 9, proven::dot, exact},
      {"VV: v.v", "4.2", b2, 9, 9, proven::dot, exact},
      {"VV: time", "4.2", "eps B/b", 12, none, proven::time, exact},
      {"VE: squared length", "4.3", b2, printed.length2, 21, proven::length2},
      {"VE: weight", "4.3", b2, 22, 21, proven::weight_ve},
      {"VE: barycentric test", "4.3", b2, printed.weight_ve, 42, proven::inside_ve},
      {"VE: F_0ij", "4.3", b2, none, 63, proven::F_ve, "not quoted"},
      {"VE of EE: weight", "4.3", b2, 22, 42, proven::weight_ve_far, beyond},
      {"VE of EE: barycentric test", "4.3", b2, printed.weight_ve, 63, proven::inside_ve_far, beyond},
      {"VE of EE: F_0ij", "4.3", b2, none, 117, proven::F_ve_far, "not quoted"},
      {"F: a, exact vectors", "4.4", b3, 6 * 5, 30, proven::exact_coefficient_ad},
      {"F: b, exact vectors", "4.4", b3, 18 * 7, 126, proven::exact_coefficient_bc},
      {"F: c, exact vectors", "4.4", b3, 18 * 7, 126, proven::exact_coefficient_bc},
      {"F: d, exact vectors", "4.4", b3, 6 * 5, 30, proven::exact_coefficient_ad},
      {"VT: N", "4.4", b2, printed.area, 12, proven::normal},
      {"VT: height test", "4.4", b2, printed.height_vt, 20, proven::height_vt},
      {"VT: weight", "4.4", b4, 181, 180, proven::weight},
      {"VT: barycentric test", "4.4", b4, printed.weight_vt, inside_vt, proven::inside_vt},
      {"EE: N", "4.5", b2, printed.area, 12, proven::normal},
      {"EE: height test", "4.5", b2, printed.height_ee, 15, proven::height_ee},
      {"EE: weight", "4.5", b4, 181, 180, proven::weight},
      {"EE: barycentric test", "4.5", b4, printed.weight_ee, inside_ee, proven::inside_ee},
      {"EE: weight, far p", "4.5", b4, 181, 360, proven::weight_far, beyond},
      {"EE: barycentric test, far p", "4.5", b4, printed.weight_ee, inside_ee_far, proven::inside_ee_far,
       beyond},
      {"VT: E + W", extents, b1, bound_needs / 2.0, none, proven::extents_vt},
      {"EE: E + W", extents, b1, bound_needs / 2.0, none, proven::extents_ee},
      {"VT: B", margin, b1, bound_margin - bound_needs, none, proven::bound_vt},
      {"EE: B", margin, b1, bound_margin - bound_needs, none, proven::bound_ee},
      {"clearance", "clearance_error, ccd/wang/cubic.hpp", b3, clearance_error, none, proven::clearance,
       "of exact coefficients"},
      {"VT: F(t)", value, b3, evaluation_error, none, proven::value_vt},
      {"EE: F(t)", value, b3, evaluation_error, none, proven::value_ee},
      {"VT: weight_error", inside, b4, weight_error, none, proven::inside_vt},
      {"EE: weight_error", inside, b4, weight_error, none, proven::inside_ee_far},
      {"VT: spread_error", spread, b4, spread_error, none, proven::spread_vt},
      {"EE: spread_error", spread, b4, spread_error, none, proven::spread_ee},
      {"VT: weight against spread", culling, b4, weight_error + spread_error, none, proven::culling_vt},
      {"EE: weight against spread", culling, b4, weight_error + spread_error, none, proven::culling_ee},
  };
}

std::vector<RoundingConstant> rounding_consequences() {
  // Let t̂ be the computed time, and t the exact time. The squared distance at t̂ exceeds the squared
  // distance at t by at most 2 ‖x‖ ‖v‖ |t̂ - t|. Here, x and v are the relative position and velocity of the
  // vertices. Vertex-triangle: ‖x‖ <= √3 B. Edge-edge: ‖x‖ <= √3 2B. In both cases, ‖v‖ <= √3 b, and |t̂ - t|
  // <= (error of x.v + error of v.v + 1) ε / b.
  const double moved = 2 * 3 * (9 + 9 + 1);
  const double moved_far = 2 * 3 * 2 * (2 * 9 + 9 + 1);
  const double squared_distance = 3 * 7;

  const double eps = epsilon<double>();
  const double root_eps = std::sqrt(eps);
  const auto paper = paper_tolerances(1.0);
  const double mu = cubic_residual(eps / 2) / eps;
  // This value includes the rounding error of G.
  const double psi = least_psi(eps / 2, paper.S, paper.rho) / root_eps;

  return {
      {"VV: quotient", "4.2", "eps (B/b + 1)", 10, 9},
      {"VV: squared distance moved", "4.2", b2, 289, moved},
      {"VV: delta", "4.2", b2, 311, moved + squared_distance, proven::delta},
      {"VV of EE: delta", "4.2", b2, 311, moved_far + 4 * squared_distance, proven::delta_far, beyond},
      {"VV: distance", "4.2", "B eps^1/2", 25, std::sqrt(2.0 * 311)},
      {"VE: G of case 4", "4.3, App. C", b2_root, 688, psi, none, appendix},
      {"VE: psi", "4.3, App. C", b2_root, 725, psi, none, appendix},
      {"VE: psi over lambda", "4.3", "B eps^1/4", 16, 725 / std::sqrt(2080.0)},
      {"VE: lambda^2 over 4", "4.3", b2_root, 522, (2080 + 22 * root_eps) / 4},
      {"cubic solver", "4.4, App. B", b3, 33492, mu, none, appendix},
      {"VT: height test over E", "4.4", "B eps^1/2", 4, 21 / (21.0 / 4)},
      {"EE: height test over E", "4.5", "B eps^1/2", 4, 16 / 4.0},
      {"VT: distance from an edge line", "4.4", line, 1130, 2 * inside_vt, 2 * proven::inside_vt},
      {"EE: distance from an edge line", "4.5", line, 724, 2 * inside_ee, 2 * proven::inside_ee},
      {"EE: distance from an edge line, far p", "4.5", line, 724, 2 * inside_ee_far,
       2 * proven::inside_ee_far, beyond},
      {"EE: distance of a false positive", "4.5.1", line, 1448, 4 * inside_ee, 4 * proven::inside_ee},
      {"EE: distance of a false positive, far p", "4.5.1", line, 1448, 4 * inside_ee_far,
       4 * proven::inside_ee_far, beyond},
      {"distance bound", "4.4.1", "B eps^1/4", 41, std::sqrt(34.0 * 34 + 522)},
      // A weight is linear in the relative position p, so it changes by at most ‖N‖ ‖edge‖ √3 B h in a time
      // interval whose length is h (not the separation). Here, ‖N‖ <= 3B² and ‖edge‖ <= √3 B.
      {"VE culling: spread of a weight", "5", "B^4 h", 9, 3 * 3},
      {"critical points", "node_error, ccd/wang/ve_culling.hpp", b3, node_error, 3 * 18, none,
       "derived in ccd/wang/cubic.hpp"},
  };
}

std::vector<ToleranceRow> tolerance_table() {
  constexpr std::array<std::pair<int, std::string_view>, 16> scalars{{{-10, "11 bits (half)"},
                                                                      {-11, "12 bits"},
                                                                      {-12, "13 bits"},
                                                                      {-16, "17 bits"},
                                                                      {-20, "21 bits"},
                                                                      {-23, "float"},
                                                                      {-28, "29 bits"},
                                                                      {-32, "33 bits"},
                                                                      {-36, "37 bits"},
                                                                      {-37, "38 bits"},
                                                                      {-40, "41 bits"},
                                                                      {-52, "double"},
                                                                      {-63, "extended"},
                                                                      {-104, "double-double"},
                                                                      {-112, "quadruple"},
                                                                      {-255, "256 bits"}}};
  std::vector<ToleranceRow> rows;
  for (const auto& [exponent, scalar] : scalars) {
    const double eps = std::ldexp(1.0, exponent);
    const double e = std::sqrt(std::sqrt(eps));
    const ToleranceConstants tight = solve_tight(exponent);
    const auto paper = tolerances_of(closed_forms(exponent), eps, 1.0);
    rows.push_back({.exponent = exponent,
                    .scalar = scalar,
                    .tight = tight,
                    .paper_bound = paper.distance_bound() / e,
                    .tight_bound = tolerances_of(tight, eps, 1.0).distance_bound() / e,
                    .paper_breaks = first_broken(paper, eps, full_errors(eps, paper.S, paper.rho)),
                    .printed_breaks = first_broken(paper, eps, printed_errors(eps))});
  }
  return rows;
}

}  // namespace nearmiss

#include "ccd/constraints.hpp"
#include "ccd/cubic.hpp"
#include "ccd/motion.hpp"
#include "ccd/proven.hpp"
#include "ccd/ve_culling.hpp"
#include "tests/proofs/ccd_problems.hpp"
#include "tests/proofs/claims.hpp"

namespace nearmiss::proofs {

namespace {

constexpr Kind vt = Kind::vertex_triangle;
constexpr Kind ee = Kind::edge_edge;
using enum Reach;

constexpr std::string_view beps = "B eps";
constexpr std::string_view b2 = "B^2 eps";
constexpr std::string_view b3 = "B^3 eps";
constexpr std::string_view b4 = "B^4 eps";
constexpr std::string_view gappa = "Gappa";
constexpr std::string_view edges = "Gappa, p within 2B";
constexpr std::string_view exact = "Gappa, of exact vectors";
constexpr std::string_view of_coefficients = "Gappa, of exact coefficients";
constexpr std::string_view sum = "Gappa, sum of three (proven.hpp)";

// For ε = 1 the printed errors equal their factors.
const auto printed = printed_errors(1.0);
// The largest ε, for which the factors of `full_errors` are largest; S = B.
constexpr double largest_eps = 0x1p-10;
constexpr auto full = full_errors(largest_eps, 1.0, 0.0);
constexpr double factor(double error) { return error / largest_eps; }

std::function<Problem()> primitive_of(Kind kind, Reach reach, ConfigurationPart part) {
  return [=] { return configuration(kind, reach, part); };
}
std::function<Problem()> edge_of(Reach reach, EdgePart part) {
  return [=] { return vertex_edge(reach, part); };
}
std::function<Problem()> cubic_of(Kind kind, CubicPart part) {
  return [=] { return cubic(kind, part); };
}
std::function<Problem()> vertices_of(Reach reach, VertexPart part) {
  return [=] { return exact_vertices(reach, part); };
}

void append(std::vector<CcdClaim>& all, std::vector<CcdClaim> more) {
  all.insert(all.end(), more.begin(), more.end());
}

std::vector<CcdClaim> printed_claims() {
  constexpr auto here = "printed_errors, ccd/constraints.hpp";
  constexpr auto paper = "the paper, 4.4";
  return {
      {"VT: N", here, printed.area, proven::normal, b2, gappa,
       primitive_of(vt, near, ConfigurationPart::normal)},
      {"EE: N", here, printed.area, proven::normal, b2, gappa,
       primitive_of(ee, near, ConfigurationPart::normal)},
      {"VT: height test", here, printed.height_vt, proven::height_vt, b2, gappa,
       primitive_of(vt, near, ConfigurationPart::height)},
      {"EE: height test", here, printed.height_ee, proven::height_ee, b2, gappa,
       primitive_of(ee, near, ConfigurationPart::height)},
      {"VT: weight", paper, 181, proven::weight, b4, gappa,
       primitive_of(vt, near, ConfigurationPart::weight)},
      {"EE: weight", paper, 181, proven::weight, b4, gappa,
       primitive_of(ee, near, ConfigurationPart::weight)},
      {"VT: barycentric test", here, printed.weight_vt, proven::inside_vt, b4, gappa,
       primitive_of(vt, near, ConfigurationPart::inside)},
      {"EE: barycentric test", here, printed.weight_ee, proven::inside_ee, b4, gappa,
       primitive_of(ee, near, ConfigurationPart::inside)},
      {"VE: squared length", here, printed.length2, proven::length2, b2, gappa,
       edge_of(near, EdgePart::length2)},
      {"VE: weight", "the paper, 4.3", 22, proven::weight_ve, b2, gappa, edge_of(near, EdgePart::weight)},
      {"VE: barycentric test", here, printed.weight_ve, proven::inside_ve, b2, gappa,
       edge_of(near, EdgePart::inside)},
      {"VV: delta", here, printed.delta, proven::delta, b2, sum, [] { return vertices(near); }},
      {"VV of EE: delta", here, printed.delta, proven::delta_far, b2, sum, [] { return vertices(far); }},
      {"VV: x.v", "the paper, 4.2", 9, proven::dot, b2, exact, vertices_of(near, VertexPart::xv)},
      {"VV: v.v", "the paper, 4.2", 9, proven::dot, b2, exact, vertices_of(near, VertexPart::vv)},
      {"VV: time", "the paper, 4.2", 12, proven::time, "eps B/b", exact, vertices_of(near, VertexPart::time),
       CcdClaim::underflow_of_time},
  };
}

std::vector<CcdClaim> full_claims() {
  constexpr auto here = "full_errors, ccd/constraints.hpp";
  return {
      {"area", here, factor(full.area), proven::normal, b2, edges,
       primitive_of(ee, far, ConfigurationPart::normal)},
      {"height_vt", here, factor(full.height_vt), proven::height_vt, b2, gappa,
       primitive_of(vt, near, ConfigurationPart::height)},
      {"height_ee", here, factor(full.height_ee), proven::height_ee, b2, edges,
       primitive_of(ee, far, ConfigurationPart::height)},
      {"weight_vt", here, factor(full.weight_vt), proven::inside_vt, b4, gappa,
       primitive_of(vt, near, ConfigurationPart::inside)},
      {"weight_ee", here, factor(full.weight_ee), proven::inside_ee_far, b4, edges,
       primitive_of(ee, far, ConfigurationPart::inside)},
      {"length2", here, factor(full.length2), proven::length2, b2, edges, edge_of(far, EdgePart::length2)},
      {"weight_ve", here, factor(full.weight_ve), proven::inside_ve_far, b2, edges,
       edge_of(far, EdgePart::inside)},
      {"F", here, factor(full.F), proven::F_ve_far, b2, edges, edge_of(far, EdgePart::F)},
      {"F without S", here, factor(full_errors(largest_eps, 0.0, 0.0).F), proven::F_ve_far_without_S, b2,
       edges, edge_of(far, EdgePart::F_without_S)},
      {"F of S", "F_ve_of_S, ccd/proven.hpp", proven::F_ve_of_S, proven::F_ve_of_S, "S B eps", edges,
       edge_of(far, EdgePart::F_of_S)},
      {"delta", here, factor(full.delta), proven::delta_far, b2, sum, [] { return vertices(far); }},
  };
}

/// Bounds that only the audit compares with constants of the paper.
std::vector<CcdClaim> audited_claims() {
  const auto only = [](std::string_view name, std::string_view constant, double bound, std::string_view unit,
                       std::string_view how, const std::function<Problem()>& problem) {
    return CcdClaim{name, constant, bound, bound, unit, how, problem};
  };
  return {
      only("EE: weight, far p", "weight_far, ccd/proven.hpp", proven::weight_far, b4, edges,
           primitive_of(ee, far, ConfigurationPart::weight)),
      only("VE of EE: weight", "weight_ve_far, ccd/proven.hpp", proven::weight_ve_far, b2, edges,
           edge_of(far, EdgePart::weight)),
      only("VE: F_0ij", "F_ve, ccd/proven.hpp", proven::F_ve, b2, gappa, edge_of(near, EdgePart::F)),
  };
}

/// The parts of δ.
std::vector<CcdClaim> delta_claims() {
  constexpr auto here = "delta, ccd/proven.hpp";
  std::vector<CcdClaim> all;
  for (const Reach reach : {near, far}) {
    const bool is_far = reach == far;
    const double distance = is_far ? proven::squared_distance_far : proven::squared_distance;
    const double vectors = is_far ? proven::distance_of_vectors_far : proven::distance_of_vectors;
    const double time = is_far ? proven::time_far : proven::time;
    all.push_back({is_far ? "VV of EE: distance" : "VV: distance", here, distance, distance, b2, exact,
                   vertices_of(reach, VertexPart::squared_distance)});
    all.push_back({is_far ? "VV of EE: vectors" : "VV: vectors", here, vectors, vectors, b2,
                   "Gappa, rounding of vectors alone", [=] { return vertices(reach); },
                   CcdClaim::underflow_of_vectors, true});
    if (is_far)
      all.push_back({"VV of EE: time", here, time, time, "eps B/b", exact,
                     vertices_of(reach, VertexPart::time), CcdClaim::underflow_of_time});
  }
  return all;
}

std::vector<CcdClaim> cubic_claims() {
  constexpr auto here = "coplanarity, ccd/cubic.hpp";
  const auto of_exact = [](CubicPart part) { return [=] { return exact_cubic(part); }; };
  return {
      {"F: a, exact vectors", here, 6 * 5, proven::exact_coefficient_ad, b3, exact, of_exact(CubicPart::a)},
      {"F: b, exact vectors", here, 18 * 7, proven::exact_coefficient_bc, b3, exact, of_exact(CubicPart::b)},
      {"F: c, exact vectors", here, 18 * 7, proven::exact_coefficient_bc, b3, exact, of_exact(CubicPart::c)},
      {"F: d, exact vectors", here, 6 * 5, proven::exact_coefficient_ad, b3, exact, of_exact(CubicPart::d)},
      {"F: a", "coefficient_a, ccd/proven.hpp", proven::coefficient_a, proven::coefficient_a, b3, edges,
       cubic_of(ee, CubicPart::a)},
      {"F: b", "coefficient_b, ccd/proven.hpp", proven::coefficient_b, proven::coefficient_b, b3, edges,
       cubic_of(ee, CubicPart::b)},
      {"F: c", "coefficient_c, ccd/proven.hpp", proven::coefficient_c, proven::coefficient_c, b3, edges,
       cubic_of(ee, CubicPart::c)},
      {"F: d", "coefficient_d, ccd/proven.hpp", proven::coefficient_d, proven::coefficient_d, b3, edges,
       cubic_of(ee, CubicPart::d)},
      {"Horner", "horner, ccd/proven.hpp", proven::horner, proven::horner, b3, of_coefficients, horner},
      {"clearance", "clearance_error, ccd/cubic.hpp", clearance_error, proven::clearance, b3, of_coefficients,
       clearance_of_exact},
  };
}

std::vector<CcdClaim> other_claims() {
  constexpr auto motion = "bound_needs, ccd/motion.hpp";
  constexpr auto margin = "bound_margin - bound_needs, ccd/motion.hpp";
  constexpr auto culled = "weight_error + spread_error, ccd/ve_culling.hpp";
  return {
      {"VT: E + W", motion, bound_needs / 2.0, proven::extents_vt, beps, gappa, [] { return extents(vt); }},
      {"EE: E + W", motion, bound_needs / 2.0, proven::extents_ee, beps, "Gappa, p within 4B",
       [] { return extents(ee); }},
      {"VT: B", margin, bound_margin - bound_needs, proven::bound_vt, beps, gappa, [] { return bound(vt); }},
      {"EE: B", margin, bound_margin - bound_needs, proven::bound_ee, beps, "Gappa, p within 4B",
       [] { return bound(ee); }},
      {"VT: F(t)", "evaluation_error, ccd/ve_culling.hpp", evaluation_error, proven::value_vt, b3, gappa,
       cubic_of(vt, CubicPart::value)},
      {"EE: F(t)", "evaluation_error, ccd/ve_culling.hpp", evaluation_error, proven::value_ee, b3, edges,
       cubic_of(ee, CubicPart::value)},
      {"VT: weight_error", "weight_error, ccd/ve_culling.hpp", weight_error, proven::inside_vt, b4, gappa,
       primitive_of(vt, near, ConfigurationPart::inside)},
      {"EE: weight_error", "weight_error, ccd/ve_culling.hpp", weight_error, proven::inside_ee_far, b4, edges,
       primitive_of(ee, far, ConfigurationPart::inside)},
      {"VT: spread_error", "spread_error, ccd/ve_culling.hpp", spread_error, proven::spread_vt, b4, gappa,
       [] { return spread(vt); }},
      {"EE: spread_error", "spread_error, ccd/ve_culling.hpp", spread_error, proven::spread_ee, b4, edges,
       [] { return spread(ee); }},
      {"VT: weight against spread", culled, weight_error + spread_error, proven::culling_vt, b4, gappa,
       [] { return culling(vt); }},
      {"EE: weight against spread", culled, weight_error + spread_error, proven::culling_ee, b4, edges,
       [] { return culling(ee); }},
  };
}

}  // namespace

std::vector<CcdClaim> ccd_claims() {
  std::vector<CcdClaim> all = printed_claims();
  append(all, full_claims());
  append(all, audited_claims());
  append(all, delta_claims());
  append(all, cubic_claims());
  append(all, other_claims());
  return all;
}

}  // namespace nearmiss::proofs

#include <algorithm>
#include <stdexcept>

#include "ccd/wang/bounds/constraints.hpp"
#include "ccd/wang/bounds/proven.hpp"
#include "fuzz/studies/audit.hpp"
#include "tests/proofs/ccd_problems.hpp"
#include "tests/proofs/claims.hpp"

namespace nearmiss::proofs {

namespace {

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

// With ε = 1, printed_errors() gives the factors of ε in the paper's bounds.
const auto printed = printed_errors(1.0);
// The factors of ε in `full_errors` are largest at the largest ε. They are computed for S = B; S is a
// tolerance of the vertex-edge test.
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

const RoundingConstant& row_of(std::string_view name) {
  static const auto rows = rounding_bounds();
  const auto row =
      std::find_if(rows.begin(), rows.end(), [&](const auto& each) { return each.name == name; });
  if (row == rows.end()) throw std::invalid_argument("the audit has no such row");
  return *row;
}

/// The claim that the quoted constant of a row of the audit is large enough.
CcdClaim audited(std::string_view name, std::string_view constant, std::string_view how,
                 const std::function<Problem()>& problem) {
  const RoundingConstant& row = row_of(name);
  return {row.name, constant, row.quoted, row.proven, row.unit, how, problem};
}
CcdClaim ours(std::string_view name, std::string_view how, const std::function<Problem()>& problem) {
  return audited(name, row_of(name).section, how, problem);
}

/// The claim that `bound` is large enough. The audit has a row whose quoted constant is missing or too small,
/// and `bound` replaces this constant.
CcdClaim replaced(std::string_view name, std::string_view constant, double bound, std::string_view how,
                  const std::function<Problem()>& problem) {
  const RoundingConstant& row = row_of(name);
  return {row.name, constant, bound, row.proven, row.unit, how, problem};
}

void append(std::vector<CcdClaim>& all, std::vector<CcdClaim> more) {
  all.insert(all.end(), more.begin(), more.end());
}

std::vector<CcdClaim> printed_claims() {
  using enum ConfigurationPart;
  constexpr auto here = "printed_errors, ccd/wang/bounds/constraints.hpp";
  constexpr auto paper = "the paper, 4.4";
  std::vector<CcdClaim> all{
      audited("VT: N", here, gappa, primitive_of(vt, near, normal)),
      audited("EE: N", here, gappa, primitive_of(ee, near, normal)),
      audited("VT: height test", here, gappa, primitive_of(vt, near, height)),
      audited("EE: height test", here, gappa, primitive_of(ee, near, height)),
      audited("VT: weight", paper, gappa, primitive_of(vt, near, weight)),
      audited("EE: weight", paper, gappa, primitive_of(ee, near, weight)),
      audited("VT: barycentric test", here, gappa, primitive_of(vt, near, inside)),
      audited("EE: barycentric test", here, gappa, primitive_of(ee, near, inside)),
      audited("VE: squared length", here, gappa, edge_of(near, EdgePart::length2)),
      audited("VE: weight", "the paper, 4.3", gappa, edge_of(near, EdgePart::weight)),
      audited("VE: barycentric test", here, gappa, edge_of(near, EdgePart::inside)),
      {"VV: delta", here, printed.delta, proven::delta, b2, sum, [] { return vertices(near); }},
      {"VV of EE: delta", here, printed.delta, proven::delta_far, b2, sum, [] { return vertices(far); }},
      audited("VV: x.v", "the paper, 4.2", exact, vertices_of(near, VertexPart::xv)),
      audited("VV: v.v", "the paper, 4.2", exact, vertices_of(near, VertexPart::vv)),
      audited("VV: time", "the paper, 4.2", exact, vertices_of(near, VertexPart::time)),
  };
  all.back().underflow = CcdClaim::underflow_of_time;
  return all;
}

std::vector<CcdClaim> full_claims() {
  constexpr auto here = "full_errors, ccd/wang/bounds/constraints.hpp";
  return {
      {"area", here, factor(full.area), proven::normal, b2, edges,
       primitive_of(ee, far, ConfigurationPart::normal)},
      {"height_vt", here, factor(full.height_vt), proven::height_vt, b2, gappa,
       primitive_of(vt, near, ConfigurationPart::height)},
      {"height_ee", here, factor(full.height_ee), proven::height_ee, b2, edges,
       primitive_of(ee, far, ConfigurationPart::height)},
      {"weight_vt", here, factor(full.weight_vt), proven::inside_vt, b4, gappa,
       primitive_of(vt, near, ConfigurationPart::inside)},
      replaced("EE: barycentric test, far p", here, factor(full.weight_ee), edges,
               primitive_of(ee, far, ConfigurationPart::inside)),
      {"length2", here, factor(full.length2), proven::length2, b2, edges, edge_of(far, EdgePart::length2)},
      replaced("VE of EE: barycentric test", here, factor(full.weight_ve), edges,
               edge_of(far, EdgePart::inside)),
      replaced("VE of EE: F_0ij", here, factor(full.F), edges, edge_of(far, EdgePart::F)),
      {"F without S", here, factor(full_errors(largest_eps, 0.0, 0.0).F), proven::F_ve_far_without_S, b2,
       edges, edge_of(far, EdgePart::F_without_S)},
      {"F of S", "F_ve_of_S, ccd/wang/bounds/proven.hpp", proven::F_ve_of_S, proven::F_ve_of_S, "S B eps",
       edges, edge_of(far, EdgePart::F_of_S)},
      {"delta", here, factor(full.delta), proven::delta_far, b2, sum, [] { return vertices(far); }},
  };
}

/// Claims about bounds that the audit shows, but that the code does not use.
std::vector<CcdClaim> shown_claims() {
  return {
      replaced("EE: weight, far p", "weight_far, ccd/wang/bounds/proven.hpp", proven::weight_far, edges,
               primitive_of(ee, far, ConfigurationPart::weight)),
      replaced("VE of EE: weight", "weight_ve_far, ccd/wang/bounds/proven.hpp", proven::weight_ve_far, edges,
               edge_of(far, EdgePart::weight)),
      replaced("VE: F_0ij", "F_ve, ccd/wang/bounds/proven.hpp", proven::F_ve, gappa,
               edge_of(near, EdgePart::F)),
  };
}

/// Claims about the parts of δ, the paper's bound of the error of a squared distance.
std::vector<CcdClaim> delta_claims() {
  constexpr auto here = "delta, ccd/wang/bounds/proven.hpp";
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
  constexpr auto here = "coplanarity, ccd/wang/cubic.hpp";
  const auto of_exact = [](CubicPart part) { return [=] { return exact_cubic(part); }; };
  return {
      audited("F: a, exact vectors", here, exact, of_exact(CubicPart::a)),
      audited("F: b, exact vectors", here, exact, of_exact(CubicPart::b)),
      audited("F: c, exact vectors", here, exact, of_exact(CubicPart::c)),
      audited("F: d, exact vectors", here, exact, of_exact(CubicPart::d)),
      {"F: a", "coefficient_a, ccd/wang/bounds/proven.hpp", proven::coefficient_a, proven::coefficient_a, b3,
       edges, cubic_of(ee, CubicPart::a)},
      {"F: b", "coefficient_b, ccd/wang/bounds/proven.hpp", proven::coefficient_b, proven::coefficient_b, b3,
       edges, cubic_of(ee, CubicPart::b)},
      {"F: c", "coefficient_c, ccd/wang/bounds/proven.hpp", proven::coefficient_c, proven::coefficient_c, b3,
       edges, cubic_of(ee, CubicPart::c)},
      {"F: d", "coefficient_d, ccd/wang/bounds/proven.hpp", proven::coefficient_d, proven::coefficient_d, b3,
       edges, cubic_of(ee, CubicPart::d)},
      {"Horner", "horner, ccd/wang/bounds/proven.hpp", proven::horner, proven::horner, b3, of_coefficients,
       horner},
      ours("clearance", of_coefficients, clearance_of_exact),
  };
}

std::vector<CcdClaim> other_claims() {
  using enum ConfigurationPart;
  return {
      ours("VT: E + W", gappa, [] { return extents(vt); }),
      ours("EE: E + W", "Gappa, p within 4B", [] { return extents(ee); }),
      ours("VT: B", gappa, [] { return bound(vt); }),
      ours("EE: B", "Gappa, p within 4B", [] { return bound(ee); }),
      ours("VT: F(t)", gappa, cubic_of(vt, CubicPart::value)),
      ours("EE: F(t)", edges, cubic_of(ee, CubicPart::value)),
      ours("VT: weight_error", gappa, primitive_of(vt, near, inside)),
      ours("EE: weight_error", edges, primitive_of(ee, far, inside)),
      ours("VT: spread_error", gappa, [] { return spread(vt); }),
      ours("EE: spread_error", edges, [] { return spread(ee); }),
      ours("VT: weight against spread", gappa, [] { return culling(vt); }),
      ours("EE: weight against spread", edges, [] { return culling(ee); }),
  };
}

}  // namespace

std::vector<CcdClaim> ccd_claims() {
  std::vector<CcdClaim> all = printed_claims();
  append(all, full_claims());
  append(all, shown_claims());
  append(all, delta_claims());
  append(all, cubic_claims());
  append(all, other_claims());
  return all;
}

}  // namespace nearmiss::proofs

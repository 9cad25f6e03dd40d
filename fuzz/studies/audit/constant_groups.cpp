#include "fuzz/studies/audit/constant_groups.hpp"

#include <algorithm>
#include <array>

#include "ccd/proven.hpp"
#include "ccd/ve_culling.hpp"

namespace nearmiss::audit_parts {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double eps = epsilon<double>();
constexpr Kind vt = Kind::vertex_triangle;
constexpr Kind ee = Kind::edge_edge;

constexpr std::string_view B2 = "B^2 eps";
constexpr std::string_view B3 = "B^3 eps";
constexpr std::string_view B4 = "B^4 eps";
constexpr std::string_view B2_root = "B^2 eps^1/2";
constexpr std::string_view line = "B^4 eps / (eta N)";

constexpr std::string_view beyond = "relative positions of edges are within 2B (§4.1 has B)";
constexpr std::string_view vectors = "with the rounding of relative vectors (§5), to nearest";
constexpr std::string_view appendix = "the paper's appendix is missing; derived in ccd/";

AuditRow quote(std::string_view name, std::string_view section, std::string_view unit, double quoted,
               double proven, std::string_view note = "") {
  return {.name = name,
          .section = section,
          .unit = unit,
          .quoted = quoted,
          .proven = proven,
          .note = note,
          .bound = {}};
}

using Groups = std::vector<ConstantGroup>;

/// §4.2.
Groups vertex_vertex_groups() {
  return {{{quote("VV: m = x.v", "4.2", B2, 3 * 3, proven::dot),
            quote("VV: n = v.v", "4.2", B2, 3 * 3, proven::dot),
            quote("VV: time", "4.2", "eps (B/b + 1)", 12, nan),
            quote("VV: squared distance moved", "4.2", B2, 289, nan),
            quote("VV: delta", "4.2", B2, 311, proven::delta)},
           vertex_vertex_time},
          {{quote("VV of EE: delta", "4.2", B2, 311, proven::delta_far, beyond)}, far_vertices, 2}};
}

/// §4.3.
Groups vertex_edge_groups() {
  return {{{quote("VE: squared length", "4.3", B2, 22, proven::length2),
            quote("VE: weight", "4.3", B2, 22, proven::weight_ve),
            quote("VE: barycentric test", "4.3", B2, 44, proven::inside_ve),
            quote("VE: F_0ij", "4.3", B2, nan, proven::F_ve, "not quoted")},
           near_edge},
          {{quote("VE of EE: squared length", "4.3", B2, 22, proven::length2),
            quote("VE of EE: weight", "4.3", B2, 22, proven::weight_ve_far, beyond),
            quote("VE of EE: barycentric test", "4.3", B2, 44, proven::inside_ve_far, beyond),
            quote("VE of EE: F_0ij", "4.3", B2, nan, proven::F_ve_far, "not quoted")},
           near_edge,
           2}};
}

/// §4.3, the solver of case 4: its residual, and how far above the minimum its candidates are.
Groups edge_solver_groups() {
  return {{{quote("VE: residual of case 4", "App. A", B2, nan, nan, appendix)}, quadratic_residual},
          {{quote("VE of EE: residual of case 4", "App. A", B2, nan, nan, appendix)}, quadratic_residual, 2},
          {{quote("VE: G of case 4", "4.3, App. C", B2_root, 688, nan, appendix),
            quote("VE: psi", "4.3, App. C", B2_root, 725, nan, appendix)},
           missed_minimum},
          {{quote("VE of EE: G of case 4", "4.3, App. C", B2_root, 688, nan, appendix),
            quote("VE of EE: psi", "4.3, App. C", B2_root, 725, nan, appendix)},
           missed_minimum,
           2}};
}

/// §4.4, F and its roots.
Groups cubic_groups() {
  return {{{quote("F: a, d", "4.4", B3, 6 * 5, proven::exact_coefficient_ad),
            quote("F: b, c", "4.4", B3, 18 * 7, proven::exact_coefficient_bc)},
           coefficients},
          {{quote("F(t)", "NOTES 10", B3, 746, proven::value_vt)}, cubic_value},
          {{quote("cubic solver", "4.4, App. B", B3, 33492, nan, appendix)}, cubic_residual}};
}

/// The area, the height, a weight and its comparison: §4.4 for VT, §4.5 for EE.
std::vector<AuditRow> configuration_rows(Kind kind, std::string_view note = "") {
  if (kind == vt)
    return {quote("VT: N", "4.4", B2, 13, proven::normal, note),
            quote("VT: height test", "4.4", B2, 21, proven::height_vt, note),
            quote("VT: weight", "4.4", B4, 181, proven::weight, note),
            quote("VT: barycentric test", "4.4", B4, 565, proven::inside_vt, note)};
  return {quote("EE: N", "4.5", B2, 13, proven::normal, note),
          quote("EE: height test", "4.5", B2, 16, proven::height_ee, note),
          quote("EE: weight", "4.5", B4, 181, proven::weight, note),
          quote("EE: barycentric test", "4.5", B4, 362, proven::inside_ee, note)};
}

/// §4.4 and §4.5 for exact vectors; and §5.
Groups configuration_groups() {
  return {{configuration_rows(vt), exact_configuration<vt>},
          {configuration_rows(ee), exact_configuration<ee>},
          {{quote("EE: weight, far p", "4.5", B4, 181, proven::weight_far, beyond),
            quote("EE: barycentric test, far p", "4.5", B4, 362, proven::inside_ee_far, beyond)},
           far_configuration,
           2},
          {{quote("VE culling: spread of a weight", "5", "B^4 h", 9, nan)}, weight_spread}};
}

/// §4.4 and §4.5 with the rounding of the relative vectors, and `weight_error` of ccd/.
ConstantGroup rounded_configuration_group(Kind kind) {
  const double inside = kind == vt ? proven::inside_vt : proven::inside_ee_far;
  auto rows = configuration_rows(kind, vectors);
  rows.push_back(quote("weight_error", "ve_culling.hpp", B4, weight_error, inside, vectors));
  return {std::move(rows), kind == vt ? rounded_configuration<vt> : rounded_configuration<ee>, 1, kind};
}

/// The constants of ccd/ for F and B.
ConstantGroup rounded_cubic_group(Kind kind) {
  const double value = kind == vt ? proven::value_vt : proven::value_ee;
  const double bound = kind == vt ? proven::bound_vt : proven::bound_ee;
  return {{quote("F(t)", "ve_culling.hpp", B3, evaluation_error, value, vectors),
           quote("clearance", "cubic.hpp", B3, clearance_error, proven::clearance, vectors),
           quote("B", "motion.hpp", "B eps", bound_margin - bound_needs, bound, vectors)},
          kind == vt ? rounded_cubic<vt> : rounded_cubic<ee>,
          1,
          kind};
}

/// A row whose constant is computed from others, not read from samples.
AuditRow follows(AuditRow row, double value) {
  row.derived = value;
  row.seen = nan;
  return row;
}

}  // namespace

std::vector<ConstantGroup> constant_groups() {
  Groups all;
  for (const auto& section : {vertex_vertex_groups(), vertex_edge_groups(), edge_solver_groups(),
                              cubic_groups(), configuration_groups()})
    all.insert(all.end(), section.begin(), section.end());
  for (const Kind kind : kinds) all.push_back(rounded_configuration_group(kind));
  for (const Kind kind : kinds) all.push_back(rounded_cubic_group(kind));
  return all;
}

std::vector<AuditRow> consequences(const std::vector<AuditRow>& rows) {
  const auto derived = [&](std::string_view name) {
    return std::find_if(rows.begin(), rows.end(), [&](const AuditRow& row) { return row.name == name; })
        ->derived;
  };
  const double near = derived("EE: barycentric test");
  const double far = derived("EE: barycentric test, far p");
  return {follows(quote("VV: quotient", "4.2", "eps (B/b + 1)", 10, nan), derived("VV: n = v.v")),
          follows(quote("VV: distance", "4.2", "B eps^1/2", 25, nan), std::sqrt(2.0 * 311)),
          follows(quote("VE: psi over lambda", "4.3", "B eps^1/4", 16, nan), 725 / std::sqrt(2080.0)),
          follows(quote("VE: lambda^2 over 4", "4.3", B2_root, 522, nan), (2080 + 22 * std::sqrt(eps)) / 4),
          follows(quote("VT: height test over E", "4.4", "B eps^1/2", 4, nan), 21 / (21.0 / 4)),
          follows(quote("EE: height test over E", "4.5", "B eps^1/2", 4, nan), 16 / 4.0),
          follows(quote("VT: distance from an edge line", "4.4", line, 1130, 2 * proven::inside_vt),
                  2 * derived("VT: barycentric test")),
          follows(quote("EE: distance from an edge line", "4.5", line, 724, 2 * proven::inside_ee), 2 * near),
          follows(quote("EE: distance from an edge line, far p", "4.5", line, 724, 2 * proven::inside_ee_far,
                        beyond),
                  2 * far),
          follows(quote("EE: distance of a false positive", "4.5.1", line, 1448, 4 * proven::inside_ee),
                  4 * near),
          follows(quote("EE: distance of a false positive, far p", "4.5.1", line, 1448,
                        4 * proven::inside_ee_far, beyond),
                  4 * far),
          follows(quote("distance bound", "4.4.1", "B eps^1/4", 41, nan), std::sqrt(34.0 * 34 + 522)),
          follows(quote("critical points", "ve_culling.hpp", B3, node_error, nan, "derived in cubic.hpp"),
                  3 * 18)};
}

}  // namespace nearmiss::audit_parts

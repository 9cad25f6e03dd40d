#include "fuzz/studies/audit/audit.hpp"

#include <algorithm>
#include <functional>
#include <optional>

#include "ccd/proven.hpp"
#include "ccd/ve_culling.hpp"
#include "fuzz/families/families.hpp"
#include "fuzz/studies/audit/readings.hpp"

namespace nearmiss {

namespace {

using namespace audit_parts;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double eps = epsilon<double>();
constexpr Kind vt = Kind::vertex_triangle;
constexpr Kind ee = Kind::edge_edge;

struct Group {
  std::vector<AuditRow> rows;
  std::function<Readings(const Sample&)> read;
  double reach = 1;            ///< of p, in the hill climb
  std::optional<Kind> kind{};  ///< rows about the rounding of relative vectors: of queries of this kind alone
};

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

constexpr std::string_view beyond = "relative positions of edges are within 2B (§4.1 has B)";
constexpr std::string_view vectors = "with the rounding of relative vectors (§5), to nearest";
constexpr std::string_view appendix = "the paper's appendix is missing; derived in ccd/";

std::vector<Group> groups() {
  const auto B2 = "B^2 eps";
  const auto B3 = "B^3 eps";
  const auto B4 = "B^4 eps";
  std::vector<Group> all;
  all.push_back({{quote("VV: m = x.v", "4.2", B2, 3 * 3, proven::dot),
                  quote("VV: n = v.v", "4.2", B2, 3 * 3, proven::dot),
                  quote("VV: time", "4.2", "eps (B/b + 1)", 12, nan),
                  quote("VV: squared distance moved", "4.2", B2, 289, nan),
                  quote("VV: delta", "4.2", B2, 311, proven::delta)},
                 vertex_vertex_time});
  all.push_back({{quote("VV of EE: delta", "4.2", B2, 311, proven::delta_far, beyond)}, far_vertices, 2});
  all.push_back({{quote("VE: squared length", "4.3", B2, 22, proven::length2),
                  quote("VE: weight", "4.3", B2, 22, proven::weight_ve),
                  quote("VE: barycentric test", "4.3", B2, 44, proven::inside_ve),
                  quote("VE: F_0ij", "4.3", B2, nan, proven::F_ve, "not quoted")},
                 near_edge});
  all.push_back({{quote("VE of EE: squared length", "4.3", B2, 22, proven::length2),
                  quote("VE of EE: weight", "4.3", B2, 22, proven::weight_ve_far, beyond),
                  quote("VE of EE: barycentric test", "4.3", B2, 44, proven::inside_ve_far, beyond),
                  quote("VE of EE: F_0ij", "4.3", B2, nan, proven::F_ve_far, "not quoted")},
                 near_edge,
                 2});
  all.push_back({{quote("VE: residual of case 4", "App. A", B2, nan, nan, appendix)}, quadratic_residual});
  all.push_back(
      {{quote("VE of EE: residual of case 4", "App. A", B2, nan, nan, appendix)}, quadratic_residual, 2});
  all.push_back({{quote("VE: G of case 4", "4.3, App. C", "B^2 eps^1/2", 688, nan, appendix),
                  quote("VE: psi", "4.3, App. C", "B^2 eps^1/2", 725, nan, appendix)},
                 missed_minimum});
  all.push_back({{quote("VE of EE: G of case 4", "4.3, App. C", "B^2 eps^1/2", 688, nan, appendix),
                  quote("VE of EE: psi", "4.3, App. C", "B^2 eps^1/2", 725, nan, appendix)},
                 missed_minimum,
                 2});
  all.push_back({{quote("F: a, d", "4.4", B3, 6 * 5, proven::exact_coefficient_ad),
                  quote("F: b, c", "4.4", B3, 18 * 7, proven::exact_coefficient_bc)},
                 coefficients});
  all.push_back({{quote("F(t)", "NOTES 10", B3, 746, proven::value_vt)}, cubic_value});
  all.push_back({{quote("cubic solver", "4.4, App. B", B3, 33492, nan, appendix)}, cubic_residual});
  all.push_back({{quote("VT: N", "4.4", B2, 13, proven::normal),
                  quote("VT: height test", "4.4", B2, 21, proven::height_vt),
                  quote("VT: weight", "4.4", B4, 181, proven::weight),
                  quote("VT: barycentric test", "4.4", B4, 565, proven::inside_vt)},
                 exact_configuration<vt>});
  all.push_back({{quote("EE: N", "4.5", B2, 13, proven::normal),
                  quote("EE: height test", "4.5", B2, 16, proven::height_ee),
                  quote("EE: weight", "4.5", B4, 181, proven::weight),
                  quote("EE: barycentric test", "4.5", B4, 362, proven::inside_ee)},
                 exact_configuration<ee>});
  all.push_back({{quote("EE: weight, far p", "4.5", B4, 181, proven::weight_far, beyond),
                  quote("EE: barycentric test, far p", "4.5", B4, 362, proven::inside_ee_far, beyond)},
                 far_configuration,
                 2});
  all.push_back({{quote("VE culling: spread of a weight", "5", "B^4 h", 9, nan)}, weight_spread});
  all.push_back({{quote("VT: N", "4.4", B2, 13, proven::normal, vectors),
                  quote("VT: height test", "4.4", B2, 21, proven::height_vt, vectors),
                  quote("VT: weight", "4.4", B4, 181, proven::weight, vectors),
                  quote("VT: barycentric test", "4.4", B4, 565, proven::inside_vt, vectors),
                  quote("weight_error", "ve_culling.hpp", B4, weight_error, proven::inside_vt, vectors)},
                 rounded_configuration<vt>,
                 1,
                 vt});
  all.push_back({{quote("EE: N", "4.5", B2, 13, proven::normal, vectors),
                  quote("EE: height test", "4.5", B2, 16, proven::height_ee, vectors),
                  quote("EE: weight", "4.5", B4, 181, proven::weight, vectors),
                  quote("EE: barycentric test", "4.5", B4, 362, proven::inside_ee, vectors),
                  quote("weight_error", "ve_culling.hpp", B4, weight_error, proven::inside_ee_far, vectors)},
                 rounded_configuration<ee>,
                 1,
                 ee});
  const auto ours = [&](Kind kind, const auto& read) {
    const double value = kind == vt ? proven::value_vt : proven::value_ee;
    all.push_back({{quote("F(t)", "ve_culling.hpp", B3, evaluation_error, value, vectors),
                    quote("clearance", "cubic.hpp", B3, clearance_error, proven::clearance, vectors),
                    quote("B", "motion.hpp", "B eps", bound_margin - bound_needs,
                          kind == vt ? proven::bound_vt : proven::bound_ee, vectors)},
                   read,
                   1,
                   kind});
  };
  ours(vt, rounded_cubic<vt>);
  ours(ee, rounded_cubic<ee>);
  return all;
}

/// Numbers that follow from others, as the paper has them.
std::vector<AuditRow> consequences(const std::vector<AuditRow>& rows) {
  const auto derived = [&](std::string_view name) {
    return std::find_if(rows.begin(), rows.end(), [&](const AuditRow& row) { return row.name == name; })
        ->derived;
  };
  std::vector<AuditRow> all;
  const auto follows = [&](const AuditRow& row, double value) {
    all.push_back(row);
    all.back().derived = value;
    all.back().seen = nan;
  };
  const auto line = "B^4 eps / (eta N)";
  follows(quote("VV: quotient", "4.2", "eps (B/b + 1)", 10, nan), derived("VV: n = v.v"));
  follows(quote("VV: distance", "4.2", "B eps^1/2", 25, nan), std::sqrt(2.0 * 311));
  follows(quote("VE: psi over lambda", "4.3", "B eps^1/4", 16, nan), 725 / std::sqrt(2080.0));
  follows(quote("VE: lambda^2 over 4", "4.3", "B^2 eps^1/2", 522, nan), (2080 + 22 * std::sqrt(eps)) / 4);
  follows(quote("VT: height test over E", "4.4", "B eps^1/2", 4, nan), 21 / (21.0 / 4));
  follows(quote("EE: height test over E", "4.5", "B eps^1/2", 4, nan), 16 / 4.0);
  follows(quote("VT: distance from an edge line", "4.4", line, 1130, 2 * proven::inside_vt),
          2 * derived("VT: barycentric test"));
  const double near = derived("EE: barycentric test");
  const double far = derived("EE: barycentric test, far p");
  follows(quote("EE: distance from an edge line", "4.5", line, 724, 2 * proven::inside_ee), 2 * near);
  follows(quote("EE: distance from an edge line, far p", "4.5", line, 724, 2 * proven::inside_ee_far, beyond),
          2 * far);
  follows(quote("EE: distance of a false positive", "4.5.1", line, 1448, 4 * proven::inside_ee), 4 * near);
  follows(quote("EE: distance of a false positive, far p", "4.5.1", line, 1448, 4 * proven::inside_ee_far,
                beyond),
          4 * far);
  follows(quote("distance bound", "4.4.1", "B eps^1/4", 41, nan), std::sqrt(34.0 * 34 + 522));
  follows(quote("critical points", "ve_culling.hpp", "B^3 eps", node_error, nan, "derived in cubic.hpp"),
          3 * 18);
  return all;
}

void take(std::vector<AuditRow>& rows, const Readings& readings) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    AuditRow& row = rows[i];
    const Reading& one = readings.at(i);
    if (!(one.derived <= row.derived)) {
      row.derived = one.derived;
      row.bound = one.bound;
    }
    row.seen = std::max(row.seen, one.seen);
    if (one.by_the_rules && one.seen > one.derived) ++row.violations;
  }
}

/// In rounds: from the best of some samples, by small steps, to where one row's error is large.
void climb(Group& group, std::size_t row, const AuditPlan& plan, Random& random) {
  const int round = std::max(1000, plan.steps / 6);
  Sample best;
  double seen = -1;
  for (int i = 0; i < plan.steps; ++i) {
    if (i % round == 0) seen = -1;
    const bool start = i % round < round / 4;
    const Sample next = start ? draw_sample(random, group.reach) : changed(random, best);
    const Readings readings = group.read(next);
    take(group.rows, readings);
    if (readings.at(row).seen < seen) continue;
    seen = readings[row].seen;
    best = next;
  }
}

}  // namespace

std::vector<AuditRow> audit(const AuditPlan& plan) {
  std::vector<Group> all = groups();
  for (const Family& family : families()) {
    for (int i = 0; i < plan.queries; ++i) {
      const Query query = make_query(family, plan.seed, static_cast<std::uint64_t>(i));
      Random random(plan.seed, 1, static_cast<std::uint64_t>(i));
      const auto sample = sample_of(query, random);
      if (!sample) continue;
      for (Group& group : all)
        if (!group.kind || *group.kind == query.kind) take(group.rows, group.read(*sample));
    }
  }
  std::vector<AuditRow> rows;
  for (std::size_t g = 0; g < all.size(); ++g) {
    Group& group = all[g];
    for (std::size_t row = 0; row < group.rows.size() && !group.kind; ++row) {
      Random random(plan.seed, 2 + g, row);
      climb(group, row, plan, random);
    }
    rows.insert(rows.end(), group.rows.begin(), group.rows.end());
  }
  const auto others = consequences(rows);
  rows.insert(rows.end(), others.begin(), others.end());
  return rows;
}

}  // namespace nearmiss

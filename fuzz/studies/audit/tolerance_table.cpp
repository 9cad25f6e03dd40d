#include "fuzz/studies/audit/tolerance_table.hpp"

#include <array>
#include <cmath>

namespace nearmiss {

namespace {

constexpr std::array<std::pair<int, std::string_view>, 16> known{{{-10, "11 bits (half)"},
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

std::string_view first_broken(const Tolerances<double>& tol, double E_vt, double E_ee,
                              const RoundingErrors<double>& errors) {
  for (const auto& each : constraints(tol, E_vt, E_ee, errors))
    if (!(each.more >= each.less)) return each.about;
  return "";
}

}  // namespace

std::vector<ToleranceRow> tolerance_table() {
  std::vector<ToleranceRow> rows;
  for (const auto& [exponent, scalars] : known) {
    const double eps = std::ldexp(1.0, exponent);
    const double e = std::sqrt(std::sqrt(eps));
    const auto paper = tolerances_of(closed_forms(exponent), eps, 1.0);
    const auto tight = tolerances_of(solve_tight(exponent), eps, 1.0);
    const double E = 4 * e * e;
    const auto full = full_errors(eps, paper.S, paper.rho);
    rows.push_back({.exponent = exponent,
                    .scalars = scalars,
                    .tight = solve_tight(exponent),
                    .paper_bound = paper.distance_bound() / e,
                    .tight_bound = tight.distance_bound() / e,
                    .relative_bound = tight.distance_bound(),
                    .paper_breaks = first_broken(paper, 21 * E / 16, E, full),
                    .printed_breaks = first_broken(paper, 21 * E / 16, E, printed_errors(eps))});
  }
  return rows;
}

}  // namespace nearmiss

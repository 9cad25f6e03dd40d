// Defects of tolerances that no hunt can find, because the constraints of ccd/wang/bounds/constraints.hpp
// hold in spite of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "ccd/wang/bounds/constraints.hpp"
#include "fuzz/subjects/defects.hpp"

namespace nearmiss {
namespace {

constexpr double eps = epsilon<double>();

Tolerances<double> changed(const NamedTolerance& tolerance, double factor) {
  Tolerances<double> tol = paper_tolerances(1.0);
  tol.*tolerance.value *= factor;
  return tol;
}

/// Moves as much of δ into D² as the constraints allow. No answer changes: VV uses only the sum of both.
Tolerances<double> with_least_delta(Tolerances<double> tol) {
  const double least = full_errors(eps, tol.S, tol.rho).delta;
  tol.D2 += tol.delta - least;
  tol.delta = least;
  return tol;
}

/// Whether the constraints, with two refinements, show that the tolerances miss nothing:
/// - The collisions that VE must report are those within s/√8 of an edge, for any s <= S. At such a time t_E,
///   F_0ij with S is at most (s - S) ‖e‖∞, and ‖e‖∞ >= λ/√3 unless the edge is short. So F_0ij is at most
///   `path` from t_E to the candidate.
/// - On this path, `path` takes the place of ψ in the distance from the edge.
bool misses_nothing(const Tolerances<double>& given, double s) {
  const Tolerances<double> tol = with_least_delta(given);
  const auto errors = full_errors(eps, tol.S, tol.rho);
  const double path = errors.least_psi - (tol.S - s) * std::sqrt((tol.lambda2 - errors.length2) / 3);
  if (tol.psi < path) return false;
  Tolerances<double> nearer = tol;
  nearer.S = s;
  nearer.psi = errors.least_psi;
  const double r = (tol.mu + errors.residual) / (tol.tau - errors.area);
  const double E = 2 * std::sqrt(std::max(s * s / 8 - r * r, 0.0)) * (1 - 0x1p-40);
  for (const auto& each : constraints(nearer, E, E, errors)) {
    if (each.about.starts_with("false positive")) continue;
    double less = each.less;
    const auto at = [&](double length2, double F) { return std::pow(tol.S + F / std::sqrt(length2), 2); };
    const double longer2 = tol.lambda2 + errors.length2;
    const double shorter2 = tol.lambda2 - errors.length2;
    if (each.about == "VE: edge becomes short") less = longer2 / 4 + at(longer2, path);
    if (each.about == "VE: weight, and its false positives")
      less = std::pow(errors.weight_ve, 2) / shorter2 + at(shorter2, std::max(path + errors.F, 0.0));
    if (!(each.more >= less)) return false;
  }
  return true;
}

/// Whether, with these tolerances, every reported pair is within the bound of the sound subject.
bool stays_within_the_bound(const Tolerances<double>& tol) {
  const auto errors = full_errors(eps, tol.S, tol.rho);
  const auto sound = paper_tolerances(1.0);
  const double bound2 = sound.D2 + 2 * sound.delta;
  if (!(tol.lambda2 > errors.length2) || !(tol.tau > errors.area) || !(tol.eta > 0)) return false;
  for (const auto& each : constraints(tol, 1.0, 1.0, errors)) {
    const bool is_of_false_positives = each.about.find("false positive") != std::string_view::npos;
    if (is_of_false_positives && !(bound2 >= each.less)) return false;
  }
  return true;
}

/// Whether a tolerance that is `factor` times as large can only make tests accept more pairs. Nothing else
/// depends on it: culling in vertex-edge is sound for any values of the other tolerances.
bool accepts_more(const NamedTolerance& tolerance, double factor) {
  const std::set<std::string_view> excluding{"lambda2", "tau", "eta"};
  return factor < 1 && excluding.contains(tolerance.name);
}

bool is_harmless(const NamedTolerance& tolerance, double factor) {
  const Tolerances<double> tol = changed(tolerance, factor);
  bool complete = accepts_more(tolerance, factor);
  for (int i = 1; i <= 100 && !complete; ++i) complete = misses_nothing(tol, tol.S * i / 100);
  return complete && stays_within_the_bound(tol);
}

TEST(HarmlessDefects, AreThoseForWhichTheConstraintsHold) {
  std::set<std::string> harmless;
  for (const Defect& defect : defects())
    for (const NamedTolerance& tolerance : named_tolerances())
      for (const double factor : {0.0, 0.01, 0.1, 0.5, 10.0, 100.0})
        if (defect.name == scaled_tolerance(tolerance.name, factor) && is_harmless(tolerance, factor))
          harmless.insert(defect.name.substr(7));
  EXPECT_EQ(harmless, (std::set<std::string>{"delta*0.5", "delta*0.1", "delta*0.01",  "delta*0", "D2*0.5",
                                             "rho*0.5",   "rho*0.1",   "rho*0.01",    "rho*0",   "rho*10",
                                             "psi*0.5",   "psi*0.1",   "psi*0.01",    "psi*0",   "mu*0.5",
                                             "mu*0.1",    "mu*0.01",   "lambda2*0.5", "tau*0.5", "eta*0.5"}));
}

}  // namespace
}  // namespace nearmiss

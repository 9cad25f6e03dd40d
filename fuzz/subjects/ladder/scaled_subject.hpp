// The subjects basic, wang and wang-tight in any scalar. Only the files that define scalars include this
// header, because its templates are slow to compile.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "ccd/query/arithmetic.hpp"
#include "ccd/wang/basic.hpp"
#include "ccd/wang/bounds/tight_tolerances.hpp"
#include "ccd/wang/loosened.hpp"
#include "ccd/wang/pair_bound.hpp"
#include "ccd/wang/wang.hpp"
#include "ccd/wang/within.hpp"
#include "fuzz/subjects/ladder/scalars.hpp"

namespace nearmiss::ladder {

/// The tolerances that the paper gives, or, if `smallest` is set, the smallest tolerances that are valid.
struct EitherTolerances {
  std::optional<ToleranceConstants> smallest;

  template <class T>
  [[nodiscard]] Tolerances<T> operator()(const T& B) const {
    return smallest ? tolerances_of(*smallest, epsilon<T>(), B) : paper_tolerances(B);
  }
  template <class T>
  [[nodiscard]] Tolerances<T> of_vertices(const T& B, const T& R) const {
    return PaperTolerances().of_vertices(B, R);
  }
  template <class T>
  [[nodiscard]] Tolerances<T> of_edge(const T& B, const T& R) const {
    return smallest ? tight_tolerances_of_edge((*this)(B), B, R) : PaperTolerances().of_edge(B, R);
  }
};

/// While an object of this type exists, the processor's arithmetic is plain (ccd/query/arithmetic.hpp). This
/// type is for scalars whose operations the processor computes.
struct MachineArithmetic {
  explicit MachineArithmetic(int /*epsilon_exponent*/) {}
  PlainArithmetic guard;
};

/// basic, wang or wang-tight in T, except that normals and weights are computed in Wide. Each call constructs
/// an Arithmetic(exponent of ε), which sets precision and rounding until the call returns. If T has fewer
/// digits than a double, the subject rounds coordinates to T, and decides the rounded query.
template <class T, class Arithmetic, class Wide>
class Scaled final : public Subject {
 public:
  Scaled(std::string_view name, int epsilon_exponent, Algorithm algorithm, std::optional<double> given)
      : name_(name),
        epsilon_exponent_(epsilon_exponent),
        algorithm_(algorithm),
        given_(given),
        narrow_(1 - epsilon_exponent < std::numeric_limits<double>::digits),
        largest_(
            std::ldexp(1 - std::ldexp(0.5, epsilon_exponent), std::numeric_limits<double>::max_exponent)) {
    if (algorithm == Algorithm::wang_tight) tolerances_.smallest = solve_tight(epsilon_exponent);
  }

  [[nodiscard]] const std::string& name() const override { return name_; }

  using Subject::decide;
  [[nodiscard]] Verdict decide(const Query& query) const override {
    if (!is_finite(query)) refuse_coordinates(name_);
    const Arithmetic arithmetic(epsilon_exponent_);
    return decide(query, tolerances_);
  }

  [[nodiscard]] double distance_bound(const Query& query) const override {
    if (!claims_bound()) return std::numeric_limits<double>::infinity();
    const Arithmetic arithmetic(epsilon_exponent_);
    if (!is_of_meshes(query.kind)) {
      const Seen seen = as_seen(query);
      const double bound =
          within_distance_bound<EitherTolerances, T>(seen.query, given_in(seen), tolerances_);
      return std::nextafter(std::ldexp(bound, -seen.exponent), std::numeric_limits<double>::infinity());
    }
    // The bound that this function returns is rounded up. The subject computes B, the size of the pair, in T,
    // with rounding errors: the computed B is at most (1 + 40ε) times the exact B. The margin `slack` covers
    // this factor.
    const double bound = static_cast<double>(tolerances_(T(1)).distance_bound());
    const double slack = 1 + 64 * std::ldexp(1, epsilon_exponent_);
    const double B = given_.value_or(pair_bound(rounded(query)));
    return std::nextafter(bound * slack * B, std::numeric_limits<double>::infinity());
  }

  [[nodiscard]] bool claims_bound() const override { return algorithm_ != Algorithm::basic; }
  [[nodiscard]] bool decides(Kind kind) const override {
    return is_of_meshes(kind) || algorithm_ != Algorithm::basic;
  }
  [[nodiscard]] bool takes_separation(Kind kind) const override {
    return !is_of_meshes(kind) && decides(kind);
  }

  [[nodiscard]] TimeSort time_sort() const override {
    return algorithm_ == Algorithm::basic ? TimeSort::estimate : TimeSort::none;
  }

  [[nodiscard]] double needed_tolerance(const Query& query) const override {
    if (algorithm_ == Algorithm::basic) return std::numeric_limits<double>::quiet_NaN();
    const Arithmetic arithmetic(epsilon_exponent_);
    return least_loosening([&](double s) {
      return decide(query, Loosened<EitherTolerances>{tolerances_, s}).hit;
    });
  }

  [[nodiscard]] bool rounds() const override { return narrow_; }

  [[nodiscard]] Query rounded(const Query& query) const override {
    const Arithmetic arithmetic(epsilon_exponent_);
    Seen seen = as_seen(query);
    for (double& c : seen.query.x) c = std::ldexp(c, -seen.exponent);
    seen.query.separation = std::ldexp(seen.query.separation, -seen.exponent);
    return seen.query;
  }

 private:
  static constexpr WangOptions options{true, VeCulling::per_root};

  template <class Rule>
  [[nodiscard]] Verdict decide(const Query& query, const Rule& tolerances) const {
    const Seen seen = as_seen(query);
    const std::optional<double> given = given_in(seen);
    if (!is_of_meshes(query.kind))
      return wang_within<T>(seen.query, options.plane_culling, given, tolerances);
    return with_kind(query.kind, [&]<Kind kind>() {
      return algorithm_ == Algorithm::basic
                 ? basic<kind, T, true, Wide>(seen.query)
                 : wang<kind, T, options, Rule, Wide>(seen.query, given, tolerances);
    });
  }

  struct Seen {
    Query query;
    int exponent = 0;
  };

  /// The bound on the size of pairs that was given to the subject, in the unit of a scaled query; nothing if
  /// no bound was given.
  [[nodiscard]] std::optional<double> given_in(const Seen& seen) const {
    return given_ ? std::optional(std::ldexp(*given_, seen.exponent)) : std::nullopt;
  }

  /// The query with coordinates and separation rounded to T. For float, whose range is smaller than the range
  /// of double, these numbers are first scaled by 2^exponent. If the absolute value of a coordinate would
  /// round to 2^1024, the coordinate is rounded towards zero instead.
  [[nodiscard]] Seen as_seen(const Query& query) const {
    if (!narrow_) return {query, 0};
    int exponent = 0;
    if constexpr (std::is_same_v<T, float>) {
      double largest = 0;
      for (const double c : query.x) largest = std::max(largest, std::abs(c));
      if (largest > 0) exponent = -std::ilogb(largest);
    }
    const double most = std::ldexp(largest_, exponent);
    Query seen = query;
    const auto round = [&](double& c) {
      c = std::clamp(static_cast<double>(static_cast<T>(std::ldexp(c, exponent))), -most, most);
    };
    for (double& c : seen.x) round(c);
    round(seen.separation);
    return {seen, exponent};
  }

  std::string name_;
  int epsilon_exponent_;
  Algorithm algorithm_;
  std::optional<double> given_;
  bool narrow_;
  double largest_;  ///< if narrow_: the largest double that has no more digits than T
  EitherTolerances tolerances_;
};

template <class T, class Arithmetic = MachineArithmetic, class Wide = T>
std::unique_ptr<Subject> make_scaled(std::string_view name, int epsilon_exponent, Algorithm algorithm,
                                     std::optional<double> given) {
  return std::make_unique<Scaled<T, Arithmetic, Wide>>(name, epsilon_exponent, algorithm, given);
}

}  // namespace nearmiss::ladder

// Two points that are within h of each other at a rational time prove that the primitives come within h. Without a
// separation, the time may be irrational. Then either the four vertices become coplanar while all weights are positive,
// or the contact is that of a vertex and the inside of an edge (tools/certificates/README.md says why).
#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "oracle/certificates/certificate.hpp"
#include "oracle/certificates/closest_exactly.hpp"
#include "oracle/certificates/positive.hpp"
#include "oracle/certificates/text.hpp"
#include "oracle/exact/first_approach.hpp"
#include "oracle/exact/first_contact.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {

namespace {

using namespace certificates;
using exact::Number;
using exact::OnInterval;
using exact::Polynomial;
using exact::PolynomialVector;
using exact::Root;

template <class Real>
std::array<Point<Real>, 4> positions(const Query& query, const Real& t) {
  std::array<Point<Real>, 4> x;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      x[i][k] = (1 - t) * Real(query.x[3 * i + k]) + t * Real(query.x[12 + 3 * i + k]);
  return x;
}

class Meeting {
 public:
  Meeting(const Query& query, const Span& span, bool is_strict)
      : query_(query),
        span_(span),
        is_strict_(is_strict),
        squared_h_(mpq_class(query.separation) * mpq_class(query.separation)) {}

  /// The proof that the primitives come within h at t. It has points that are about the closest ones if these are
  /// near enough, because their weights need fewer digits.
  [[nodiscard]] std::optional<std::string> at(const mpq_class& t) const {
    if (t < mpq_class(span_.from) || t > mpq_class(span_.to)) return std::nullopt;
    const auto x = positions<mpq_class>(query_, t);
    if (query_.separation > 0)
      if (const auto weights = shortened(about_closest(t.get_d()), {3, 8, 20, 50}, x))
        return text_at(t, *weights);
    const ClosestWeights<mpq_class> closest(query_.kind, x);
    if (!is_within(closest.squared_distance())) return std::nullopt;
    return text_at(t, shortened(closest.weights(), {50, 200, 1000}, x).value_or(closest.weights()));
  }

  [[nodiscard]] std::optional<std::string> at(double t) const {
    return std::isfinite(t) ? at(mpq_class(t)) : std::nullopt;
  }

  /// The proof that the vertices become coplanar in [p, q] while all weights are positive.
  [[nodiscard]] std::optional<std::string> bracket(const Number& p, const Number& q) {
    if (p < Number(span_.from) || q > Number(span_.to) || !is_bracket(p, q)) return std::nullopt;
    return heading(query_, "meets", span_) + R"(,"bracket":[)" + quoted(certificates::to_text(p)) + "," +
           quoted(certificates::to_text(q)) + "]}";
  }

  /// The shortest such proof for an interval of which [p, q] is a part.
  [[nodiscard]] std::optional<std::string> wide_bracket(const Enclosure& known) {
    for (const int bits : {3, 6, 10, 15, 21, 28, 36, 44}) {
      const double lo = std::max(std::ldexp(std::floor(std::ldexp(known.lo, bits)), -bits), span_.from);
      const double hi = std::min(std::ldexp(std::ceil(std::ldexp(known.hi, bits)), -bits), span_.to);
      if (lo < hi)
        if (auto text = bracket(lo, hi)) return text;
    }
    return bracket(known.lo, known.hi);
  }

  /// Any proof for a query with h = 0 that has a contact.
  [[nodiscard]] std::optional<std::string> of_contact() {
    exact::Predicates predicates(query_);
    auto contact = exact::first_contact(predicates);
    if (!contact) return std::nullopt;
    Root& time = contact->time;
    if (const auto rational = time.as_rational()) return at(mpq_class(rational->mpq()));
    for (int i = 0; i < most_refinements; ++i, time.refine()) {
      if (time.lo() < span_.from || time.hi() > span_.to || !(time.lo() < time.hi())) continue;
      if (auto text = bracket(time.lo(), time.hi())) return text;
      if (auto text = edge_bracket(time.lo(), time.hi())) return text;
    }
    return std::nullopt;
  }

 private:
  static constexpr int most_refinements = 40;

  [[nodiscard]] bool is_within(const mpq_class& squared_distance) const {
    return is_strict_ ? squared_distance < squared_h_ : squared_distance <= squared_h_;
  }

  /// Weights of points that are about closest; not numbers after overflow, which `shortened` refuses.
  [[nodiscard]] WeightsOfPoints<double> about_closest(double t) const {
    const auto x = positions<double>(query_, t);
    return ClosestWeights<double>(query_.kind, x).weights();
  }

  /// The weights rounded to the first of these numbers of bits with which the points are within h.
  template <class Real>
  [[nodiscard]] std::optional<WeightsOfPoints<mpq_class>> shortened(
      const WeightsOfPoints<Real>& weights, std::initializer_list<unsigned> bits,
      const std::array<Point<mpq_class>, 4>& x) const {
    if (!std::ranges::all_of(weights, [](const Real& each) { return each >= 0 && each <= 1; }))
      return std::nullopt;
    for (const unsigned each : bits) {
      const auto rounded = rounded_weights(weights, each);
      if (rounded && is_within(squared_distance(query_.kind, x, *rounded))) return rounded;
    }
    return std::nullopt;
  }

  /// Multiples of 2^-bits that add up to 1 for each primitive; nothing if one of them would be negative.
  template <class Real>
  [[nodiscard]] std::optional<WeightsOfPoints<mpq_class>> rounded_weights(
      const WeightsOfPoints<Real>& weights, unsigned bits) const {
    WeightsOfPoints<mpq_class> result;
    const auto vertices = static_cast<std::size_t>(split(query_.kind));
    for (const auto& [first, last] :
         {std::pair{std::size_t{0}, vertices - 1}, std::pair{vertices, std::size_t{3}}}) {
      mpq_class rest = 1;
      for (std::size_t i = first; i < last; ++i) {
        const mpq_class scaled = (mpq_class(weights[i]) << bits) + mpq_class(1, 2);
        result[i] = mpq_class(mpz_class(scaled)) >> bits;
        rest -= result[i];
      }
      if (rest < 0) return std::nullopt;
      result[last] = rest;
    }
    return result;
  }

  [[nodiscard]] std::string text_at(const mpq_class& t, const WeightsOfPoints<mpq_class>& weights) const {
    const auto number = [](const mpq_class& x) { return quoted(x.get_str()); };
    return heading(query_, "meets", span_) + (is_strict_ ? R"(,"strict":true)" : "") + R"(,"at":)" +
           number(t) + R"(,"weights":)" + list(weights, number) + "}";
  }

  [[nodiscard]] bool is_bracket(const Number& p, const Number& q) {
    if (!normal_) make_polynomials();
    return normal_->sign_at(p) * normal_->sign_at(q) <= 0 &&
           std::all_of(inside_.begin(), inside_.end(),
                       [&](const Polynomial& each) { return is_positive(each, p, q); });
  }

  /// F, and what is positive in a bracket.
  void make_polynomials() {
    const exact::Unit unit(query_);
    const auto x = moving_points(query_, unit);
    const bool has_triangle_ = has_triangle(query_.kind);
    const PolynomialVector N =
        has_triangle_ ? cross(x[2] - x[1], x[3] - x[1]) : cross(x[1] - x[0], x[3] - x[2]);
    const Polynomial whole = dot(N, N);
    inside_ = {whole};
    if (has_triangle_) {
      normal_ = dot(N, x[0] - x[1]);
      for (const auto& [j, k] : {std::pair{2, 3}, std::pair{3, 1}, std::pair{1, 2}})
        inside_.push_back(
            dot(N, cross(x[static_cast<std::size_t>(j)] - x[0], x[static_cast<std::size_t>(k)] - x[0])));
    } else {
      const PolynomialVector r = x[2] - x[0];
      normal_ = dot(N, r);
      for (const PolynomialVector& other : {x[3] - x[2], x[1] - x[0]}) {
        const Polynomial weight = dot(N, cross(r, other));
        inside_.push_back(weight);
        inside_.push_back(whole - weight);
      }
    }
  }

  /// The proof that a vertex is inside an edge at a time in [p, q].
  [[nodiscard]] std::optional<std::string> edge_bracket(const Number& p, const Number& q) const {
    const exact::Unit unit(query_);
    const auto x = moving_points(query_, unit);
    for (const auto& [v, y, z] : topology(query_.kind).vertices_and_edges) {
      const PolynomialVector e = x[z] - x[y];
      const PolynomialVector area = cross(x[v] - x[y], e);
      if (!is_line_of_one_root(area, p, q)) continue;
      if (!is_positive(dot(x[v] - x[y], e), p, q) || !is_positive(dot(x[z] - x[v], e), p, q)) continue;
      const auto number = [](int i) { return quoted(std::to_string(i)); };
      return heading(query_, "meets", span_) + R"(,"bracket":[)" + quoted(certificates::to_text(p)) + "," +
             quoted(certificates::to_text(q)) + R"(],"edge":[)" + number(v) + "," + number(y) + "," +
             number(z) + "]}";
    }
    return std::nullopt;
  }

  /// Whether all components are multiples of one, which changes its sign.
  [[nodiscard]] static bool is_line_of_one_root(const PolynomialVector& area, const Number& p,
                                                const Number& q) {
    const Polynomial* one = nullptr;
    for (const Polynomial& each : area) {
      if (each.is_zero()) continue;
      if (one != nullptr && !are_proportional(*one, each)) return false;
      one = &each;
    }
    return one != nullptr && one->sign_at(p) * one->sign_at(q) < 0;
  }

  Query query_;
  Span span_;
  bool is_strict_;
  mpq_class squared_h_;
  std::optional<Polynomial> normal_;  ///< F; made on first use, as `inside_`
  std::vector<Polynomial> inside_;
};

constexpr unsigned most_bits_after = 5'000;  ///< of a time at which the distance is below h

std::optional<std::string> certify_contact(const Query& query, const Span& span) {
  Meeting meeting(query, span, false);
  if (span.from < span.to)
    if (auto text = meeting.bracket(span.from, span.to)) return text;
  if (const auto known = time_of_contact(query)) {
    if (known->is_between && known->time.lo < known->time.hi)
      if (auto text = meeting.wide_bracket(known->time)) return text;
    for (const double t : {known->time.lo, known->time.hi})
      if (auto text = meeting.at(t)) return text;
  }
  return meeting.of_contact();
}

std::optional<std::string> certify_approach(const Query& query, const Span& span, bool is_strict) {
  const Meeting meeting(query, span, is_strict);
  const KnownApproach known = known_approach(query);
  for (const double t : {span.from, std::round(known.time.hi * 16) / 16,
                         std::round(known.time.hi * 1024) / 1024, known.time.hi, span.to})
    if (auto text = meeting.at(t)) return text;
  auto approach = exact::first_approach(query);
  if (!approach) return std::nullopt;
  if (!is_strict)
    if (const auto rational = Root(approach->time).as_rational())
      return meeting.at(mpq_class(rational->mpq()));
  if (!approach->below) return std::nullopt;
  // The distance is below h right after this time: at the first, second or third next multiple of 2^-bits.
  Root below = *approach->below;
  for (unsigned bits = 4; bits < most_bits_after; bits *= 2) {
    while (exact::power_of_half(bits) < below.hi() - below.lo()) below.refine();
    const mpq_class scaled = mpq_class(CGAL::Gmpq(below.lo()).mpq()) << bits;
    for (const int next : {1, 2, 3})
      if (auto text = meeting.at(mpq_class(mpz_class(scaled) + next) >> bits)) return text;
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> certify_meets(const Query& query, const Span& span, bool is_strict) {
  const PlainArithmetic guard;
  return query.separation > 0 ? certify_approach(query, span, is_strict) : certify_contact(query, span);
}

std::optional<std::string> certify(const Query& query) {
  const Decision decision = decide(query);
  if (decision.is_tie) return certify_meets(query, {});
  return decision.collision ? certify_meets(query, {}, query.separation > 0) : certify_apart(query, {});
}

}  // namespace nearmiss

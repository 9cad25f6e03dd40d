// Two points that are within h of each other at a rational time prove that the primitives come within h. For
// h = 0, the time of contact may be irrational. Then either the four vertices become coplanar while all
// weights are positive, or a vertex touches the inside of an edge (tools/certificates/README.md says why).
#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "oracle/certificates/certificate.hpp"
#include "oracle/certificates/closest_exactly.hpp"
#include "oracle/certificates/positive.hpp"
#include "oracle/certificates/text.hpp"
#include "oracle/exact/first_approach.hpp"
#include "oracle/exact/first_contact.hpp"
#include "oracle/exact/nearness.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {

namespace {

using namespace certificates;
using exact::Number;
using exact::Polynomial;
using exact::PolynomialVector;
using exact::Root;

template <class Real>
std::array<Vec<Real>, 4> positions(const Query& query, const Real& t) {
  std::array<Vec<Real>, 4> x;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      x[i][k] = (1 - t) * Real(query.x[3 * i + k]) + t * Real(query.x[12 + 3 * i + k]);
  return x;
}

/// Whether a time is in a span.
template <class Time>
bool is_in(const Time& time, const Span& span) {
  return Time(span.from) <= time && (span.is_open ? time < Time(span.to) : time <= Time(span.to));
}

/// The heading of a proof that looks at no time after `last`. Its `to` is `last` if the span is open, else
/// the end of the span.
std::string heading_until(const std::string& last, const Query& query, const Span& span) {
  return heading(query, "meets", span.from, span.is_open ? last : certificates::to_text(Number(span.to)));
}

/// Two points that are within h of each other at a rational time.
class Meeting {
 public:
  Meeting(const Query& query, const Span& span, bool is_strict)
      : query_(query),
        span_(span),
        is_strict_(is_strict),
        squared_h_(mpq_class(query.separation) * mpq_class(query.separation)) {}

  /// The proof that the primitives come within h at t. If approximately closest points are near enough, it
  /// uses these, because their weights need fewer digits.
  [[nodiscard]] std::optional<std::string> at(const mpq_class& t) const {
    if (!is_in(t, span_)) return std::nullopt;
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

 private:
  [[nodiscard]] bool is_within(const mpq_class& squared_distance) const {
    return is_strict_ ? squared_distance < squared_h_ : squared_distance <= squared_h_;
  }

  /// Weights of approximately closest points. After overflow, they are not finite, and `shortened` refuses
  /// them.
  [[nodiscard]] WeightsOfPoints<double> about_closest(double t) const {
    const auto x = positions<double>(query_, t);
    return ClosestWeights<double>(query_.kind, x).weights();
  }

  /// The weights, rounded to the first number of bits in `bits` that brings the points within h.
  template <class Real>
  [[nodiscard]] std::optional<WeightsOfPoints<mpq_class>> shortened(
      const WeightsOfPoints<Real>& weights, std::initializer_list<unsigned> bits,
      const std::array<Vec<mpq_class>, 4>& x) const {
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
    const auto second = static_cast<std::size_t>(split(query_.kind));
    const auto end = static_cast<std::size_t>(vertices(query_.kind));
    for (const auto& [first, last] : {std::pair{std::size_t{0}, second - 1}, std::pair{second, end - 1}}) {
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

  [[nodiscard]] std::optional<std::string> text_at(const mpq_class& t,
                                                   const WeightsOfPoints<mpq_class>& weights) const {
    const auto number = [](const mpq_class& x) { return quoted(x.get_str()); };
    return if_short(heading_until(t.get_str(), query_, span_) + (is_strict_ ? R"(,"strict":true)" : "") +
                    R"(,"at":)" + number(t) + R"(,"weights":)" +
                    list(std::span(weights).first(static_cast<std::size_t>(vertices(query_.kind))), number) +
                    "}");
  }

  Query query_;
  Span span_;
  bool is_strict_;
  mpq_class squared_h_;
};

/// Contact at a time that may be irrational, for h = 0.
class Crossing {
 public:
  Crossing(const Query& query, const Span& span)
      : query_(query),
        span_(span),
        x_(moving_points(query, exact::Unit(query))),
        of_(interiors(query.kind, x_)) {}

  /// The proof that the vertices become coplanar in [p, q] while all weights are positive.
  [[nodiscard]] std::optional<std::string> bracket(const Number& p, const Number& q) const {
    const auto is_negative = [&](const Polynomial& each) { return is_positive(Polynomial() - each, p, q); };
    const bool is_proof = is_within_span(p, q) && of_.F.sign_at(p) * of_.F.sign_at(q) <= 0 &&
                          is_positive(of_.squared_N, p, q) && std::ranges::all_of(of_.outside, is_negative);
    return is_proof ? text(p, q) : std::nullopt;
  }

  /// The proof of bracket() for the interval with the fewest bits that contains `known`.
  [[nodiscard]] std::optional<std::string> wide_bracket(const Enclosure& known) const {
    for (const int bits : {3, 6, 10, 15, 21, 28, 36, 44}) {
      const double lo = std::max(std::ldexp(std::floor(std::ldexp(known.lo, bits)), -bits), span_.from);
      const double hi = std::min(std::ldexp(std::ceil(std::ldexp(known.hi, bits)), -bits), span_.to);
      if (auto text = bracket(lo, hi)) return text;
    }
    return bracket(known.lo, known.hi);
  }

  /// The proof that a vertex is inside an edge at a time in [p, q].
  [[nodiscard]] std::optional<std::string> edge_bracket(const Number& p, const Number& q) const {
    if (!is_within_span(p, q)) return std::nullopt;
    for (const auto& [v, y, z] : topology(query_.kind).vertices_and_edges) {
      const PolynomialVector e = x_[z] - x_[y];
      if (is_line_of_one_root(cross(x_[v] - x_[y], e), p, q) && is_positive(dot(x_[v] - x_[y], e), p, q) &&
          is_positive(dot(x_[z] - x_[v], e), p, q))
        return text(p, q, R"(,"edge":)" + list(std::array<int, 3>{v, y, z}, [](int i) {
                            return quoted(std::to_string(i));
                          }));
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] bool is_within_span(const Number& p, const Number& q) const {
    return is_in(p, span_) && is_in(q, span_) && p < q;
  }

  [[nodiscard]] std::optional<std::string> text(const Number& p, const Number& q,
                                                const std::string& edge = "") const {
    return if_short(heading_until(certificates::to_text(q), query_, span_) + R"(,"bracket":[)" +
                    quoted(certificates::to_text(p)) + "," + quoted(certificates::to_text(q)) + "]" + edge +
                    "}");
  }

  /// Whether all components of `area` are multiples of one polynomial that changes its sign from p to q.
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
  std::array<PolynomialVector, 4> x_;
  exact::Interiors of_;
};

/// Any proof of the first contact, for a time that exact arithmetic finds.
std::optional<std::string> certify_first_contact(const Query& query, const Span& span, const Meeting& meeting,
                                                 const Crossing& crossing) {
  constexpr int most_refinements = 40;
  exact::Predicates predicates(query);
  auto contact = exact::first_contact(predicates);
  if (!contact) return std::nullopt;
  Root& time = contact->time;
  if (const auto rational = time.as_rational()) return meeting.at(mpq_class(rational->mpq()));
  for (int i = 0; i < most_refinements; ++i, time.refine()) {
    const bool is_outside = time.hi() <= Number(span.from) || Number(span.to) <= time.lo();
    if (is_outside) return std::nullopt;
    if (auto text = crossing.bracket(time.lo(), time.hi())) return text;
    if (auto text = crossing.edge_bracket(time.lo(), time.hi())) return text;
  }
  return std::nullopt;
}

std::optional<std::string> certify_contact(const Query& query, const Span& span) {
  const Meeting meeting(query, span, false);
  const Crossing crossing(query, span);
  if (auto text = crossing.bracket(span.from, span.to)) return text;
  if (const auto known = time_of_contact(query)) {
    if (known->is_between)
      if (auto text = crossing.wide_bracket(known->time)) return text;
    for (const double t : {known->time.lo, known->time.hi})
      if (auto text = meeting.at(t)) return text;
  }
  return certify_first_contact(query, span, meeting, crossing);
}

/// A search for a proof gives up when its time is known to about this many bits.
constexpr unsigned most_bits = 5'000;

/// The proof that the distance is h: at the first such time if this is rational, or soon after it if the
/// distance stays at h.
std::optional<std::string> certify_touch(Root time, const Meeting& meeting) {
  if (const auto rational = time.as_rational()) return meeting.at(mpq_class(rational->mpq()));
  for (const Number least = exact::power_of_half(most_bits);; time.refine()) {
    if (auto text = meeting.at(mpq_class(CGAL::Gmpq(time.hi()).mpq()))) return text;
    if (time.hi() - time.lo() < least) return std::nullopt;
  }
}

/// The proof that the distance is below h right after a time: at the first, second or third next multiple of
/// 2^-bits.
std::optional<std::string> certify_below(Root after, const Meeting& meeting) {
  for (unsigned bits = 4; bits < most_bits; bits *= 2) {
    while (exact::power_of_half(bits) < after.hi() - after.lo()) after.refine();
    const mpq_class scaled = mpq_class(CGAL::Gmpq(after.lo()).mpq()) << bits;
    for (const int next : {1, 2, 3})
      if (auto text = meeting.at(mpq_class(mpz_class(scaled) + next) >> bits)) return text;
  }
  return std::nullopt;
}

std::optional<std::string> certify_approach(const Query& query, const Span& span, bool is_strict) {
  const Meeting meeting(query, span, is_strict);
  const KnownApproach known = known_approach(query);
  for (const double t : {span.from, std::round(known.time.hi * 16) / 16,
                         std::round(known.time.hi * 1024) / 1024, known.time.hi, span.to})
    if (auto text = meeting.at(t)) return text;
  auto approach = exact::first_approach(query);
  if (!approach) return std::nullopt;
  // If the distance falls below h, points near the closest ones prove that, too, with fewer digits.
  if (approach->below)
    if (auto text = certify_below(*approach->below, meeting)) return text;
  return is_strict ? std::nullopt : certify_touch(approach->time, meeting);
}

}  // namespace

std::optional<std::string> certify_meets(const Query& query, const Span& span, bool is_strict) {
  const PlainArithmetic guard;
  if (const double before = std::nextafter(span.to, 0); span.is_open && span.from <= before)
    if (auto text = certify_meets(query, {span.from, before}, is_strict)) return text;
  return query.separation > 0 ? certify_approach(query, span, is_strict) : certify_contact(query, span);
}

}  // namespace nearmiss

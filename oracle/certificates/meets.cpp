// The usual proof gives a rational time and a point of each primitive. At this time, the two points are at
// most h apart, where h is the separation. For h = 0, the time of contact may be irrational. Then one of two
// facts proves the contact: the four vertices become coplanar while all weights are positive, or a vertex
// passes through the inside of an edge (tools/certificates/README.md says why).
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

#include "oracle/arithmetic/ball.hpp"
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
using certified::Ball;
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

Ball<double> ball(const mpq_class& x) { return certified::ball_around(x.get_d()); }

template <class Time>
bool is_in(const Time& time, const Span& span) {
  return Time(span.from) <= time && (span.is_open ? time < Time(span.to) : time <= Time(span.to));
}

/// The beginning of a certificate whose proof uses no time after `last`. The value of the key "to" is `last`
/// if the span is open, else the end of the span.
std::string heading_until(const std::string& last, const Query& query, const Span& span) {
  return heading(query, "meets", span.from, span.is_open ? last : certificates::to_text(Number(span.to)));
}

/// Proofs by two points that are within h of each other at a rational time.
class Meeting {
 public:
  Meeting(const Query& query, const Span& span, bool is_strict)
      : query_(query),
        span_(span),
        is_strict_(is_strict),
        in_unit_(query),
        squared_h_(mpq_class(query.separation) * mpq_class(query.separation)) {
    double largest = 0;
    for (const double x : query.x) largest = std::max(largest, std::abs(x));
    const int exponent = largest > 0 ? std::ilogb(largest) : 0;
    for (double& x : in_unit_.x) x = std::ldexp(x, -exponent);
    in_unit_.separation = std::ldexp(query.separation, -exponent);
  }

  /// The proof that, at time t, the distance is at most h or, if `is_strict_`, below h. If two points near
  /// the closest points are also within h of each other, the proof uses those two points, because their
  /// weights can have fewer digits.
  [[nodiscard]] std::optional<std::string> at(const mpq_class& t) const {
    if (!is_in(t, span_)) return std::nullopt;
    const PositionsAt x(query_, t);
    if (query_.separation > 0) {
      const auto about = positions<double>(in_unit_, t.get_d());
      const ClosestWeights<double> closest(query_.kind, about);
      if (is_clearly_farther(closest.squared_distance())) return std::nullopt;
      if (const auto weights = shortened(closest.weights(), {3, 8, 20, 50}, x)) return text_at(t, *weights);
    }
    const ClosestWeights<mpq_class> closest(query_.kind, x.exact());
    if (!is_within(closest.squared_distance())) return std::nullopt;
    if (const auto weights = shortened(closest.weights(), {50, 200, 1000}, x)) return text_at(t, *weights);
    if (auto text = text_at(t, closest.weights())) return text;  // nothing if the certificate is too long
    const auto weights = shortened(closest.weights(), {4000}, x);
    return weights ? text_at(t, *weights) : std::nullopt;
  }

  [[nodiscard]] std::optional<std::string> at(double t) const {
    return std::isfinite(t) ? at(mpq_class(t)) : std::nullopt;
  }

 private:
  /// The positions of the vertices at a time: as doubles with error bounds (Ball), and as exact numbers. The
  /// exact positions are computed only on first use. The query and the time must outlive this object.
  class PositionsAt {
   public:
    PositionsAt(const Query& query, const mpq_class& t)
        : query_(query), t_(t), rough_(positions(query, ball(t))) {}

    [[nodiscard]] const std::array<Vec<Ball<double>>, 4>& rough() const { return rough_; }
    [[nodiscard]] const std::array<Vec<mpq_class>, 4>& exact() const {
      if (!exact_) exact_ = positions(query_, t_);
      return *exact_;
    }

   private:
    const Query& query_;
    const mpq_class& t_;
    std::array<Vec<Ball<double>>, 4> rough_;
    mutable std::optional<std::array<Vec<mpq_class>, 4>> exact_;
  };

  /// Whether the distance is so far above h that exact arithmetic would not help. The squared distance is
  /// approximate, and in the unit of `in_unit_`.
  [[nodiscard]] bool is_clearly_farther(double squared_distance) const {
    constexpr double error = 1e-6;
    return std::sqrt(squared_distance) > (1 + error) * in_unit_.separation + error;
  }

  [[nodiscard]] bool is_within(const mpq_class& squared_distance) const {
    return is_strict_ ? squared_distance < squared_h_ : squared_distance <= squared_h_;
  }

  [[nodiscard]] bool is_within(const WeightsOfPoints<mpq_class>& weights, const PositionsAt& x) const {
    WeightsOfPoints<Ball<double>> rough;
    std::ranges::transform(weights, rough.begin(), ball);
    const Ball<double> h = query_.separation;
    const int excess = (squared_distance(query_.kind, x.rough(), rough) - h * h).sign();
    return excess != 0 ? excess < 0 : is_within(squared_distance(query_.kind, x.exact(), weights));
  }

  /// Rounds the weights to each number of bits in `bits`, one number after the other, until the points with
  /// the rounded weights are within h of each other. Returns the rounded weights, or nothing if no number of
  /// bits suffices.
  template <class Real>
  [[nodiscard]] std::optional<WeightsOfPoints<mpq_class>> shortened(const WeightsOfPoints<Real>& weights,
                                                                    std::initializer_list<unsigned> bits,
                                                                    const PositionsAt& x) const {
    if (!std::ranges::all_of(weights, [](const Real& each) { return each >= 0 && each <= 1; }))
      return std::nullopt;
    for (const unsigned each : bits) {
      const auto rounded = rounded_weights(weights, each);
      if (rounded && is_within(*rounded, x)) return rounded;
    }
    return std::nullopt;
  }

  /// The weights, rounded to multiples of 2^-bits. For each primitive, the rounded weights add up to 1. The
  /// result is nothing if one of them would be negative.
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
  Query in_unit_;  ///< the query in a unit in which its largest coordinate is 1 to 2, rounded
  mpq_class squared_h_;
};

/// Proofs of contact, for h = 0, at a time that may be irrational.
class Crossing {
 public:
  Crossing(const Query& query, const Span& span)
      : query_(query),
        span_(span),
        x_(moving_points(query, exact::Unit(query))),
        of_(interiors(query.kind, x_)) {}

  /// The proof that the vertices become coplanar at a time in [p, q], while all weights are positive.
  [[nodiscard]] std::optional<std::string> bracket(const Number& p, const Number& q) const {
    const auto is_negative = [&](const Polynomial& each) { return is_positive(Polynomial() - each, p, q); };
    const bool is_proof = is_within_span(p, q) && of_.F.sign_at(p) * of_.F.sign_at(q) <= 0 &&
                          is_positive(of_.squared_N, p, q) && std::ranges::all_of(of_.outside, is_negative);
    return is_proof ? text(p, q) : std::nullopt;
  }

  /// The proof that bracket() gives for an interval that contains `known`. Tries intervals whose ends have
  /// few bits first.
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

  /// Whether all components of `area` are multiples of one polynomial, and this polynomial has opposite signs
  /// at p and q.
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

/// A proof of the first contact, at a time that exact arithmetic has found.
std::optional<std::string> certify_first_contact(const Span& span, const Meeting& meeting,
                                                 const Crossing& crossing, Root time) {
  constexpr int most_refinements = 40;
  if (const auto rational = time.as_rational()) return meeting.at(mpq_class(rational->mpq()));
  for (int i = 0; i < most_refinements; ++i, time.refine()) {
    const bool is_outside = time.hi() <= Number(span.from) || Number(span.to) <= time.lo();
    if (is_outside) return std::nullopt;
    if (auto text = crossing.bracket(time.lo(), time.hi())) return text;
    if (auto text = crossing.edge_bracket(time.lo(), time.hi())) return text;
  }
  return std::nullopt;
}

std::optional<std::string> certify_contact(const Query& query, const Span& span, const KnownTimes& times) {
  const Meeting meeting(query, span, false);
  const Crossing crossing(query, span);
  if (auto text = crossing.bracket(span.from, span.to)) return text;
  if (const auto known = time_of_contact(query)) {
    if (known->is_between)
      if (auto text = crossing.wide_bracket(known->time)) return text;
    for (const double t : {known->time.lo, known->time.hi})
      if (auto text = meeting.at(t)) return text;
  }
  if (times.exactly) return certify_first_contact(span, meeting, crossing, times.exactly->time);
  exact::Predicates predicates(query);
  const auto contact = exact::first_contact(predicates);
  if (!contact) return std::nullopt;
  return certify_first_contact(span, meeting, crossing, contact->time);
}

/// The functions below that search for the time of a proof give up when this time needs about this many bits.
/// If the distance touches h only for a moment, at an irrational time, there is no proof. So certify_touch()
/// gives up at fewer bits.
constexpr unsigned most_bits = 10'000;
constexpr unsigned most_bits_of_touch = 5'000;

/// The proof that the distance is h at some time. If the first such time is rational, the proof uses this
/// time. Otherwise the proof uses a time soon after the first such time, and is found only if the distance
/// stays at h.
std::optional<std::string> certify_touch(Root time, const Meeting& meeting) {
  if (const auto rational = time.as_rational()) return meeting.at(mpq_class(rational->mpq()));
  for (const Number least = exact::power_of_half(most_bits_of_touch);; time.refine()) {
    if (auto text = meeting.at(mpq_class(CGAL::Gmpq(time.hi()).mpq()))) return text;
    if (time.hi() - time.lo() < least) return std::nullopt;
  }
}

/// Returns a proof that the distance is below h at some time just after `after`. At the time `after`, the
/// distance falls below h. The function tries the multiples of 2^-bits next to `after`, with more and more
/// bits.
std::optional<std::string> certify_below(Root after, const Meeting& meeting) {
  for (unsigned bits = 4; bits < most_bits; bits *= 2) {
    while (exact::power_of_half(bits) < after.hi() - after.lo()) after.refine();
    const mpq_class hi(CGAL::Gmpq(after.hi()).mpq());
    mpz_class next(mpq_class(mpq_class(CGAL::Gmpq(after.lo()).mpq()) << bits));
    mpq_class t;
    do {
      t = mpq_class(++next) >> bits;
      if (auto text = meeting.at(t)) return text;
    } while (t <= hi);
  }
  return std::nullopt;
}

std::optional<std::string> certify_approach(const Query& query, const Span& span, bool is_strict,
                                            const KnownTimes& times) {
  const Meeting meeting(query, span, is_strict);
  const KnownApproach known = times.approach ? *times.approach : known_approach(query);
  for (const double t : {span.from, std::round(known.time.hi * 16) / 16,
                         std::round(known.time.hi * 1024) / 1024, known.time.hi, span.to})
    if (auto text = meeting.at(t)) return text;
  const auto approach = times.exactly ? *times.exactly : exact::first_approach(query);
  if (!approach) return std::nullopt;
  // If the distance falls below h, there are pairs of points near the closest points that are also within h
  // of each other. Some of these points have weights with few digits, which keeps the proof short.
  if (approach->below)
    if (auto text = certify_below(*approach->below, meeting)) return text;
  return is_strict ? std::nullopt : certify_touch(approach->time, meeting);
}

}  // namespace

std::optional<std::string> certify_meets(const Query& query, const Span& span, bool is_strict,
                                         const KnownTimes& known) {
  const PlainArithmetic guard;
  if (const double before = std::nextafter(span.to, 0); span.is_open && span.from <= before)
    if (auto text = certify_meets(query, {span.from, before}, is_strict, known)) return text;
  return query.separation > 0 ? certify_approach(query, span, is_strict, known)
                              : certify_contact(query, span, known);
}

}  // namespace nearmiss

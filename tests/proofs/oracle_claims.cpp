// The table of the rounding constants of oracle/.
#include <algorithm>
#include <array>
#include <cmath>

#include "oracle/filter/neighbours.hpp"
#include "oracle/filter/search.hpp"
#include "tests/proofs/claims.hpp"
#include "tests/proofs/oracle_errors.hpp"
#include "tests/proofs/oracle_proofs.hpp"

namespace nearmiss::proofs {

namespace {

using namespace certified;

// --- the exact errors at given inputs ----------------------------------------------------------------------

/// The relative error, in units of u, of a product whose factors are rounded. The product has a factor 1 - x
/// for each input x.
double seen_leaves(const Inputs& inputs) {
  Rational exact = 1;
  Rational rounded = 1;
  for (const auto& [name, value] : inputs) {
    exact *= Rational(1) - Rational(value);
    rounded *= Rational(1 - value);
  }
  return ratio(abs(exact - rounded), rounded * Rational(u));
}

/// The error that the product p q has because its factors have the errors ep and eq, divided by the term of
/// `cross_bound` for this error.
double seen_growth(const Inputs& in) {
  const Rational p(in.at("p"));
  const Rational q(in.at("q"));
  const Rational ep(in.at("ep"));
  const Rational eq(in.at("eq"));
  return ratio(abs((p + ep) * (q + eq) - p * q), abs(p * eq) + abs(q * ep) + abs(ep * eq));
}

/// The rounding error of t - h, an end of the interval [t - h, t + h] of `error_near`, in units of 2^-54.
double seen_end(const Inputs& in) {
  const Rational exact = Rational(in.at("t")) - Rational(in.at("h"));
  return exact < 0 || exact > 1 ? 0
                                : ratio(abs(Rational(in.at("t") - in.at("h")) - exact), Rational(0x1p-54));
}

/// The rounding error of b + x (e - b), a time in the part [b, e] of the step, in units of 2^-52.
double seen_zoom(const Inputs& in) {
  const double b = in.at("b");
  const double e = in.at("e");
  const double x = in.at("x");
  const Rational exact = Rational(b) + Rational(x) * (Rational(e) - Rational(b));
  const double end = b + x * (e - b) - zoom_rounding;
  const bool is_in_step = x >= 0 && x <= 1 && b >= 0 && b <= e && e <= 1 && end >= 0;
  return !is_in_step ? 0 : ratio(abs(Rational(end) + Rational(zoom_rounding) - exact), Rational(0x1p-52));
}

/// |p(h) - p(0)|, where p is the quadratic polynomial with the exact coefficients b, divided by the bound of
/// this change in `error_near`.
double seen_spread(const Inputs& in) {
  const std::array<Rational, 3> b{Rational(in.at("b0")), Rational(in.at("b1")), Rational(in.at("b2"))};
  const Rational h(in.at("h"));
  const Rational slope = std::max(Rational(abs(b[1] - b[0])), Rational(abs(b[2] - b[1])));
  const Rational moved = (1 - h) * (1 - h) * b[0] + 2 * h * (1 - h) * b[1] + h * h * b[2] - b[0];
  return h < 0 || h > 1 ? 0 : ratio(abs(moved), 2 * h * slope);
}

/// The amount by which |b1 - b0| for the exact coefficients exceeds |b1 - b0| for the computed coefficients,
/// divided by the error of a coefficient.
double seen_slope(const Inputs& in) {
  const Rational e(in.at("e"));
  const Rational slope = abs(Rational(in.at("b1")) - Rational(in.at("b0")));
  const Rational exact = abs(Rational(in.at("b1")) + e - (Rational(in.at("b0")) - e));
  return ratio(exact - slope, abs(e));
}

/// The error of the derivative of a cubic at t, for exact coefficients, in units of u times the largest
/// coefficient.
double seen_slope_rounding(const Inputs& in) {
  const double t = in.at("t");
  if (!(t >= 0 && t <= 1)) return 0;
  const Bernstein<double, 4> F{{in.at("b0"), in.at("b1"), in.at("b2"), in.at("b3")}, 0};
  const Rational s = Rational(1) - Rational(t);
  const auto slope = [&](std::size_t i) -> Rational { return 3 * (Rational(F.b[i + 1]) - Rational(F.b[i])); };
  const Rational exact = s * s * slope(0) + 2 * s * Rational(t) * slope(1) + Rational(t) * t * slope(2);
  return ratio(abs(Rational(derivative(F).at(t)) - exact), Rational(F.largest()) * Rational(u));
}

/// The part of the derivative's error at t = 0 that comes from the errors of the coefficients, divided by the
/// error of a coefficient.
double seen_slope_growth(const Inputs& in) { return 3 * seen_slope(in); }

/// The error of v + S (d - t), in units of u (|v| + |S (d - t)|). v + S (d - t) is the value of F at a double
/// d, computed from its value v and slope S at t.
double seen_secant(const Inputs& in) {
  const double v = in.at("v");
  const double S = in.at("S");
  const double g = in.at("d") - in.at("t");
  const Rational exact_g = Rational(in.at("d")) - Rational(in.at("t"));
  const Rational lower = Rational(in.at("lower")) * Rational(v) * Rational(u);
  const Rational exact = Rational(v) + lower + Rational(S) * exact_g;
  if (!(std::abs(in.at("lower")) <= 1)) return 0;
  return ratio(abs(Rational(v + S * g) - exact),
               (Rational(std::abs(v)) + abs(Rational(S) * exact_g)) * Rational(u));
}

/// The error of the derivative of a cubic with tiny coefficients, in units of the smallest double. This error
/// comes from underflow.
double seen_slope_underflow(const Inputs& in) {
  const Bernstein<double, 4> F{{in.at("b0"), in.at("b1"), in.at("b2"), in.at("b3")}, 0};
  if (F.largest() > 0x1p-1060) return 0;
  return seen_slope_rounding(in) * F.largest() * u / smallest;
}

double seen_upper_halves(const Inputs& in) {
  const Rational lower = abs(Rational(in.at("a.lo")) - Rational(in.at("b.lo")));
  const Rational upper = std::max(std::abs(in.at("a")), std::abs(in.at("b")));
  return ratio(lower, upper * Rational(0x1p-52));
}

double seen_roundoff(const Inputs& in) {
  const Rational exact = Rational(1) + Rational(in.at("x"));
  return ratio(abs(Rational(1 + in.at("x")) - exact), exact * Rational(u));
}

DoubleWord word(const Inputs& in, const std::string& name) { return {in.at(name), in.at(name + ".lo")}; }
Rational exact_word(const DoubleWord& x) { return Rational(x.hi) + Rational(x.lo); }

double seen_word_product(const Inputs& in) {
  const Rational exact = exact_word(word(in, "a")) * exact_word(word(in, "b"));
  const Rational computed = exact_word(word(in, "a") * word(in, "b"));
  return exact == 0 ? 0 : ratio(abs((computed - exact) / exact), Rational(0x1p-103));
}
double seen_word_sum(const Inputs& in) {
  const Rational exact = exact_word(word(in, "a")) + exact_word(word(in, "b"));
  const Rational computed = exact_word(word(in, "a") + word(in, "b"));
  return exact == 0 ? 0 : ratio(abs((computed - exact) / exact), Rational(0x1p-103));
}
/// The amount by which the error of a product of double words exceeds the error that the relative bound
/// allows, in units of the smallest double.
double seen_word_underflow(const Inputs& in) {
  const Rational exact = exact_word(word(in, "a")) * exact_word(word(in, "b"));
  const Rational computed = exact_word(word(in, "a") * word(in, "b"));
  const Rational beyond = abs(computed - exact) - abs(exact) * Rational(roundoff<DoubleWord>);
  return std::max(0.0, ratio(beyond, Rational(smallest)));
}

// --- the claims --------------------------------------------------------------------------------------------

/// A claim about the rounding errors of results, in units of the roundoff U times `size`.
template <class Real, class Number>
OracleClaim rounding(std::string name, double claimed, Results results, const std::string& vectors,
                     Rational (*size)(const Inputs&)) {
  constexpr bool words = std::is_same_v<Number, WordNumber>;
  const ResultsAt<Number> at(results);
  const std::string unit = vectors.size() == 3 ? "U M" : "U w";
  name += words ? ", in double words" : ", in double";
  return {name,
          "oracle/filter/step_part.hpp",
          unit,
          claimed,
          "Gappa",
          [=] { return proven_rounding<Real>(results); },
          [=](const Inputs& inputs) { return at.error(inputs, size(inputs) * Rational(roundoff<Real>)); },
          [=](Random& random) { return draw_vectors(random, vectors, words); }};
}

Inputs draw_words(Random& random, double size) {
  Inputs in;
  for (const char* name : {"a", "b"}) {
    in[name] = size * random.uniform(1, 2);
    in[std::string(name) + ".lo"] = size * u * random.uniform(-1, 1);
  }
  return in;
}
/// Draws double words of opposite signs whose sum loses some bits.
Inputs draw_sum(Random& random) {
  Inputs in = draw_words(random, 1);
  in["b"] = -std::ldexp(in["b"], random.integer(-3, 0));
  in["b.lo"] = std::ldexp(in["b.lo"], random.integer(-60, 0));
  return in;
}

/// Whether components are so small that only underflow matters.
bool is_tiny(const Inputs& inputs) {
  return std::all_of(inputs.begin(), inputs.end(), [](const auto& input) {
    return !is_component(input.first) || std::abs(input.second) <= 0x1p-537;
  });
}

/// Draws components for which only underflow matters.
Inputs draw_tiny(Random& random) {
  Inputs in = draw_vectors(random, "bc");
  for (auto& [name, value] : in)
    if (is_component(name)) value *= 0x1p-537;
  return in;
}

Inputs draw_signs(Random& random, const std::string& vectors) {
  Inputs in = draw_vectors(random, vectors);
  for (auto& [name, value] : in)
    if (is_component(name)) value = random.one_in(2) ? 1 : -1;
  return in;
}

std::function<Inputs(Random&)> draw_from(const std::map<std::string, std::pair<double, double>>& ranges) {
  return [ranges](Random& random) {
    Inputs in;
    for (const auto& [name, range] : ranges) in[name] = random.uniform(range.first, range.second);
    return in;
  };
}

constexpr auto patch = "oracle/filter/step_part.hpp";
constexpr auto bernstein = "oracle/arithmetic/bernstein.hpp";
constexpr auto gappa = "Gappa";

void add_polynomials(std::vector<OracleClaim>& claims) {
  const auto add = [&](OracleClaim claim) { claims.push_back(std::move(claim)); };
  add(rounding<Traced, double>("weight_rounding", weight_rounding, weight_results<Traced>, "bc", w_of));
  add(rounding<TracedWord, WordNumber>("weight_rounding", weight_rounding, weight_results<TracedWord>, "bc",
                                       w_of));
  add(rounding<Traced, double>("F_rounding", F_rounding, cubic_results<Traced>, "abc", M_of));
  add(rounding<TracedWord, WordNumber>("F_rounding", F_rounding, cubic_results<TracedWord>, "abc", M_of));
  const std::pair<double, double> near_zero{-0x1p-52, 0x1p-52};
  add({"two_leaves", patch, "u w", two_leaves, gappa, [] { return proven_leaves(2, weight_results<Traced>); },
       seen_leaves, draw_from({{"x", near_zero}, {"y", near_zero}})});
  add({"three_leaves", patch, "u M", three_leaves, gappa,
       [] { return proven_leaves(3, cubic_results<Traced>); }, seen_leaves,
       draw_from({{"x", near_zero}, {"y", near_zero}, {"z", near_zero}})});
  add({"leaf_growth", patch, "l, L", leaf_growth, gappa, proven_leaf_growth, seen_growth,
       draw_from({{"p", {0, 1}}, {"q", {0, 1}}, {"ep", {0, 0x1p-50}}, {"eq", {0, 0x1p-50}}})});
  add(rounding<Traced, double>("part_rounding", part_rounding, part_results<Traced>, "a", A_of));
  add(rounding<TracedWord, WordNumber>("part_rounding", part_rounding, part_results<TracedWord>, "a", A_of));
  const ResultsAt<double> weights(weight_results<Traced>);
  const ResultsAt<double> cubic(cubic_results<Traced>);
  add({"underflow_products", patch, "H", underflow_products, gappa, proven_underflow_products,
       [=](const Inputs& in) { return is_tiny(in) ? weights.error(in, Rational(smallest) / 2) : 0; },
       draw_tiny});
  add({"headroom, of w", patch, "w", headroom, gappa,
       [] { return proven_headroom(weight_results<Traced>, 2); },
       [=](const Inputs& in) { return weights.reach(in, w_of(in)); },
       [](Random& random) { return draw_signs(random, "bc"); }});
  add({"headroom, of M", patch, "M", headroom, gappa,
       [] { return proven_headroom(cubic_results<Traced>, 3); },
       [=](const Inputs& in) { return cubic.reach(in, M_of(in)); },
       [](Random& random) { return draw_signs(random, "abc"); }});
}

void add_others(std::vector<OracleClaim>& claims) {
  const auto add = [&](OracleClaim claim) { claims.push_back(std::move(claim)); };
  add({"spread_growth", bernstein, "error + spread", spread_growth, gappa, proven_spread_growth, seen_spread,
       draw_from({{"b0", {-1, 1}}, {"b1", {-1, 1}}, {"b2", {-1, 1}}, {"h", {0, 1}}})});
  add({"slope_errors", bernstein, "error", slope_errors, gappa, proven_slope_errors, seen_slope,
       draw_from({{"b0", {-1, 1}}, {"b1", {-1, 1}}, {"e", {0, 1}}})});
  const std::map<std::string, std::pair<double, double>> cubics{
      {"b0", {-1, 1}}, {"b1", {-1, 1}}, {"b2", {-1, 1}}, {"b3", {-1, 1}}, {"t", {0, 1}}};
  add({"slope_rounding", bernstein, "U largest", slope_rounding, gappa, proven_slope_rounding,
       seen_slope_rounding, draw_from(cubics)});
  add({"slope_growth", bernstein, "error", slope_growth, gappa, proven_slope_growth, seen_slope_growth,
       draw_from({{"b0", {-1, 1}}, {"b1", {-1, 1}}, {"e", {0, 1}}})});
  add({"slope_underflow", bernstein, "2^-1074", slope_underflow, "argument beside it", [] { return 3.5; },
       seen_slope_underflow,
       [cubics](Random& random) {
         Inputs in = draw_from(cubics)(random);
         for (auto& [name, value] : in)
           if (name != "t") value *= 0x1p-1060;
         return in;
       }});
  add({"secant_rounding", "oracle/filter/neighbours.hpp", "U (|v| + |S| g)", secant_rounding, gappa,
       proven_secant_rounding, seen_secant,
       draw_from({{"v", {-1, 1}}, {"lower", {-1, 1}}, {"S", {-1, 1}}, {"t", {0, 1}}, {"d", {0, 1}}})});
  add({"end_rounding", bernstein, "2^-54", end_rounding * 0x1p54, gappa, proven_end_rounding, seen_end,
       draw_from({{"t", {0.5, 1}}, {"h", {0, 0x1p-50}}})});
  add({"upper_halves", bernstein, "2^-52", upper_halves * 0x1p52, gappa, proven_upper_halves,
       seen_upper_halves, [](Random& random) { return draw_words(random, 1); }});
  add({"zoom_rounding", "oracle/filter/search.hpp", "2^-52", zoom_rounding * 0x1p52, gappa,
       proven_zoom_rounding, seen_zoom, draw_from({{"b", {0, 1}}, {"e", {0, 1}}, {"x", {0, 1}}})});
  add({"roundoff, of double", bernstein, "2^-53", roundoff<double> * 0x1p53, gappa, proven_roundoff,
       seen_roundoff, draw_from({{"x", {0, 0x1p-52}}})});
  add({"roundoff, of products of double words", bernstein, "2^-103", roundoff<DoubleWord> * 0x1p103, gappa,
       proven_word_product, seen_word_product, [](Random& random) { return draw_words(random, 1); }});
  add({"roundoff, of sums of double words", bernstein, "2^-103", roundoff<DoubleWord> * 0x1p103,
       "3u² / (1 - 4u): Joldes, Muller, Popescu 2017, theorem 3.1; in Coq by Muller, Rideau 2022",
       [] { return 3 / (1 - 4 * u) / 8; }, seen_word_sum, draw_sum});
  add({"product_underflow, of double words", bernstein, "2^-1074", product_underflow<DoubleWord>,
       "argument beside it", [] { return 5.0; }, seen_word_underflow,
       [](Random& random) { return draw_words(random, std::ldexp(1.0, random.integer(-520, -480))); }});
}

}  // namespace

std::vector<OracleClaim> oracle_claims() {
  std::vector<OracleClaim> claims;
  add_polynomials(claims);
  add_others(claims);
  return claims;
}

}  // namespace nearmiss::proofs

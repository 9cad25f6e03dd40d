#include "tests/proofs/oracle_seen.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "oracle/filter/search.hpp"

namespace nearmiss::proofs {

namespace {

using namespace certified;

constexpr double u = 0x1p-53;

}  // namespace

/// The relative error of a product of rounded leaves 1 - value, one for each input, in units of u.
double seen_leaves(const Inputs& inputs) {
  Rational exact = 1;
  Rational rounded = 1;
  for (const auto& [name, value] : inputs) {  // the differences 1 - value
    exact *= Rational(1) - Rational(value);
    rounded *= Rational(1 - value);
  }
  return ratio(abs(exact - rounded), rounded * Rational(u));
}

/// The contribution of the leaves' errors to their product, divided by the term that `cross_bound` has for
/// it.
double seen_growth(const Inputs& in) {
  const Rational p(in.at("p"));
  const Rational q(in.at("q"));
  const Rational ep(in.at("ep"));
  const Rational eq(in.at("eq"));
  return ratio(abs((p + ep) * (q + eq) - p * q), abs(p * eq) + abs(q * ep) + abs(ep * eq));
}

/// The rounding error of t - h, in units of 2^-54.
double seen_end(const Inputs& in) {
  const Rational exact = Rational(in.at("t")) - Rational(in.at("h"));
  return exact < 0 || exact > 1 ? 0
                                : ratio(abs(Rational(in.at("t") - in.at("h")) - exact), Rational(0x1p-54));
}

/// The rounding error of the beginning of a part within a part of the step, in units of 2^-52.
double seen_zoom(const Inputs& in) {
  const double b = in.at("b");
  const double e = in.at("e");
  const double x = in.at("x");
  const Rational exact = Rational(b) + Rational(x) * (Rational(e) - Rational(b));
  const double end = b + x * (e - b) - zoom_rounding;
  const bool is_in_step = x >= 0 && x <= 1 && b >= 0 && b <= e && e <= 1 && end >= 0;
  return !is_in_step ? 0 : ratio(abs(Rational(end) + Rational(zoom_rounding) - exact), Rational(0x1p-52));
}

/// The change of P on [t, t + h] from its value at t, divided by the bound in `error_near`, for exact b.
double seen_spread(const Inputs& in) {
  const std::array<Rational, 3> b{Rational(in.at("b0")), Rational(in.at("b1")), Rational(in.at("b2"))};
  const Rational h(in.at("h"));
  const Rational slope = std::max(Rational(abs(b[1] - b[0])), Rational(abs(b[2] - b[1])));
  const Rational moved = (1 - h) * (1 - h) * b[0] + 2 * h * (1 - h) * b[1] + h * h * b[2] - b[0];
  return h < 0 || h > 1 ? 0 : ratio(abs(moved), 2 * h * slope);
}

/// The amount by which a slope of exact coefficients exceeds that of computed ones, divided by the error.
double seen_slope(const Inputs& in) {
  const Rational e(in.at("e"));
  const Rational slope = abs(Rational(in.at("b1")) - Rational(in.at("b0")));
  const Rational exact = abs(Rational(in.at("b1")) + e - (Rational(in.at("b0")) - e));
  return ratio(exact - slope, abs(e));
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
/// The error beyond the relative error, in units of the smallest double.
double seen_word_underflow(const Inputs& in) {
  const Rational exact = exact_word(word(in, "a")) * exact_word(word(in, "b"));
  const Rational computed = exact_word(word(in, "a") * word(in, "b"));
  const Rational beyond = abs(computed - exact) - abs(exact) * Rational(roundoff<DoubleWord>);
  return std::max(0.0, ratio(beyond, Rational(smallest)));
}

}  // namespace nearmiss::proofs

#include "tests/proofs/oracle_proofs.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "oracle/filter/search.hpp"
#include "tests/proofs/factors.hpp"
#include "tests/proofs/gappa_process.hpp"

namespace nearmiss::proofs {

using namespace certified;

namespace {

/// The largest upper end that Gappa proves for the goals of some scripts.
double largest_end(const std::set<std::string>& scripts) {
  double largest = 0;
  for (const std::string& script : scripts) largest = std::max(largest, proven_upper_end(script));
  return largest;
}

std::string quotient(const std::string& a, const std::string& b) { return fmt::format("({}) / ({})", a, b); }

/// The largest number of roundings of any term in the bounds. If this number is k, roundings reduce a bound
/// by at most the factor (1 - u)^k.
int most_roundings(const std::vector<Bounded>& results) {
  int most = 0;
  for (const Bounded& each : results)
    for (const auto& [monomial, share] : needs_of(each, precision_of<Traced>()).bound)
      most = std::max(most, share.roundings);
  return most;
}

int most_roundings(Results results) {
  int most = 0;
  for (const Leaves leaves : {Leaves::rounded_once, Leaves::given_errors}) {
    Trace trace;
    most = std::max(most, most_roundings(results(trace, leaves)));
  }
  return most;
}

/// The factor that compensates for this many roundings of a bound.
double proven_growth(int roundings) {
  Factors factors;
  return proven_upper_end(factors.script(quotient("1", factors.product(roundings, u)) + " in ?"));
}

/// How many times H, the largest error of a product by underflow, must be added to a bound to cover underflow
/// in the value and in the bound itself. For the bound, the code computes `more` products that the template
/// does not have.
template <class Real>
double proven_underflow(Results results, Leaves leaves, int more) {
  const ValuePrecision precision = precision_of<Real>();
  Trace trace;
  std::set<std::string> scripts;
  for (const Bounded& each : results(trace, leaves)) {
    const Needs needs = needs_of(each, precision);
    for (const auto& [monomial, offered] : needs.bound) {
      const auto of_value = needs.underflows.find(monomial);
      const auto of_bound = needs.bound_underflows.find(monomial);
      Factors factors;
      std::string needed = monomial.empty() ? fmt::format("{} * 1.01", more) : "0";
      if (of_bound != needs.bound_underflows.end())
        needed += fmt::format(" + {} * {}", script_text(of_bound->second.coefficient),
                              factors.product(of_bound->second.roundings, u));
      needed = fmt::format("({}) * {:a}", needed, product_underflow<double> / precision.underflow);
      if (of_value != needs.underflows.end())
        needed += fmt::format(" + {} * {}", script_text(of_value->second.coefficient),
                              factors.product(of_value->second.roundings, precision.roundoff));
      scripts.insert(factors.script(quotient(needed, factors.product(offered.roundings, u)) + " in ?"));
    }
  }
  return largest_end(scripts);
}

/// Traces `error_near` of a polynomial, for the half width h. The polynomial's coefficients, its error and h
/// are inputs.
Traced traced_error_near(Trace& trace) {
  Bernstein<Traced, 3> polynomial;
  for (std::size_t i = 0; i < 3; ++i)
    polynomial.b[i] = trace.input(std::string(1, 'b') + std::to_string(i), static_cast<double>(i * i));
  polynomial.error = trace.input("e", 1);
  return polynomial.error_near(trace.input("h", 0.5));
}

/// The number of roundings in the computation of `error_near`. The number includes two roundings of
/// `upper_halves`, which occur only for double words.
int roundings_near() {
  Trace trace;
  int most = 0;
  for (const Term& term : expand(traced_error_near(trace))) most = std::max(most, term.roundings);
  return most + 2;
}
}  // namespace

template <class Real>
double proven_rounding(Results results) {
  const ValuePrecision precision = precision_of<Real>();
  Trace trace;
  std::set<std::string> scripts;
  for (const Bounded& each : results(trace, Leaves::exact)) {
    const Needs needs = needs_of(each, precision);
    for (const auto& [monomial, value] : needs.values) {
      Factors factors;
      const std::string grown =
          fmt::format("{} * ({} - 1) * {} * {:a}", script_text(value.coefficient),
                      factors.product(value.roundings, precision.roundoff),
                      factors.product(precision.is_double_word ? 3 : 0, u), 1 / precision.roundoff);
      const std::string offered = factors.product(needs.bound.at(monomial).roundings, u);
      scripts.insert(factors.script(quotient(grown, offered) + " in ?"));
    }
  }
  return largest_end(scripts);
}
template double proven_rounding<Traced>(Results);
template double proven_rounding<TracedWord>(Results);

double proven_leaves(int leaves, Results results) {
  Factors factors;
  const std::string missed = fmt::format("({} - 1) * {:a}", factors.product(leaves, u), 1 / u);
  return proven_upper_end(
      factors.script(quotient(missed, factors.product(most_roundings(results), u)) + " in ?"));
}

double proven_leaf_growth() { return proven_growth(most_roundings(cubic_results<Traced>)); }

double proven_underflow_products() {
  double largest = 0;
  for (const Leaves leaves : {Leaves::rounded_once, Leaves::given_errors}) {
    // `error_near` has two more products than the template of the weights. All other underflow in
    // `error_near` is at most that in `error`.
    largest = std::max(largest, proven_underflow<Traced>(weight_results<Traced>, leaves, 2));
    largest = std::max(largest, proven_underflow<Traced>(cubic_results<Traced>, leaves, 0));
    largest = std::max(largest, proven_underflow<Traced>(part_results<Traced>, leaves, 0));
  }
  largest =
      std::max(largest, proven_underflow<TracedWord>(weight_results<TracedWord>, Leaves::given_errors, 2));
  largest =
      std::max(largest, proven_underflow<TracedWord>(cubic_results<TracedWord>, Leaves::given_errors, 0));
  return std::max(largest, proven_underflow<TracedWord>(part_results<TracedWord>, Leaves::given_errors, 0));
}

double proven_headroom(Results results, int degree) {
  Trace trace;
  int roundings = 0;
  Rational largest = 0;
  Program program;
  for (const Bounded& each : results(trace, Leaves::exact)) {
    program.add(each.value);
    roundings = std::max(roundings, most_roundings({each}));
  }
  int of_value = 0;
  for (int i = 0; i < static_cast<int>(program.size()); ++i) {
    for (const auto& [monomial, share] : bound(expand(program, i), magnitude_of, {"t", "s"})) {
      int power = 0;
      for (const auto& [name, each] : monomial) power += each;
      if (power != degree) continue;
      largest = std::max(largest, share.coefficient);
      of_value = std::max(of_value, share.roundings);
    }
  }
  Factors factors;
  const std::string reached = fmt::format("{} * {}", script_text(largest), factors.product(of_value, u));
  return proven_upper_end(factors.script(quotient(reached, factors.product(roundings, u)) + " in ?"));
}

double proven_spread_growth() { return proven_growth(roundings_near()); }

double proven_slope_errors() { return 2 * proven_growth(roundings_near()); }

double proven_end_rounding() {
  return proven_upper_end("{ x in [0, 1] -> (float<ieee_64, ne>(x) - x) * 1b54 in ? }\n");
}

double proven_upper_halves() {
  return proven_upper_end(
      "{ a in [1, 2] /\\ al in [-1b-53, 1b-53] /\\ bl in [-1b-53, 1b-53] -> (al - bl) / a * 1b52 in ? }\n");
}

// A coefficient of the derivative, 3 (b_i+1 - b_i), has two roundings. Each of the two levels of de
// Casteljau's algorithm adds three roundings. The bound has at most two rounded products and two rounded
// sums.
constexpr int roundings_of_slope = 8;
constexpr int roundings_of_slope_bound = 4;

double proven_slope_rounding() {
  Factors factors;
  const std::string missed =
      fmt::format("6 * ({} - 1) * {:a}", factors.product(roundings_of_slope, u), 1 / u);
  return proven_upper_end(
      factors.script(quotient(missed, factors.product(roundings_of_slope_bound, u)) + " in ?"));
}

double proven_slope_growth() {
  Factors factors;
  const std::string grown = fmt::format("6 * {}", factors.product(roundings_of_slope, u));
  return proven_upper_end(
      factors.script(quotient(grown, factors.product(roundings_of_slope_bound, u)) + " in ?"));
}

// v + S g is the value of F at a distance g from a time. The term S g is rounded three times. Up to four
// roundings can make the term R g of the bound (neighbours.hpp) smaller, and R is at most |S|. The bound's
// term that covers these seven roundings is itself rounded at most six times.
double proven_secant_rounding() {
  Factors factors;
  const std::string missed =
      fmt::format("(({} - 1) + (1 - {})) * {:a}", factors.product(3, u), factors.product(4, u), 1 / u);
  return proven_upper_end(factors.script(quotient(missed, factors.product(6, u)) + " in ?"));
}

double proven_zoom_rounding() {
  const auto script = [](char outward, char back) {
    const std::string c = script_text(zoom_rounding);
    return fmt::format(
        "@r = float<ieee_64, ne>;\n"
        "length = r(e - b); moved = r(x * length); sum = r(b + moved); end = r(sum {0} {2});\n"
        "{{ e in [0, 1] /\\ b in [0, 1] /\\ x in [0, 1] /\\ e - b in [0, 1] /\\ b + x * (e - b) in [0, 1]\n"
        "   /\\ end in [0, 1] -> ((end {1} {2}) - (b + x * (e - b))) * 1b52 in ? }}\n"
        "(end {1} {2}) - (b + x * (e - b)) -> (end - (sum {0} {2})) + (sum - (b + moved)) +\n"
        "  (moved - x * length) + x * (length - (e - b));\n",
        outward, back, c);
  };
  return largest_end({script('-', '+'), script('+', '-')});
}

double proven_roundoff() {
  return proven_upper_end("{ x in [1, 2] -> (float<ieee_64, ne>(x) - x) / x * 1b53 in ? }\n");
}

double proven_word_product() {
  return proven_upper_end(
      "@r = float<ieee_64, ne>;\n"
      "a = r(a_); b = r(b_); al = r(al_); bl = r(bl_);\n"
      "p = r(a * b); pl = a * b - p;\n"
      "beside = r(r(a * bl) + r(al * b)); lower = r(pl + beside);\n"
      "exact = (a + al) * (b + bl);\n"
      "{ a in [1, 2] /\\ b in [1, 2] /\\ al in [-1b-53, 1b-53] /\\ bl in [-1b-53, 1b-53]\n"
      "  -> ((p + lower) - exact) / exact * 1b103 in ? }\n"
      "(p + lower) - exact -> (lower - (pl + beside)) + (beside - (r(a * bl) + r(al * b))) +\n"
      "  (r(a * bl) - a * bl) + (r(al * b) - al * b) - al * bl;\n"
      "pl -> -(p - a * b);\n"
      "$ a in 16, b in 16;\n");
}

}  // namespace nearmiss::proofs

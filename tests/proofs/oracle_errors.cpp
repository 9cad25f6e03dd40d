#include "tests/proofs/oracle_errors.hpp"

#include <algorithm>
#include <cmath>

namespace nearmiss::proofs {

namespace {

template <class Number>
Number number(double hi, double lo);
template <>
double number(double hi, double /*lo*/) {
  return hi;
}
template <>
WordNumber number(double hi, double lo) {
  return WordNumber(certified::DoubleWord(hi, lo));
}
template <>
Rational number(double hi, double lo) {
  return Rational(hi) + Rational(lo);
}

bool is_lower_half(const std::string& name) { return name.ends_with(".lo"); }

template <class Number>
std::map<std::string, Number> as_numbers(const Inputs& inputs) {
  std::map<std::string, Number> numbers;
  for (const auto& [name, value] : inputs) {
    if (is_lower_half(name)) continue;
    const auto lower = inputs.find(name + ".lo");
    numbers.emplace(name, number<Number>(value, lower == inputs.end() ? 0.0 : lower->second));
  }
  return numbers;
}

/// Whether both times are in [0, 1].
bool are_in_step(const Inputs& inputs) {
  const auto is_in_step = [&](const char* time) { return inputs.at(time) >= 0 && inputs.at(time) <= 1; };
  return is_in_step("t") && is_in_step("s");
}

Rational magnitude(const Inputs& inputs, char vector, char axis) {
  const auto at = [&](char end) { return std::abs(inputs.at({vector, end, axis})); };
  return Rational(std::max(at('0'), at('1')));
}

}  // namespace

template <class Number>
ResultsAt<Number>::ResultsAt(Results results) {
  for (const Bounded& each : results(*trace_, Leaves::exact)) results_.push_back(program_.add(each.value));
}

template <class Number>
double ResultsAt<Number>::error(const Inputs& inputs, const Rational& unit) const {
  if (!are_in_step(inputs)) return 0;
  const auto computed = evaluate(program_, as_numbers<Number>(inputs), Number(0.0));
  const auto exact = evaluate(program_, as_numbers<Rational>(inputs), Rational(0));
  double worst = 0;
  for (const int result : results_) {
    const auto i = static_cast<std::size_t>(result);
    worst = std::max(worst, ratio(abs(exactly(computed[i]) - exact[i]), unit));
  }
  return worst;
}

template <class Number>
double ResultsAt<Number>::reach(const Inputs& inputs, const Rational& unit) const {
  if (!are_in_step(inputs)) return 0;
  const auto all = evaluate(program_, as_numbers<Rational>(inputs), Rational(0));
  int highest = 0;
  for (const int result : results_) highest = std::max(highest, degree(result));
  double largest = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (degree(static_cast<int>(i)) == highest) largest = std::max(largest, ratio(abs(all[i]), unit));
  return largest;
}

template <class Number>
int ResultsAt<Number>::degree(int instruction) const {
  const Instruction& one = program_[instruction];
  switch (one.operation) {
    case Operation::input:
      return is_component(one.name) ? 1 : 0;
    case Operation::constant:
      return 0;
    case Operation::multiply:
      return degree(one.left) + degree(one.right);
    case Operation::add:
    case Operation::subtract:
      return std::max(degree(one.left), degree(one.right));
    default:
      return degree(one.left);
  }
}

template class ResultsAt<double>;
template class ResultsAt<WordNumber>;

Rational A_of(const Inputs& inputs) { return magnitude(inputs, 'a', 'x'); }

Rational w_of(const Inputs& inputs) {
  const auto size = [&](char vector, char axis) { return magnitude(inputs, vector, axis); };
  return size('b', 'y') * size('c', 'z') + size('b', 'z') * size('c', 'y');
}

Rational M_of(const Inputs& inputs) {
  const auto size = [&](char vector, char axis) { return magnitude(inputs, vector, axis); };
  const std::string axes = "xyzxy";
  Rational sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    sum += size('a', axes[k]) * (size('b', axes[k + 1]) * size('c', axes[k + 2]) +
                                 size('b', axes[k + 2]) * size('c', axes[k + 1]));
  return sum;
}

Inputs draw_vectors(Random& random, const std::string& vectors, bool words) {
  Inputs inputs;
  const int sort = random.integer(0, 2);
  for (const char vector : vectors)
    for (const char end : {'0', '1'})
      for (const char axis : {'x', 'y', 'z'}) {
        const std::string name{vector, end, axis};
        double& c = inputs[name];
        c = sort == 0 ? random.integer(-1, 1) : random.uniform(-1, 1);
        if (sort == 1) c = std::copysign(1 - std::abs(c) * 0x1p-40, c);
        if (words) inputs[name + ".lo"] = random.uniform(-1, 1) * 0x1p-54 * std::abs(c);
      }
  const double t = random.uniform();
  const double s = random.uniform();
  inputs["t"] = std::min(t, s);
  inputs["s"] = std::max(t, s);
  return inputs;
}

}  // namespace nearmiss::proofs

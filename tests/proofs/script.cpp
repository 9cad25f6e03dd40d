#include "tests/proofs/script.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace nearmiss::proofs {

std::string dyadic(double number) {
  if (number == 0) return "0";
  int exponent = 0;
  auto mantissa = static_cast<long long>(std::ldexp(std::frexp(number, &exponent), 53));
  for (exponent -= 53; mantissa % 2 == 0; ++exponent) mantissa /= 2;
  if (exponent == 0) return fmt::format("{}", mantissa);
  return fmt::format("{}b{}", mantissa, exponent);
}

std::string interval(double lowest, double highest) {
  return fmt::format("[{}, {}]", dyadic(lowest), dyadic(highest));
}

std::string Script::computed(int index) const {
  return fmt::format("{}{}", inexact_.contains(index) ? "c" : "e", index);
}

std::vector<std::string> Script::results() const {
  std::vector<std::string> all;
  for (const int index : inexact_) all.push_back(computed(index));
  return all;
}

std::string Script::exact(int index) { return fmt::format("e{}", index); }

void Script::suppose(const std::string& expression, double lowest, double highest) {
  hypotheses_.push_back(fmt::format("{} in {}", expression, interval(lowest, highest)));
}

void Script::define(const std::string& name, const std::string& expression) {
  definitions_.push_back(fmt::format("{} = {};", name, expression));
}

void Script::write(int index) {
  if (!written_.insert(index).second) return;
  if (const auto leaf = leaves_.find(index); leaf != leaves_.end()) {
    write_leaf(index, leaf->second);
    return;
  }
  const Instruction& one = program_[index];
  if (one.left >= 0) write(one.left);
  if (one.right >= 0) write(one.right);
  if (one.operation == Operation::constant) {
    write_constant(index, one.constant);
  } else if (one.operation == Operation::epsilon) {
    write_constant(index, std::ldexp(1, 1 - arithmetic_.bits));
  } else {
    write_operation(index);
    if (const auto fact = facts_.find(index); fact != facts_.end())
      suppose(exact(index), fact->second.lowest, fact->second.highest);
  }
}

void Script::write_leaf(int index, const Leaf& leaf) {
  suppose(exact(index), leaf.lowest, leaf.highest);
  if (leaf.kind == Leaf::ErrorKind::none) return;
  inexact_.insert(index);
  const char* compared = leaf.kind == Leaf::ErrorKind::relative ? "-/" : "-";
  suppose(fmt::format("{} {} {}", computed(index), compared, exact(index)), -leaf.error, leaf.error);
}

// A constant that has more bits than the arithmetic is rounded once.
void Script::write_constant(int index, double value) {
  define(exact(index), dyadic(value));
  int exponent = 0;
  const double bits = std::ldexp(std::frexp(value, &exponent), std::min(arithmetic_.bits, 53));
  if (bits == std::floor(bits)) return;
  inexact_.insert(index);
  suppose(fmt::format("{} -/ {}", computed(index), exact(index)), -std::ldexp(1, -arithmetic_.bits),
          std::ldexp(1, -arithmetic_.bits));
}

// Writes the result of an operation as a new variable, with its rounding error and its error by underflow.
void Script::rounded(int index, const std::string& result) {
  inexact_.insert(index);
  const Operation operation = program_[index].operation;
  const bool may_underflow =
      operation != Operation::add && operation != Operation::subtract && arithmetic_.underflow;
  const std::string normal = may_underflow ? fmt::format("m{}", index) : computed(index);
  const double u = std::ldexp(1, -arithmetic_.bits);
  suppose(fmt::format("{} -/ ({})", normal, result), -u, u);
  hints_.push_back(fmt::format("{} ~ {};", computed(index), exact(index)));
  if (!may_underflow) return;
  const double most = std::ldexp(1, *arithmetic_.underflow);
  suppose(fmt::format("{} - {}", computed(index), normal), -most, most);
}

// Writes the result of an exact operation.
void Script::unrounded(int index, const std::string& result) {
  const auto is_exact = [&](int operand) { return operand < 0 || !inexact_.contains(operand); };
  if (is_exact(program_[index].left) && is_exact(program_[index].right)) return;
  inexact_.insert(index);
  define(computed(index), result);
}

namespace {

bool is_power_of_two(const Instruction& one) {
  int exponent = 0;
  return one.operation == Operation::constant && std::abs(std::frexp(one.constant, &exponent)) == 0.5;
}

char sign_of(Operation operation) {
  switch (operation) {
    case Operation::add:
      return '+';
    case Operation::subtract:
      return '-';
    case Operation::multiply:
      return '*';
    case Operation::divide:
      return '/';
    default:
      throw std::runtime_error("this expression needs a lemma");
  }
}

}  // namespace

void Script::write_operation(int index) {
  const Instruction& one = program_[index];
  const std::string e = exact(one.left);
  const std::string c = computed(one.left);
  if (one.operation == Operation::negate) {
    define(exact(index), fmt::format("-{}", e));
    return unrounded(index, fmt::format("-{}", c));
  }
  if (one.right < 0) throw std::runtime_error("this expression needs a lemma");
  const std::string e2 = exact(one.right);
  const std::string c2 = computed(one.right);
  const char sign = sign_of(one.operation);
  define(exact(index), fmt::format("{} {} {}", e, sign, e2));
  const std::string result = fmt::format("{} {} {}", c, sign, c2);
  const bool is_exact = one.operation == Operation::multiply &&
                        (is_power_of_two(program_[one.left]) || is_power_of_two(program_[one.right]));
  if (arithmetic_.vectors_alone || is_exact) return unrounded(index, result);
  rounded(index, result);
  if (one.operation != Operation::divide || !inexact_.contains(one.right)) return;
  hints_.push_back(fmt::format(
      "{0} / {1} - {2} / {3} -> (({0} - {2}) - ({1} - {3}) * ({2} / {3})) / {1} {{ {1} <> 0, {3} <> 0 }};", c,
      c2, e, e2));
}

void Script::difference(int left, int right) {
  if (program_[right].operation == Operation::constant && program_[right].constant == 0)
    return define("d", fmt::format("{} - {}", computed(left), exact(left)));
  define("cd", fmt::format("{} - {}", computed(left), computed(right)));
  define("ed", fmt::format("{} - {}", exact(left), exact(right)));
  define("d", "cd - ed");
}

std::string Script::text(const std::vector<std::string>& goals) const {
  return fmt::format("{}\n{{ {}\n->\n{} }}\n{}\n", fmt::join(definitions_, "\n"),
                     fmt::join(hypotheses_, " /\\\n  "), fmt::join(goals, " /\\\n  "),
                     fmt::join(hints_, "\n"));
}

}  // namespace nearmiss::proofs

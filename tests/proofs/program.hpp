// Converts expressions to a list of instructions without duplicates.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "tests/proofs/traced.hpp"

namespace nearmiss::proofs {

/// One operation on results of earlier instructions.
struct Instruction {
  Operation operation;
  int left = -1, right = -1;  ///< indices of the operands; -1 without an operand
  double constant = 0;        ///< value of a constant
  std::string name{};         ///< name of an input
};

/// Instructions for any number of expressions, operands first. The same operation on the same operands is one
/// instruction, even if the template computes it several times.
class Program {
 public:
  /// The index of an expression's result. Adds the instructions that the program does not have yet.
  int add(const Traced& expression) { return add(*expression.node()); }
  int add(const Node& node);

  [[nodiscard]] std::size_t size() const { return instructions_.size(); }
  [[nodiscard]] const Instruction& operator[](int index) const {
    return instructions_[static_cast<std::size_t>(index)];
  }

 private:
  using InstructionKey = std::tuple<Operation, int, int, std::uint64_t, std::string>;

  std::vector<Instruction> instructions_;
  std::map<InstructionKey, int> known_;
};

inline int Program::add(const Node& node) {
  Instruction one{.operation = node.operation, .name = node.name};
  if (node.left) one.left = add(*node.left);
  if (node.right) one.right = add(*node.right);
  if (node.operation == Operation::constant) one.constant = node.value;
  const InstructionKey key{one.operation, one.left, one.right, std::bit_cast<std::uint64_t>(one.constant),
                           one.name};
  const auto [place, is_new] = known_.emplace(key, static_cast<int>(instructions_.size()));
  if (is_new) instructions_.push_back(std::move(one));
  return place->second;
}

/// The result of one instruction, computed from earlier results or taken from the inputs.
template <class Number>
Number result_of(const Instruction& one, const std::vector<Number>& results,
                 const std::map<std::string, Number>& inputs, const Number& epsilon) {
  using std::abs;
  using std::max;
  using std::min;
  using std::sqrt;
  const auto operand = [&](int index) -> const Number& { return results[static_cast<std::size_t>(index)]; };
  switch (one.operation) {
    case Operation::input:
      return inputs.at(one.name);
    case Operation::constant:
      return Number(one.constant);
    case Operation::epsilon:
      return epsilon;
    case Operation::negate:
      return -operand(one.left);
    case Operation::absolute:
      return abs(operand(one.left));
    case Operation::largest:
      return max(operand(one.left), operand(one.right));
    case Operation::smallest:
      return min(operand(one.left), operand(one.right));
    case Operation::add:
      return operand(one.left) + operand(one.right);
    case Operation::subtract:
      return operand(one.left) - operand(one.right);
    case Operation::multiply:
      return operand(one.left) * operand(one.right);
    case Operation::divide:
      return operand(one.left) / operand(one.right);
    case Operation::root:
      break;
  }
  if constexpr (requires(const Number& x) { sqrt(x); }) return sqrt(operand(one.left));
  throw std::domain_error("no exact square root");
}

/// The results of all instructions in the arithmetic of `Number`: rounded for floating-point numbers, exact
/// for rational ones. If `given` has the result of an instruction, the function takes this result instead of
/// computing it.
template <class Number>
std::vector<Number> evaluate(const Program& program, const std::map<std::string, Number>& inputs,
                             const Number& epsilon, const std::map<int, Number>& given = {}) {
  std::vector<Number> results;
  results.reserve(program.size());
  for (int i = 0; i < static_cast<int>(program.size()); ++i) {
    const auto known = given.find(i);
    results.push_back(known != given.end() ? known->second : result_of(program[i], results, inputs, epsilon));
  }
  return results;
}

}  // namespace nearmiss::proofs

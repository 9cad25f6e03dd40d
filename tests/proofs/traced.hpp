// A scalar that records the operations on it. A template that computes with this scalar yields the formula of
// the template.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace nearmiss::proofs {

/// The operation of a node. Operations from `add` on round their results once, to nearest; all operations
/// before `add` are exact.
enum class Operation : std::uint8_t {
  input,     ///< an exact number with a name
  constant,  ///< an exact number with a value
  epsilon,   ///< 2u, twice the largest relative error of one rounding
  negate,
  absolute,
  largest,   ///< the larger of two numbers
  smallest,  ///< the smaller of two numbers
  add,
  subtract,
  multiply,
  divide,
  root,  ///< the square root
};

class Traced;
class Trace;

/// One operation with its operands; immutable, and shared by all expressions that contain it.
struct Node {
  Operation operation = Operation::constant;
  std::shared_ptr<const Node> left{}, right{};  ///< null if the operation has no such operand
  /// The value of a constant. For any other node, the value of its expression if each input has its sample
  /// value.
  double value = 0;
  std::string name{};      ///< the name of an input
  Trace* trace = nullptr;  ///< the trace of the expression's inputs; null if the expression has no inputs
};

/// A comparison that a template made: left < right, left <= right or left == right. The template then takes
/// the branch of the outcome, so only the operations of this branch are recorded. Therefore a proof about
/// these operations must have the outcome as a hypothesis, or must not depend on it.
struct Branch {
  enum class Relation : std::uint8_t { less, at_most, equal } relation;
  std::shared_ptr<const Node> left, right;
  bool outcome;
};

/// The inputs of expressions, and the comparisons between the expressions. The trace must outlive the last
/// comparison of these expressions, and cannot be moved.
class Trace {
 public:
  Trace() = default;
  Trace(const Trace&) = delete;
  Trace& operator=(const Trace&) = delete;

  /// Adds an exact number; its value `sample` decides comparisons.
  Traced input(std::string name, double sample);

  [[nodiscard]] const std::vector<Branch>& branches() const { return branches_; }
  void record(Branch branch) { branches_.push_back(std::move(branch)); }

 private:
  std::vector<Branch> branches_;
};

/// A scalar for the templates of ccd/ and oracle/. Each operation makes a node. The trace records comparisons
/// of expressions that contain inputs; the inputs' samples decide these comparisons. `max`, `min` and `clamp`
/// are found by argument-dependent lookup. They make nodes and compare nothing, whereas std::max itself would
/// make a comparison, which the trace would record.
class Traced {
 public:
  Traced(double constant = 0)
      : node_(std::make_shared<Node>(Node{.operation = Operation::constant, .value = constant})) {}
  explicit Traced(std::shared_ptr<const Node> node) : node_(std::move(node)) {}

  [[nodiscard]] const std::shared_ptr<const Node>& node() const { return node_; }
  /// The value at the inputs' samples, in double.
  [[nodiscard]] double sample() const { return node_->value; }
  explicit operator double() const { return sample(); }

  friend Traced operator-(const Traced& a) { return made(Operation::negate, -a.sample(), a); }
  friend Traced operator+(const Traced& a, const Traced& b) {
    return made(Operation::add, a.sample() + b.sample(), a, &b);
  }
  friend Traced operator-(const Traced& a, const Traced& b) {
    return made(Operation::subtract, a.sample() - b.sample(), a, &b);
  }
  friend Traced operator*(const Traced& a, const Traced& b) {
    return made(Operation::multiply, a.sample() * b.sample(), a, &b);
  }
  friend Traced operator/(const Traced& a, const Traced& b) {
    return made(Operation::divide, a.sample() / b.sample(), a, &b);
  }
  Traced& operator+=(const Traced& b) { return *this = *this + b; }
  Traced& operator-=(const Traced& b) { return *this = *this - b; }
  Traced& operator*=(const Traced& b) { return *this = *this * b; }
  Traced& operator/=(const Traced& b) { return *this = *this / b; }

  friend Traced abs(const Traced& a) { return made(Operation::absolute, std::abs(a.sample()), a); }
  friend Traced sqrt(const Traced& a) { return made(Operation::root, std::sqrt(a.sample()), a); }
  friend Traced max(const Traced& a, const Traced& b) {
    return made(Operation::largest, std::max(a.sample(), b.sample()), a, &b);
  }
  friend Traced min(const Traced& a, const Traced& b) {
    return made(Operation::smallest, std::min(a.sample(), b.sample()), a, &b);
  }
  friend Traced clamp(const Traced& a, const Traced& lowest, const Traced& highest) {
    return min(max(a, lowest), highest);
  }
  friend Traced ldexp(const Traced& a, int exponent) { return a * std::ldexp(1.0, exponent); }
  friend bool isfinite(const Traced& a) { return std::isfinite(a.sample()); }

  friend bool operator<(const Traced& a, const Traced& b) {
    return decided(Branch::Relation::less, a, b, a.sample() < b.sample());
  }
  friend bool operator<=(const Traced& a, const Traced& b) {
    return decided(Branch::Relation::at_most, a, b, a.sample() <= b.sample());
  }
  friend bool operator==(const Traced& a, const Traced& b) {
    return decided(Branch::Relation::equal, a, b, a.sample() == b.sample());
  }
  friend bool operator>(const Traced& a, const Traced& b) { return b < a; }
  friend bool operator>=(const Traced& a, const Traced& b) { return b <= a; }
  friend bool operator!=(const Traced& a, const Traced& b) { return !(a == b); }

 private:
  static Traced made(Operation operation, double value, const Traced& a, const Traced* b = nullptr) {
    const bool alone = b == nullptr || a.node_->trace != nullptr;
    return Traced(std::make_shared<Node>(Node{.operation = operation,
                                              .left = a.node_,
                                              .right = b != nullptr ? b->node_ : nullptr,
                                              .value = value,
                                              .trace = alone ? a.node_->trace : b->node_->trace}));
  }

  static bool decided(Branch::Relation relation, const Traced& a, const Traced& b, bool outcome) {
    Trace* trace = a.node_->trace != nullptr ? a.node_->trace : b.node_->trace;
    if (trace != nullptr) trace->record({relation, a.node_, b.node_, outcome});
    return outcome;
  }

  std::shared_ptr<const Node> node_;
};

inline Traced Trace::input(std::string name, double sample) {
  return Traced(std::make_shared<Node>(
      Node{.operation = Operation::input, .value = sample, .name = std::move(name), .trace = this}));
}

}  // namespace nearmiss::proofs

template <>
struct std::numeric_limits<nearmiss::proofs::Traced> : std::numeric_limits<double> {
  static nearmiss::proofs::Traced epsilon() {
    using namespace nearmiss::proofs;
    return Traced(std::make_shared<Node>(
        Node{.operation = Operation::epsilon, .value = std::numeric_limits<double>::epsilon()}));
  }
  static nearmiss::proofs::Traced infinity() { return std::numeric_limits<double>::infinity(); }
  static nearmiss::proofs::Traced max() { return std::numeric_limits<double>::max(); }
};

/// The costs of the operations are those of double, so that Eigen adds these scalars in the order in which
/// Eigen adds doubles without vector instructions.
template <>
struct Eigen::NumTraits<nearmiss::proofs::Traced> : Eigen::NumTraits<double> {
  using Real = nearmiss::proofs::Traced;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = double;
  enum { RequireInitialization = 1 };
};

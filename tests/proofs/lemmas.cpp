#include "tests/proofs/lemmas.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace nearmiss::proofs {

namespace {

/// Parses a number that Gappa prints, an integer of at most 60 bits with or without a power of two, and
/// rounds it upward.
double at_least(const std::string& text) {
  char* end = nullptr;
  const auto mantissa = static_cast<long double>(std::strtoll(text.c_str(), &end, 10));
  const long exponent = *end == 'b' ? std::strtol(end + 1, nullptr, 10) : 0;
  const long double exact = std::ldexp(mantissa, static_cast<int>(exponent));
  const auto near = static_cast<double>(exact);
  return near < exact ? std::nextafter(near, std::numeric_limits<double>::infinity()) : near;
}

double at_most(std::string text) {
  text = text.starts_with('-') ? text.substr(1) : fmt::format("-{}", text);
  return -at_least(text);
}

bool is_extreme(Operation operation) {
  return operation == Operation::absolute || operation == Operation::largest ||
         operation == Operation::smallest;
}

/// Hints for Gappa about a position X = D + t V between D and E. X is a convex combination of D and E, whose
/// magnitudes are at most `reach`, so |X| is at most `reach`, too. The hints also serve for the part of X's
/// error that the errors of D and E cause. This part is a convex combination of the errors of D and E, so
/// `reach` is then the bound of these two errors. From the hints, interval arithmetic derives that reach - X
/// and reach + X are not negative, because both are sums of products of nonnegative numbers.
std::string convex_hints(const char* combination, const char* start, const char* end, double reach) {
  return fmt::format(
      "{0} -> {3} - ((1 - t) * ({3} - {1}) + t * ({3} - {2}));\n"
      "{0} -> ((1 - t) * ({1} + {3}) + t * ({2} + {3})) - {3};\n",
      combination, start, end, dyadic(reach));
}

/// Writes scripts that bound the position X = D + t V of a moving vector, and the error of x, its computed
/// position.
class MotionScript {
 public:
  MotionScript(const BoundedMotion& motion, const Arithmetic& arithmetic)
      : arithmetic_(arithmetic),
        ranges_(fmt::format("D in {} /\\ E in {} /\\ V in {} /\\ t in [0, 1]",
                            interval(-motion.start, motion.start), interval(-motion.end, motion.end),
                            interval(-motion.velocity, motion.velocity))),
        reach_(std::max(motion.start, motion.end)) {
    if (!arithmetic.underflow) return;
    const double most = std::ldexp(1, *arithmetic.underflow);
    ranges_ += " /\\ w - m in " + interval(-most, most);
  }

  /// The script for a motion whose computed start and velocity are exactly D and V.
  [[nodiscard]] std::string exact() const {
    return fmt::format(
        "X = D + t * V;\nE = D + V;\n{}{{ {}{} ->\nX in ? /\\ x - X in ? }}\n{}"
        "x - X -> (x - (D + w)) + (w - t * V);\n",
        moved("D", "V"), ranges_, roundings("D", "V"), convex_hints("X", "D", "E", reach_));
  }

  /// The script for a motion whose ends D and E are rounded to d and e, and whose computed velocity v is the
  /// rounded difference e - d.
  [[nodiscard]] std::string rounded() const {
    const double u = std::ldexp(1, -arithmetic_.bits);
    return fmt::format(
               "V = E - D;\nX = D + t * V;\n{0}k = (d + t * (e - d)) - X;\n"
               "{{ {1} /\\ d -/ D in {2} /\\ e -/ E in {2} /\\ v -/ (e - d) in {2}{3} ->\n"
               "X in ? /\\ v - V in ? /\\ x - X in ? }}\n",
               moved("d", "v"), ranges_, interval(-u, u), roundings("d", "v")) +
           convex_hints("X", "D", "E", reach_) + convex_hints("k", "(d - D)", "(e - E)", u * reach_) +
           "x - X -> (x - (d + w)) + ((w - t * v) + t * (v - (e - d)) + k);\n"
           "d + w -> X + ((w - t * v) + t * (v - (e - d)) + k);\n";
  }

 private:
  /// If only the vectors are rounded (`vectors_alone`), the definition of x = d + t v without rounding.
  [[nodiscard]] std::string moved(const char* d, const char* v) const {
    return arithmetic_.vectors_alone ? fmt::format("w = t * {};\nx = {} + w;\n", v, d) : "";
  }
  /// Hypotheses about the roundings of x = d + t v.
  [[nodiscard]] std::string roundings(const char* d, const char* v) const {
    if (arithmetic_.vectors_alone) return "";
    const double u = std::ldexp(1, -arithmetic_.bits);
    return fmt::format(" /\\ {0} -/ (t * {1}) in {2} /\\ x -/ ({3} + w) in {2}",
                       arithmetic_.underflow ? "m" : "w", v, interval(-u, u), d);
  }

  Arithmetic arithmetic_;
  std::string ranges_;
  double reach_;
};

}  // namespace

std::map<std::string, ProvenRange> bounds_in(const std::string& output) {
  std::map<std::string, ProvenRange> bounds;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    const auto in = line.find(" in [");
    if (in == std::string::npos) continue;
    const auto name = line.find_first_not_of(' ');
    const std::string lowest = line.substr(in + 5);
    const auto comma = line.find(", ", line.find('}', in) < line.rfind('{') ? line.find('}', in) : in);
    bounds[line.substr(name, in - name)] = {at_most(lowest), at_least(line.substr(comma + 2))};
  }
  return bounds;
}

Lemmas::Lemmas(Prover& prover, const Problem& problem, const Arithmetic& arithmetic)
    : prover_(prover),
      arithmetic_(arithmetic),
      left_(program_.add(problem.left)),
      right_(program_.add(problem.right)) {
  for (const BoundedExpression& input : problem.inputs)
    leaves_[program_.add(input.expression)] = {input.lowest, input.highest};
  for (const BoundedExpression& fact : problem.facts)
    facts_[program_.add(fact.expression)] = {fact.lowest, fact.highest};
  for (const BoundedMotion& motion : problem.motions) know_motion(motion, problem.time);
  know_extremes();
}

void Lemmas::know_motion(const BoundedMotion& motion, const Traced& time) {
  const double u = std::ldexp(1, -arithmetic_.bits);
  const double reach = std::max(motion.start, motion.end);
  const auto at = motion.vector.at(time);
  const int t = program_.add(time);
  for (int i = 0; i < 3; ++i) {
    const int x = program_.add(motion.vector.xv[i]);
    const int v = program_.add(motion.vector.xv[i + 3]);
    const int moved = program_.add(at[i]);
    const Instruction& sum = program_[moved];
    const Instruction& change = program_[sum.right];
    if (sum.operation != Operation::add || sum.left != x || change.operation != Operation::multiply ||
        change.left != t || change.right != v)
      throw std::runtime_error("a position at a time is no longer x + t v");
    const bool rounded = program_[x].operation == Operation::subtract;
    const MotionScript script(motion, arithmetic_);
    const auto found = bounds_in(prover_.run(rounded ? script.rounded() : script.exact()).text);
    const auto error = rounded ? Leaf::ErrorKind::absolute : Leaf::ErrorKind::none;
    leaves_[x] = {-motion.start, motion.start, rounded ? Leaf::ErrorKind::relative : Leaf::ErrorKind::none,
                  u};
    leaves_[v] = {-motion.velocity, motion.velocity, error, rounded ? found.at("v - V").magnitude() : 0};
    leaves_[moved] = {-reach, reach, Leaf::ErrorKind::absolute, found.at("x - X").magnitude()};
  }
}

std::set<int> Lemmas::needed() {
  std::set<int> all;
  std::vector<int> open{left_, right_};
  while (!open.empty()) {
    const int index = open.back();
    open.pop_back();
    if (index < 0 || !all.insert(index).second || leaves_.contains(index)) continue;
    open.push_back(program_[index].left);
    open.push_back(program_[index].right);
  }
  return all;
}

// An extreme (a maximum, a minimum or a magnitude) is a leaf if an operation that is not an extreme uses it.
// In a program, the operands of an instruction have lower indices than the instruction, so the lemmas of the
// operands come first.
void Lemmas::know_extremes() {
  const std::set<int> all = needed();
  std::set<int> used{left_, right_};
  for (const int index : all) {
    if (is_extreme(program_[index].operation) || leaves_.contains(index)) continue;
    used.insert(program_[index].left);
    used.insert(program_[index].right);
  }
  for (const int index : all)
    if (used.contains(index) && is_extreme(program_[index].operation)) know_extreme(index);
}

void Lemmas::operands(int index, std::set<int>& found) {
  if (leaves_.contains(index) || !is_extreme(program_[index].operation)) {
    found.insert(index);
    return;
  }
  operands(program_[index].left, found);
  if (program_[index].right >= 0) operands(program_[index].right, found);
}

ProvenRange Lemmas::range(int index, const std::map<int, ProvenRange>& known) {
  if (const auto operand = known.find(index); operand != known.end()) return operand->second;
  const Instruction& one = program_[index];
  const ProvenRange a = range(one.left, known);
  if (one.operation == Operation::absolute) return {0, a.magnitude()};
  const ProvenRange b = range(one.right, known);
  if (one.operation == Operation::largest)
    return {std::max(a.lowest, b.lowest), std::max(a.highest, b.highest)};
  return {std::min(a.lowest, b.lowest), std::min(a.highest, b.highest)};
}

void Lemmas::know_extreme(int index) {
  std::set<int> found;
  operands(index, found);
  Script lemma = script();
  std::vector<std::string> goals;
  for (const int each : found) {
    lemma.write(each);
    if (program_[each].operation == Operation::constant) continue;
    goals.push_back(fmt::format("{} in ?", Script::exact(each)));
    if (lemma.computed(each) != Script::exact(each))
      goals.push_back(fmt::format("{} - {} in ?", lemma.computed(each), Script::exact(each)));
  }
  const auto bounds = bounds_in(prover_.run(lemma.text(goals)).text);
  std::map<int, ProvenRange> ranges;
  double error = 0;
  for (const int each : found) {
    const Instruction& one = program_[each];
    const bool constant = one.operation == Operation::constant;
    ranges[each] = constant ? ProvenRange{one.constant, one.constant} : bounds.at(Script::exact(each));
    const auto difference = bounds.find(fmt::format("{} - {}", lemma.computed(each), Script::exact(each)));
    if (difference != bounds.end()) error = std::max(error, difference->second.magnitude());
  }
  ProvenRange all = range(index, ranges);
  if (const auto fact = facts_.find(index); fact != facts_.end())
    all = {std::max(all.lowest, fact->second.lowest), std::min(all.highest, fact->second.highest)};
  leaves_[index] = {all.lowest, all.highest, error == 0 ? Leaf::ErrorKind::none : Leaf::ErrorKind::absolute,
                    error};
}

Script Lemmas::last() {
  Script last = script();
  last.write(left_);
  last.write(right_);
  last.difference(left_, right_);
  return last;
}

std::string Lemmas::script_of_bounds() {
  const Script all = last();
  std::vector<std::string> goals{"d in ?"};
  for (const std::string& result : all.results()) goals.push_back(fmt::format("{} in ?", result));
  return all.text(goals);
}

}  // namespace nearmiss::proofs

#include "tests/proofs/measure.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <type_traits>
#include <utility>

namespace nearmiss::proofs {

Measure::Measure(const CcdClaim& claim) : vectors_alone_(claim.vectors_alone) {
  const Problem problem = claim.problem();
  left_ = program_.add(problem.left);
  right_ = program_.add(problem.right);
  degree_ = problem.degree;
  for (const BoundedMotion& motion : problem.motions) {
    const double most[] = {motion.start, motion.end, motion.velocity};
    for (int i = 0; i < 3; ++i) {
      const Traced& x = motion.vector.xv[i];
      const Traced& v = motion.vector.xv[i + 3];
      vectors_.insert(vectors_.end(), {program_.add(x), program_.add(v)});
      limit(x, -most[0], most[0], 1);
      limit(x + v, -most[1], most[1], 1);
      limit(v, -most[2], most[2], 1);
    }
  }
  for (const auto* ranges : {&problem.inputs, &problem.facts})
    for (const BoundedExpression& each : *ranges)
      limit(each.expression, each.lowest, each.highest, each.degree);
  for (const BoundedExpression& input : problem.inputs) {
    const int index = program_.add(input.expression);
    if (program_[index].operation != Operation::input) given_[index] = "given";
  }
  if (!given_.empty()) names_.emplace_back("given");
  for (int i = 0; i < static_cast<int>(program_.size()); ++i)
    if (program_[i].operation == Operation::input) names_.push_back(program_[i].name);
}

void Measure::limit(const Traced& expression, double lowest, double highest, int degree) {
  limits_.push_back({program_.add(expression), lowest, highest, degree});
}

template <class Number>
std::vector<Number> Measure::results(const Inputs& inputs) const {
  std::map<std::string, Number> values;
  for (const auto& [name, value] : inputs) values.emplace(name, value);
  std::map<int, Number> given;
  for (const auto& [index, name] : given_) given.emplace(index, Number(inputs.at(name)));
  return evaluate<Number>(program_, values, Number(0x1p-52), given);
}

// Computes the pair's bound B from the limits of degree 1 only. The limits of higher degree are then checked
// for this B.
template <class Number>
Number Measure::smallest_bound(const std::vector<Number>& exact) const {
  Number B = 0;
  for (const Limit& each : limits_) {
    if (each.degree != 1) continue;
    const Number& value = exact[static_cast<std::size_t>(each.index)];
    const Number needed = Number(value < 0 ? -value : value) / Number(each.highest);
    if (B < needed) B = needed;
  }
  return B;
}

template <class Number>
std::optional<double> Measure::measured(const Inputs& inputs) const {
  const auto exact = results<Number>(inputs);
  const auto rounded = results<double>(inputs);
  const Number B = smallest_bound(exact);
  const auto power = [&B](int degree) {
    Number product = 1;
    for (int i = 0; i < degree; ++i) product *= B;
    return product;
  };
  for (const Limit& each : limits_) {
    const Number& value = exact[static_cast<std::size_t>(each.index)];
    const Number unit = power(each.degree);
    if (value < Number(each.lowest) * unit || Number(each.highest) * unit < value) return std::nullopt;
  }
  const auto at = [](const auto& all, int index) { return Number(all[static_cast<std::size_t>(index)]); };
  Number computed = at(rounded, left_) - at(rounded, right_);
  if (vectors_alone_) {
    std::map<std::string, Number> values;
    for (const auto& [name, value] : inputs) values.emplace(name, value);
    std::map<int, Number> given;
    for (const int index : vectors_) given.emplace(index, at(rounded, index));
    for (const auto& [index, name] : given_) given.emplace(index, Number(inputs.at(name)));
    const auto mixed = evaluate<Number>(program_, values, Number(0x1p-52), given);
    computed = at(mixed, left_) - at(mixed, right_);
  }
  const Number error = computed - (at(exact, left_) - at(exact, right_));
  const Number unit = power(degree_) * Number(0x1p-52);
  if (unit == 0) return std::nullopt;
  return static_cast<double>(Number(error < 0 ? -error : error) / unit);
}

bool Measure::has_inputs(const Inputs& inputs) const {
  return inputs.size() == names_.size() &&
         std::all_of(names_.begin(), names_.end(), [&](const auto& name) { return inputs.contains(name); });
}

double Measure::draw(Random& random, const std::string& name) const {
  const bool is_part = name == "t" || name == "eta" || name == "S" || name == "given";
  const double sign = is_part || random.one_in(2) ? 1 : -1;
  if (is_part && random.one_in(3)) return 1 - random.log_uniform(1e-17, 1);
  switch (random.integer(0, 4)) {
    case 0:
      return sign * (1 - random.log_uniform(1e-17, 1));
    case 1:
      return is_part ? random.uniform() : sign * (1 + random.log_uniform(1e-16, 1));
    case 2:
      return sign * random.log_uniform(1e-6, 1);
    case 3:
      return is_part ? 1 : 0;
    default:
      return sign * random.uniform();
  }
}

// Sets the input B, if the problem has this input, to the smallest B that the other inputs allow, or to a
// slightly larger number.
void Measure::choose_bound(Inputs& inputs) const {
  const auto B = inputs.find("B");
  if (B == inputs.end()) return;
  B->second = 0;
  B->second = static_cast<double>(smallest_bound(results<long double>(inputs))) * (1 + 0x1p-52);
}

Inputs Measure::drawn(Random& random) const {
  Inputs inputs;
  for (const std::string& name : names_) inputs[name] = draw(random, name);
  choose_bound(inputs);
  return inputs;
}

Inputs Measure::changed(Random& random, const Inputs& inputs) const {
  Inputs next = inputs;
  for (int count = random.integer(1, 3); count > 0; --count) {
    const auto which = static_cast<std::size_t>(random.integer(0, static_cast<int>(names_.size()) - 1));
    double& value = next.at(names_[which]);
    const auto other = static_cast<std::size_t>(random.integer(0, static_cast<int>(names_.size()) - 1));
    switch (random.integer(0, 5)) {
      case 0:
        value = draw(random, names_[which]);
        break;
      case 1:
        std::swap(value, next.at(names_[other]));
        break;
      case 2:
        value = -value;
        break;
      default:
        value *= 1 + random.uniform(-1, 1) * random.log_uniform(1e-16, 1e-1);
    }
  }
  choose_bound(next);
  return next;
}

namespace {

/// The inputs with the largest error that a climb finds when it starts from random inputs or from known
/// inputs. `seen` gives the error of inputs, or an estimate of it.
template <class Draw, class Change, class Seen>
Inputs climbed(const Inputs& known, const ClimbEffort& effort, const Draw& draw, const Change& change,
               const Seen& seen) {
  const auto begin = [&](Random& random) { return known.empty() || random.one_in(2) ? draw(random) : known; };
  return highest(effort, begin, change, seen).problem;
}

Inputs changed(Inputs inputs, const OracleClaim& claim, Random& random) {
  const auto name = std::next(inputs.begin(), random.integer(0, static_cast<int>(inputs.size()) - 1));
  double& value = name->second;
  switch (random.integer(0, 3)) {
    case 0:
      value = claim.draw(random)[name->first];
      break;
    case 1:
      value *= 1 + std::ldexp(random.uniform(-1, 1), -random.integer(0, 50));
      break;
    case 2:
      for (int i = random.integer(1, 4); i > 0; --i)
        value = std::nextafter(value, random.one_in(2) ? 1e300 : -1e300);
      break;
    default:
      value = std::ldexp(std::round(std::ldexp(value, 8)), -8);  // few bits
  }
  return inputs;
}

/// Whether the lower halves of all double words are within half an ulp of the upper halves.
bool are_double_words(const Inputs& inputs) {
  return std::all_of(inputs.begin(), inputs.end(), [&](const auto& input) {
    const auto& [name, value] = input;
    if (!name.ends_with(".lo")) return true;
    const double upper = inputs.at(name.substr(0, name.size() - 3));
    return upper + value == upper;
  });
}

}  // namespace

Witness find_witness(const CcdClaim& claim, const Inputs& known, const ClimbEffort& effort) {
  const Measure measure(claim);
  const Inputs start = measure.has_inputs(known) ? known : Inputs{};
  const Inputs found = climbed(
      start, effort, [&](Random& random) { return measure.drawn(random); },
      [&](Random& random, const Inputs& inputs) { return measure.changed(random, inputs); },
      [&](const Inputs& inputs) { return measure.estimate(inputs).value_or(-1); });
  return {measure.error(found).value_or(0), found};
}

Witness find_witness(const OracleClaim& claim, const Inputs& known, const ClimbEffort& effort) {
  const auto seen = [&](const Inputs& inputs) { return are_double_words(inputs) ? claim.seen(inputs) : -1; };
  const Inputs found = climbed(
      known, effort, claim.draw,
      [&](Random& random, const Inputs& inputs) { return changed(inputs, claim, random); }, seen);
  return {seen(found), found};
}

}  // namespace nearmiss::proofs

#include "fuzz/trial/truth.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "fuzz/trial/signatures.hpp"
#include "oracle/distance.hpp"
#include "reports/statistics/statistics.hpp"

namespace nearmiss {

Truth::Truth(const Query& query) : query_(query) { decide(std::span(&query, 1), std::span(&decision_, 1)); }

Answers Truth::ask_methods() const {
  const bool by_exact_arithmetic = decision_.stage == FilterStage::undecided;
  return by_exact_arithmetic ? ask_others(query_, collision()) : ask_all(query_);
}

std::string Truth::disagreement(const Answers& answers) const {
  return disagreement_signature(query_.kind, answers, decision_.by_filter());
}

const std::string& Truth::contact() {
  if (contact_.empty()) contact_ = contact_signature(query_);
  return contact_;
}

Truth::Distance Truth::distance(double unit) {
  const auto same = [&](const auto& each) { return each.first == unit; };
  const auto known = std::find_if(distances_.begin(), distances_.end(), same);
  if (known != distances_.end()) return known->second;
  distances_.emplace_back(unit, measured_distance(unit));
  return distances_.back().second;
}

double Truth::precise_ratio(double unit, double ratio) const {
  if (Histogram::lower_border(ratio) == 0) return ratio;
  return std::min(closest_ratio(query_, unit), ratio);
}

Truth::Distance Truth::measured_distance(double unit) const {
  if (unit == 0) return {std::numeric_limits<double>::max(), true};  // any distance exceeds it
  const Enclosure ratio = distance_in_units(query_, unit, Histogram::lower_border);
  if (ratio.hi <= 1) return {ratio.hi, false};
  if (ratio.lo > 1 || distance_exceeds(query_, unit))
    return {std::min(ratio.hi, std::numeric_limits<double>::max()), true};
  return {1, false};
}

}  // namespace nearmiss

#include "fuzz/trial/truth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "ccd/subjects/subject.hpp"
#include "ccd/wang/pair_bound.hpp"
#include "fuzz/families/classify.hpp"
#include "fuzz/trial/signatures.hpp"
#include "oracle/agreement/checked.hpp"
#include "oracle/distance.hpp"
#include "reports/statistics/statistics.hpp"

namespace nearmiss {

Truth::Truth(const Query& query) : query_(query) { decide(std::span(&query, 1), std::span(&decision_, 1)); }

Answers Truth::ask_methods() const {
  const bool by_exact_arithmetic = decision_.stage == FilterStage::undecided;
  return by_exact_arithmetic ? ask_others(query_, to_answer(query_, decision_)) : ask_all(query_);
}

std::string Truth::disagreement(const Answers& answers) const {
  return disagreement_signature(query_.kind, nearmiss::disagreement(query_, decision_, answers));
}

const std::string& Truth::contact() {
  if (contact_.empty()) contact_ = contact_signature(query_);
  return contact_;
}

QueryClass Truth::query_class() {
  if (!query_class_) query_class_ = classify(query_);
  return *query_class_;
}

EarliestTime& Truth::time() {
  if (!time_) time_.emplace(query_, decision_.known);
  return *time_;
}

double Truth::relative_speed() const {
  const double B = pair_bound(query_);
  double fastest = 0;
  for (const VertexPair gap : topology(query_.kind).gaps) {
    // Lengths are measured in units of B, the size of the pair, so that they do not overflow.
    const auto moved = [&](int vertex) -> Vector3<double> {
      return query_.end(vertex) / B - query_.start(vertex) / B;
    };
    fastest = std::max(fastest, (moved(gap.from) - moved(gap.to)).norm());
  }
  return std::isfinite(fastest) ? fastest : 0;
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

bool Truth::exceeds(double unit) const {
  if (unit == 0) return true;  // the distance in a false positive is above the separation
  return distance_exceeds_separation_by(query_, unit);
}

Truth::Distance Truth::measured_distance(double unit) const {
  constexpr double most = std::numeric_limits<double>::max();
  if (unit == 0) return {most, true};
  const bool is_contact = query_.separation == 0;
  const Enclosure ratio = is_contact ? distance_in_units(query_, unit, Histogram::lower_border)
                                     : distance_beyond_separation(query_, unit, Histogram::lower_border);
  // If h = 0, the enclosure usually shows whether the distance is above the unit.
  const bool beyond = is_contact && ratio.hi <= 1 ? false : is_contact && ratio.lo > 1 ? true : exceeds(unit);
  return {std::min(ratio.hi, beyond ? most : 1.0), beyond};
}

}  // namespace nearmiss

#include "fuzz/questions/distance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "corpus/query_text.hpp"
#include "fuzz/families/contacts.hpp"
#include "fuzz/questions/question_trial.hpp"
#include "fuzz/search/maximiser.hpp"
#include "fuzz/search/search.hpp"
#include "fuzz/trial/signatures.hpp"
#include "oracle/certificates/certificate.hpp"
#include "oracle/distance.hpp"
#include "oracle/exact/polynomial.hpp"
#include "oracle/features.hpp"

namespace nearmiss {

Query at_rest(const Query& query) {
  Query rest = query;
  rest.separation = 0;
  std::copy_n(rest.x.begin(), 12, rest.x.begin() + 12);
  return rest;
}

namespace {

/// The largest side of the box around both primitives; the largest double if the side overflows.
double size_of(const Query& query) { return std::min(extent(query), std::numeric_limits<double>::max()); }

/// The error that the judge tolerates at this distance and size.
double tolerance(double distance, double size) {
  return std::max(DistanceError::part_of_distance * distance, DistanceError::part_of_size * size);
}

double quotient(double error, double length) {
  if (error == 0) return 0;
  return length > 0 ? error / length : std::numeric_limits<double>::infinity();
}

/// Whether the points with these weights are farther apart than `most`, decided exactly. The coordinates are
/// relative to x0: with absolute coordinates, weights whose sum is 1 - 2^-53 would move a point that is far
/// from the origin.
bool are_farther(const Query& query, std::span<const double> weights, double most) {
  using exact::Number;
  Number squared(0);
  for (std::size_t k = 0; k < 3; ++k) {
    Number difference(0);
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const Number part = Number(weights[i]) * (Number(query.x[3 * i + k]) - Number(query.x[k]));
      const bool is_first = i < static_cast<std::size_t>(split(query.kind));
      difference = is_first ? Number(difference + part) : Number(difference - part);
    }
    squared = squared + difference * difference;
  }
  return exact::sign(squared - Number(most) * Number(most)) > 0;
}

/// Whether weights that a subject gives are wrong. `most` is the largest distance that the points with these
/// weights may have.
bool are_wrong(const Query& query, const std::array<double, 4>& all, double most) {
  constexpr double tiny = 1e-6;
  const std::span weights(all.data(), static_cast<std::size_t>(vertices(query.kind)));
  if (std::ranges::all_of(weights, [](double w) { return std::isnan(w); })) return false;
  if (!std::ranges::all_of(weights, [](double w) { return w >= -tiny && w <= 1 + tiny; })) return true;
  const auto first = static_cast<std::size_t>(split(query.kind));
  for (const auto of_primitive : {weights.first(first), weights.subspan(first)}) {
    double sum = 0;
    for (const double w : of_primitive) sum += w;
    if (std::abs(sum - 1) > tiny) return true;
  }
  return std::isfinite(most) && are_farther(query, weights, most);
}

}  // namespace

double DistanceError::over_by_distance() const { return quotient(over, exact.lo); }
double DistanceError::under_by_distance() const { return quotient(under, exact.lo); }
double DistanceError::over_by_size() const { return std::min(quotient(over, size), 1.0); }
double DistanceError::under_by_size() const { return std::min(quotient(under, size), 1.0); }

double over_limit(const Query& query, double distance) {
  // nextafter lowers even the smallest doubles, which a division by 1.01 does not change.
  return std::min({distance / (1 + DistanceError::part_of_distance),
                   distance - DistanceError::part_of_size * size_of(query), std::nextafter(distance, 0)});
}

bool is_over_reported(const Query& query, double distance) {
  const double limit = over_limit(query, distance);
  return limit > 0 && !distance_exceeds(query, limit);
}

DistanceError error_of(const Query& query, const DistanceAnswer& answer) {
  constexpr double width = 0x1p-44;
  DistanceError error{.exact = minimum_distance(query, width), .size = size_of(query)};
  const auto& [lo, hi] = error.exact;
  if (answer.distance > hi) error.over = answer.distance - lo;
  if (answer.distance < lo) error.under = hi - answer.distance;
  error.over_reported = is_over_reported(query, answer.distance);
  const double least = answer.distance + tolerance(answer.distance, error.size);
  error.under_reported = error.under > 0 && std::isfinite(least) && distance_exceeds(query, least);
  error.wrong_weights = are_wrong(query, answer.weights, hi + tolerance(hi, error.size));
  return error;
}

std::optional<std::string_view> DistanceQuestion::Judged::failure() const {
  if (answer.fault != Fault::none) return "fault";
  if (error.over_reported) return "over-reported";
  if (error.wrong_weights) return "wrong-weights";
  return std::nullopt;
}

std::string_view DistanceQuestion::Judged::word() const {
  return failure().value_or(error.under_reported ? "under-reported" : "right");
}

std::string DistanceQuestion::Judged::answer_text() const { return to_hex(answer.distance); }

std::string DistanceQuestion::Judged::text() const {
  if (answer.fault != Fault::none) return std::string(word());
  return fmt::format("{}: {:.6g}; the distance is {:.6g}", word(), answer.distance, error.exact.hi);
}

std::string DistanceQuestion::Judged::certificate() const {
  if (!error.over_reported) return "";
  return certify_meets(nearmiss::with_separation(query, over_limit(query, answer.distance)), {}).value_or("");
}

void DistanceQuestion::Counts::add(const Judged& judged, QueryClass of,
                                   const std::function<std::string()>& provenance) {
  ++queries;
  const auto index = static_cast<std::size_t>(of);
  if (judged.answer.fault != Fault::none) {
    ++faults_by_class[index];
    return;
  }
  const DistanceError& error = judged.error;
  if (error.over > 0) {
    over_by_size.add(error.over_by_size());
    over_by_distance.add(error.over_by_distance());
    keep_farthest(largest_over, error.over_by_size(), judged.query, provenance);
  }
  if (error.under > 0) {
    under_by_size.add(error.under_by_size());
    under_by_distance.add(error.under_by_distance());
    keep_farthest(largest_under, error.under_by_size(), judged.query, provenance);
  }
  over_by_class[index] += error.over_reported ? 1 : 0;
  under_by_class[index] += error.under_reported ? 1 : 0;
  weights_by_class[index] += error.wrong_weights ? 1 : 0;
}

std::uint64_t DistanceQuestion::Counts::failures() const {
  return sum_that_counts(over_by_class) + sum_that_counts(weights_by_class) +
         sum_that_counts(faults_by_class);
}

std::optional<DistanceQuestion::Judged> DistanceQuestion::ask(const Subject& subject, const Query& query) {
  Judged judged{.query = subject.rounded(at_rest(query)), .answer = {}};
  judged.answer = subject.ask_distance(judged.query);
  const Fault fault = judged.answer.fault;
  if (fault == Fault::contract || fault == Fault::not_asked) return std::nullopt;
  if (fault == Fault::none) judged.error = error_of(judged.query, judged.answer);
  return judged;
}

std::string DistanceQuestion::signature(const Subject& subject, const Judged& judged) {
  const Kind kind = judged.query.kind;
  if (judged.answer.fault != Fault::none)
    return fault_signature(subject, kind, judged.answer.fault, judged.answer.fault_code);
  const double d = judged.error.exact.hi;
  std::string closest = "touching";
  if (const auto features =
          d > 0 ? approach_features(nearmiss::with_separation(judged.query, d)) : std::nullopt) {
    closest = to_text(kind, *features);  // "approach at-start vertex-face"
    closest.erase(0, closest.rfind(' ') + 1);
  }
  return fmt::format("{} {}", short_name(kind), closest);
}

namespace {

/// The query that belongs to a point of the search space. All its vertices rest at their positions at t = 0.
Query query_at_rest(Kind kind, SearchPoint point) {
  point.q.end = point.q.start;
  point.r.end = point.r.start;
  point.w.setZero();
  return at_rest(query_of(kind, point, 0));
}

Query search_over(const Subject& subject, const Stop& stop, Random& random, Kind kind) {
  const auto objective = [&](const SearchPoint& point) {
    stop.check();
    const Query query = query_at_rest(kind, point);
    if (!is_finite(query)) return unwanted;
    const auto judged = DistanceQuestion::ask(subject, query);
    if (!judged) return unwanted;
    if (judged->answer.fault != Fault::none) return HUGE_VAL;
    const double over = judged->error.over_by_size();
    return over > 0 ? std::log2(over) : unwanted / 2;
  };
  // Half of the searches also try primitives much smaller than usual.
  const double smallest = random.one_in(2) ? usually_smallest : 1e-10;
  const double size = random.one_in(2) ? 1 : search_log_uniform(random, smallest, 1);
  const auto draw = [&] {
    SearchPoint point = draw_search_point(random, smallest);
    point.gap = random.vector(search_log_uniform(random, 1e-8, 2));
    point.visit(false, [&](Vector3<double>& v) {
      if (&v != &point.place) v *= size;
    });
    return point;
  };
  return query_at_rest(
      kind, Maximiser(random, false, smallest * size, objective, /*moves_vertices=*/true).run(draw));
}

}  // namespace

std::vector<Family> DistanceQuestion::searches(const Subject& subject, const Stop& stop) {
  return search_families("search-over-" + subject.name(),
                         "distances that are over-reported, by directed search",
                         [&](Random& random, Kind kind) { return search_over(subject, stop, random, kind); });
}

}  // namespace nearmiss

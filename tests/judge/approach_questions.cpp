// Compares all answers about queries with a separation.
#include <algorithm>
#include <boost/multiprecision/gmp.hpp>
#include <vector>

#include "oracle/agreement/answers.hpp"
#include "oracle/distance.hpp"
#include "oracle/distance/proximity.hpp"
#include "oracle/features.hpp"
#include "oracle/oracle.hpp"
#include "oracle/within_separation.hpp"
#include "tests/judge/questions.hpp"

namespace nearmiss {

namespace {

using Rational = boost::multiprecision::mpq_rational;
using Point = std::array<Rational, 3>;
using Closest = ApproachFeatures::Closest;

Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Rational dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Point position(const Query& query, int vertex, const Rational& t) {
  Point x;
  for (int k = 0; k < 3; ++k) {
    const Rational start(query.start(vertex)[k]);
    x[static_cast<std::size_t>(k)] = start + t * (Rational(query.end(vertex)[k]) - start);
  }
  return x;
}

/// The simplest features that are at most h apart at a rational time, if there are any.
Closest closest_features(const Query& query, const Rational& t) {
  const Rational squared_h = Rational(query.separation) * Rational(query.separation);
  const int second = split(query.kind);
  bool has_edge = false;
  for (int i = 0; i < 4; ++i)
    for (int from = i < second ? second : 0; from < (i < second ? 4 : second); ++from) {
      const Point d = position(query, i, t) - position(query, from, t);
      if (dot(d, d) <= squared_h) return Closest::vertices;
      for (int to = i < second ? second : 0; to < from; ++to) {
        const Point e = position(query, to, t) - position(query, from, t);
        const Rational along = dot(d, e);
        const Rational length = dot(e, e);
        has_edge |= 0 < along && along < length && dot(d, d) * length - along * along <= squared_h * length;
      }
    }
  return has_edge ? Closest::vertex_and_edge : Closest::interiors;
}

/// Compares the features of the first approach with rational arithmetic, if its time is rational.
std::string features_disagree(const Query& query, const Decision& exactly) {
  const auto features = approach_features(query);
  if (features.has_value() != (exactly.collision || exactly.is_tie)) return "features: of nothing";
  if (!features) return "";
  if (exactly.is_tie && !features->touches) return "features: touches";
  const std::string rational = earliest_time(query)->rational();
  using Time = ContactFeatures::Time;
  const Time time = rational == "0" ? Time::start : rational == "1" ? Time::end : Time::inside;
  if (features->time != time) return "features: time";
  if (!rational.empty() && features->closest != closest_features(query, Rational(rational)))
    return "features: closest";
  return "";
}

/// Compares certified bounds, for enclosures of several widths, with the exact decision.
std::string bounds_disagree(const Query& query, const Decision& exactly) {
  const FilterStage stage = filter_with_separation(query);
  const bool is_decided = stage != FilterStage::undecided;
  if (is_decided && (exactly.is_tie || is_collision(stage) != exactly.collision))
    return "bounds against exact";
  for (const double width : {0x1p-10, rough_time, 0.0})
    if (known_approach(query, width).stage != stage) return "bounds: stages";
  return "";
}

/// Compares all decisions about a query.
std::string decisions_disagree(const Query& query, const Decision& exactly) {
  if (std::string what = bounds_disagree(query, exactly); !what.empty()) return what;
  const Answers answers = ask_others(query, to_answer(query, exactly));
  if (std::string parts = answers.disagreement(); !parts.empty()) return "answers: " + parts;
  const bool is_near = exactly.collision || exactly.is_tie;
  if (comes_within(query, query.separation) != is_near) return "distance: within";
  if (distance_exceeds(query, query.separation) == is_near) return "distance: exceeds";
  return "";
}

bool are_same(const Decision& a, const Decision& b) {
  return a.collision == b.collision && a.is_tie == b.is_tie;
}

/// Compares decisions about many queries, with and without a separation, with those about one.
std::optional<Contradiction> many_disagree(std::span<const Query> queries) {
  std::vector<Query> all(queries.begin(), queries.end());
  for (const Query& query : queries) all.push_back(with_separation(query, 0));
  std::vector<Decision> decisions(all.size());
  decide(all, decisions);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (!are_same(decisions[i], decide(all[i]))) return Contradiction{i % queries.size(), "decide: many"};
  return std::nullopt;
}

/// Whether times and features are computed for all queries, or only for those whose smallest distance is h.
enum class Depth : std::uint8_t { decisions, all };

std::string approach_disagreement(const Query& query, Depth depth) {
  const Decision exactly = decide_exactly(query);
  if (!are_same(decide(query), exactly)) return "decide against exact";
  std::string what = decisions_disagree(query, exactly);
  if (depth == Depth::decisions && !exactly.is_tie) return what;
  if (what.empty()) what = time_disagreement(query, exactly.collision || exactly.is_tie);
  return what.empty() ? features_disagree(query, exactly) : what;
}

}  // namespace

std::string closest_approach_disagreement(const Query& query, const Enclosure& smallest) {
  for (const double h : {below(smallest.lo), smallest.lo, smallest.hi, above(smallest.hi)}) {
    const Query with_h = with_separation(query, h);
    if (!(h > 0) || !std::isfinite(h)) continue;
    const bool is_outside = h < smallest.lo || smallest.hi < h;
    const Decision exactly = decide_exactly(with_h);
    if (is_outside && !are_same(exactly, {.collision = smallest.hi < h})) return "smallest distance";
    std::string what = approach_disagreement(with_h, h == smallest.hi ? Depth::all : Depth::decisions);
    if (!what.empty()) return "at the smallest distance: " + what;
  }
  return "";
}

std::optional<Contradiction> first_approach_disagreement(std::span<const Query> queries, std::uint64_t first,
                                                         const Watch& watch) {
  watch(0);
  if (auto found = many_disagree(queries)) return found;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    watch(i);
    const std::uint64_t number = (first + i) / 2;
    const std::uint64_t one_in = is_wide(queries[i]) ? 64 : 8;
    const Depth depth = number % one_in == 0 ? Depth::all : Depth::decisions;
    std::string what = approach_disagreement(queries[i], depth);
    const Query moved = in_translation(queries[i]);
    if (what.empty() && number % one_in == 1 && is_finite(moved)) {
      what = approach_disagreement(moved, Depth::all);
      if (!what.empty()) what = "in translation: " + what;
    }
    if (!what.empty()) return Contradiction{i, std::move(what)};
  }
  return std::nullopt;
}

}  // namespace nearmiss

#include "oracle/interface/oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <string>

#include "ccd/query/gather.hpp"
#include "oracle/certificates/certificate.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss::interface {
namespace {

std::uint8_t decider(FilterStage stage) {
  switch (stage) {
    case FilterStage::boxes:
      return NEARMISS_BY_BOXES;
    case FilterStage::undecided:
      return NEARMISS_BY_EXACT;
    default:
      return NEARMISS_BY_FILTER;
  }
}

/// If there are at least this many queries, deciding them side by side is faster than deciding them one by
/// one.
constexpr std::size_t fewest_side_by_side = 4;

struct Answers {
  std::int8_t* answers;
  std::uint8_t* decided_by;

  void set(std::size_t q, bool is_collision, FilterStage stage) const {
    answers[q] = is_collision ? NEARMISS_COLLISION : NEARMISS_NO_COLLISION;
    if (decided_by != nullptr) decided_by[q] = decider(stage);
  }

  int refuse(std::size_t q) const {
    answers[q] = NEARMISS_NO_ANSWER;
    if (decided_by != nullptr) decided_by[q] = NEARMISS_BY_BOXES;
    return NEARMISS_NOT_FINITE;
  }

  void set(std::size_t q, const Decision& decision) const {
    set(q, decision.collision || decision.is_tie, decision.stage);
  }
};

struct Enclosures {
  double *lo, *hi;

  void set(std::size_t q, const Enclosure& enclosure) const {
    lo[q] = enclosure.lo;
    if (hi != nullptr) hi[q] = enclosure.hi;
  }
  void refuse(std::size_t q) const {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    set(q, {nan, nan});
  }
};

Enclosure enclosed_time(const Query& query, double width) {
  auto time = earliest_time(query);
  return time ? time->enclosure(width) : Enclosure{HUGE_VAL, HUGE_VAL};
}

/// Calls set(q, enclosed_time(query, width)) for each query that can be answered, and refuse(q) for each
/// of the others.
template <class Set, class Refuse>
int for_each_time(const nearmiss_queries* queries, double width, const Set& set, const Refuse& refuse) {
  return for_blocks(queries, [&](const QueryRows& block, std::size_t first) {
    std::array<FilterStage, block_size> stages;
    std::array<KnownTime, block_size> times;
    // The answers must not depend on which queries are asked together. If `width` is above 0, a search for
    // the times of several queries side by side may find another enclosure than a search for one of these
    // times. So only a `width` of 0 allows the search side by side.
    const bool side_by_side =
        width == 0 && block.size() >= fewest_side_by_side && ask_for_contact(*queries, first, block.size());
    if (side_by_side) filter_for_times(block, stages, std::span(times).first(block.size()));
    int status = NEARMISS_OK;
    for (std::size_t i = 0; i < block.size(); ++i) {
      const bool is_decided = side_by_side && stages[i] != FilterStage::undecided;
      if (is_decided && !is_collision(stages[i])) {
        set(first + i, Enclosure{HUGE_VAL, HUGE_VAL});
      } else if (is_decided && times[i].is_known_to(0)) {
        set(first + i, times[i].time);
      } else if (const Query query = block[i]; is_answerable(query)) {
        set(first + i, enclosed_time(query, width));
      } else {
        refuse(first + i);
        status = NEARMISS_NOT_FINITE;
      }
    }
    return status;
  });
}

Certificates certificates_of(const Query& query, int what) {
  switch (what) {
    case NEARMISS_PROVE_TIME:
      return certify_time(query);
    case NEARMISS_PROVE_DISTANCE:
      return certify_distance(query);
    default:
      return {certify(query)};
  }
}

std::string in_lines(const Certificates& certificates) {
  std::string text;
  for (const auto& each : certificates)
    if (each) text += (text.empty() ? "" : "\n") + *each;
  return text;
}

/// Writes the certificate of a query, or "" if the query cannot be answered; cuts off the text as snprintf()
/// does.
int write_certificate(Query query, int what, char* text, std::size_t size, std::size_t* length) noexcept {
  try {
    if (what == NEARMISS_PROVE_DISTANCE) query.separation = 0;
    const bool has_answer = is_answerable(query);
    const std::string proof = has_answer ? in_lines(certificates_of(query, what)) : "";
    if (size > 0) text[proof.copy(text, size - 1)] = '\0';
    *length = proof.size();
    return has_answer ? NEARMISS_OK : NEARMISS_NOT_FINITE;
  } catch (const std::bad_alloc&) {
    return NEARMISS_OUT_OF_MEMORY;
  }
}

}  // namespace
}  // namespace nearmiss::interface

using nearmiss::FilterStage;
using nearmiss::Query;
using nearmiss::QueryRows;
using nearmiss::interface::Answers;
using nearmiss::interface::Enclosures;

int nearmiss_collides(const nearmiss_queries* queries, int8_t* answers, uint8_t* decided_by) {
  const nearmiss::PlainArithmetic guard;
  if (answers == nullptr) return NEARMISS_BAD_ARGUMENT;
  const Answers to{answers, decided_by};
  return nearmiss::interface::for_blocks(queries, [&](const QueryRows& block, std::size_t first) {
    std::array<FilterStage, nearmiss::interface::block_size> stages;
    const bool side_by_side = block.size() >= nearmiss::interface::fewest_side_by_side &&
                              nearmiss::interface::ask_for_contact(*queries, first, block.size());
    if (side_by_side) nearmiss::filter(block, stages);
    int status = NEARMISS_OK;
    for (std::size_t i = 0; i < block.size(); ++i) {
      if (side_by_side && stages[i] != FilterStage::undecided)
        to.set(first + i, nearmiss::is_collision(stages[i]), stages[i]);
      else if (const Query query = block[i]; !nearmiss::interface::is_answerable(query))
        status = to.refuse(first + i);
      else
        to.set(first + i, side_by_side ? nearmiss::settle(query, stages[i]) : nearmiss::decide(query));
    }
    return status;
  });
}

int nearmiss_earliest_time(const nearmiss_queries* queries, double width, double* lo, double* hi) {
  const nearmiss::PlainArithmetic guard;
  if (lo == nullptr || !(width >= 0)) return NEARMISS_BAD_ARGUMENT;
  const Enclosures to{lo, hi};
  return nearmiss::interface::for_each_time(
      queries, width, [&](std::size_t q, const nearmiss::Enclosure& time) { to.set(q, time); },
      [&](std::size_t q) { to.refuse(q); });
}

int nearmiss_time_of_impact(const nearmiss_queries* queries, double tmax, int8_t* answers, double* toi) {
  const nearmiss::PlainArithmetic guard;
  if (answers == nullptr || toi == nullptr || !(tmax <= 1)) return NEARMISS_BAD_ARGUMENT;
  const Answers to{answers, nullptr};
  return nearmiss::interface::for_each_time(
      queries, 0,
      [&](std::size_t q, const nearmiss::Enclosure& time) {
        // If t* is not a double, t* <= tmax if and only if the next larger double is <= tmax.
        const bool is_collision = time.hi <= tmax;
        answers[q] = is_collision ? NEARMISS_COLLISION : NEARMISS_NO_COLLISION;
        toi[q] = is_collision ? time.lo : HUGE_VAL;
      },
      [&](std::size_t q) {
        to.refuse(q);
        toi[q] = 0;
      });
}

int nearmiss_smallest_distance(const nearmiss_queries* queries, double relative_width, double* lo,
                               double* hi) {
  const nearmiss::PlainArithmetic guard;
  if (lo == nullptr || !(relative_width >= 0)) return NEARMISS_BAD_ARGUMENT;
  nearmiss_queries without_separations;
  if (queries != nullptr) {
    without_separations = *queries;
    without_separations.separation = nullptr;
    queries = &without_separations;
  }
  const Enclosures to{lo, hi};
  return nearmiss::interface::for_each_query(
      queries,
      [&](const Query& query, std::size_t q) {
        to.set(q, nearmiss::minimum_distance(query, std::min(relative_width, 0.5)));
      },
      [&](std::size_t q) { to.refuse(q); });
}

int nearmiss_certificate(const nearmiss_queries* queries, size_t q, int what, char* text, size_t size,
                         size_t* length) {
  const nearmiss::PlainArithmetic guard;
  const bool can_be_proved = what >= NEARMISS_PROVE_DECISION && what <= NEARMISS_PROVE_DISTANCE;
  if (!nearmiss::interface::are_readable(queries) || q >= queries->count || !can_be_proved ||
      (text == nullptr && size > 0) || length == nullptr)
    return NEARMISS_BAD_ARGUMENT;
  const Query query = nearmiss::interface::query_at(*queries, q);
  return nearmiss::interface::write_certificate(query, what, text, size, length);
}

#include "ccd/wang/wang.h"

#include <limits>

#include "ccd/query/gather.hpp"
#include "ccd/wang/pair_bound.hpp"
#include "ccd/wang/wang.hpp"
#include "ccd/wang/wang_batch.hpp"
#include "ccd/wang/within.hpp"

using nearmiss::Kind;
using nearmiss::Query;
using nearmiss::QueryRows;
using nearmiss::Verdict;
using nearmiss::WangOptions;

namespace {

bool reports(const Query& query) {
  return nearmiss::with_kind(
      query.kind, [&]<Kind kind>() { return nearmiss::wang<kind, double, WangOptions{}>(query).hit; });
}

/// Whether the kind of the queries is vv or ve.
bool are_of_vertices(const nearmiss_queries& queries) { return nearmiss_vertices(queries.kind) < 4; }

/// Whether no pointer is null, and all separations are 0 unless the kind is vv or ve.
bool are_usable(const nearmiss_queries* queries, const void* to) {
  return to != nullptr && queries != nullptr &&
         (are_of_vertices(*queries) || nearmiss::interface::ask_for_contact(*queries));
}

int decide_within(const nearmiss_queries* queries, int8_t* answers) {
  return nearmiss::interface::for_each_query(
      queries,
      [&](const Query& query, std::size_t q) {
        answers[q] =
            nearmiss::wang_within<double>(query, true).hit ? NEARMISS_COLLISION : NEARMISS_NO_COLLISION;
      },
      [&](std::size_t q) { answers[q] = NEARMISS_NO_ANSWER; });
}

}  // namespace

int nearmiss_wang(const nearmiss_queries* queries, int8_t* answers) {
  const nearmiss::PlainArithmetic guard;
  if (!are_usable(queries, answers)) return NEARMISS_BAD_ARGUMENT;
  if (are_of_vertices(*queries)) return decide_within(queries, answers);
  return nearmiss::interface::for_blocks(queries, [&](const QueryRows& block, std::size_t first) {
    std::array<Verdict, nearmiss::interface::block_size> verdicts;
    nearmiss::wang_in_lanes(block, verdicts);
    int status = NEARMISS_OK;
    for (std::size_t i = 0; i < block.size(); ++i) {
      std::int8_t& answer = answers[first + i];
      if (nearmiss::is_decided(verdicts[i])) {
        answer = verdicts[i].hit ? NEARMISS_COLLISION : NEARMISS_NO_COLLISION;
      } else if (const Query query = block[i]; nearmiss::is_finite(query)) {
        answer = reports(query) ? NEARMISS_COLLISION : NEARMISS_NO_COLLISION;
      } else {
        answer = NEARMISS_NO_ANSWER;
        status = NEARMISS_NOT_FINITE;
      }
    }
    return status;
  });
}

int nearmiss_wang_bound(const nearmiss_queries* queries, double* bounds) {
  const nearmiss::PlainArithmetic guard;
  if (!are_usable(queries, bounds)) return NEARMISS_BAD_ARGUMENT;
  const auto tolerances = nearmiss::paper_tolerances(1.0);
  return nearmiss::interface::for_each_query(
      queries,
      [&](const Query& query, std::size_t q) {
        bounds[q] = nearmiss::is_of_meshes(query.kind)
                        ? nearmiss::distance_bound_of(tolerances, nearmiss::pair_bound(query))
                        : nearmiss::within_distance_bound(query);
      },
      [&](std::size_t q) { bounds[q] = std::numeric_limits<double>::quiet_NaN(); });
}

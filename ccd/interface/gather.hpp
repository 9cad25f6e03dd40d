// Queries in the caller's memory (queries.h) as values, block by block.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <span>

#include "ccd/interface/queries.h"
#include "ccd/query.hpp"

namespace nearmiss::interface {

/// Whether the fields are such that the queries can be read.
inline bool are_readable(const nearmiss_queries* queries) {
  return queries != nullptr && (queries->kind == NEARMISS_VERTEX_TRIANGLE || queries->kind == NEARMISS_EDGE_EDGE) &&
         (queries->type == NEARMISS_DOUBLE || queries->type == NEARMISS_FLOAT) &&
         (queries->count == 0 || (queries->start != nullptr && queries->end != nullptr));
}

/// Whether all queries have the separation 0.
inline bool asks_for_contact(const nearmiss_queries& queries) {
  return queries.separation == nullptr || (queries.separation_stride == 0 && *queries.separation == 0);
}

/// Whether a query has an answer.
inline bool is_answerable(const Query& query) {
  return query.separation >= 0 && query.separation < HUGE_VAL && is_finite(query);
}

/// Reads one query after the other.
template <class T>
class Reader {
 public:
  explicit Reader(const nearmiss_queries& queries)
      : queries_(queries),
        is_packed_(queries.coordinate_stride == sizeof(T) && queries.vertex_stride == 3 * sizeof(T) &&
                   queries.vertices == nullptr) {}

  void read(std::size_t q, Query& query) const {
    const auto offset = static_cast<std::ptrdiff_t>(q);
    std::size_t time = 0;
    for (const void* const points : {queries_.start, queries_.end}) {
      const auto* const first = static_cast<const std::byte*>(points) + offset * queries_.query_stride;
      double* const x = &query.x[12 * time++];
      if (is_packed_)
        copy(first, x);
      else
        for (std::size_t i = 0; i < 4; ++i) {
          const std::ptrdiff_t vertex =
              queries_.vertices == nullptr ? static_cast<std::ptrdiff_t>(i) : queries_.vertices[4 * q + i];
          for (std::size_t k = 0; k < 3; ++k)
            x[3 * i + k] = number<T>(first + vertex * queries_.vertex_stride +
                                     static_cast<std::ptrdiff_t>(k) * queries_.coordinate_stride);
        }
    }
    if (queries_.separation != nullptr)
      query.separation = number<double>(reinterpret_cast<const std::byte*>(queries_.separation) +
                                        offset * queries_.separation_stride);
  }

 private:
  template <class Number>
  static Number number(const std::byte* at) {
    Number value;
    std::memcpy(&value, at, sizeof value);
    return value;
  }

  static void copy(const std::byte* from, double* x) {
    std::array<T, 12> numbers;
    std::memcpy(numbers.data(), from, sizeof numbers);
    std::copy(numbers.begin(), numbers.end(), x);
  }

  const nearmiss_queries& queries_;
  bool is_packed_;
};

/// Number of queries that are decided side by side.
inline constexpr std::size_t block_size = 128;

/// Calls visit(block, first) for the queries, in blocks that begin with query `first`. Returns NEARMISS_OK, or what `visit`
/// returns last that is something else.
template <class T, class Visit>
int for_blocks_of(const nearmiss_queries& queries, const Visit& visit) {
  const Reader<T> reader(queries);
  const Query empty{.kind = queries.kind == NEARMISS_EDGE_EDGE ? Kind::edge_edge : Kind::vertex_triangle};
  union Block {  // of which only the queries that are used are initialised
    Block() {}
    Query queries[block_size];
  } block;
  std::uninitialized_fill_n(block.queries, std::min(block_size, queries.count), empty);
  int status = NEARMISS_OK;
  for (std::size_t first = 0; first < queries.count; first += block_size) {
    const std::size_t count = std::min(block_size, queries.count - first);
    for (std::size_t i = 0; i < count; ++i) reader.read(first + i, block.queries[i]);
    const int each = visit(std::span<const Query>(block.queries, count), first);
    if (each != NEARMISS_OK) status = each;
  }
  return status;
}

/// The same for any queries, in plain arithmetic and without exceptions.
template <class Visit>
int for_blocks(const nearmiss_queries* queries, const Visit& visit) noexcept {
  if (!are_readable(queries)) return NEARMISS_BAD_ARGUMENT;
  try {
    const PlainArithmetic guard;
    return queries->type == NEARMISS_DOUBLE ? for_blocks_of<double>(*queries, visit)
                                            : for_blocks_of<float>(*queries, visit);
  } catch (const std::bad_alloc&) {
    return NEARMISS_OUT_OF_MEMORY;
  }
}

/// The same query by query: answer(query, q) is called for those that have an answer, refuse(q) for the others.
template <class Answer, class Refuse>
int for_each_query(const nearmiss_queries* queries, const Answer& answer, const Refuse& refuse) noexcept {
  return for_blocks(queries, [&](std::span<const Query> block, std::size_t first) {
    int status = NEARMISS_OK;
    for (std::size_t i = 0; i < block.size(); ++i)
      if (is_answerable(block[i])) {
        answer(block[i], first + i);
      } else {
        refuse(first + i);
        status = NEARMISS_NOT_FINITE;
      }
    return status;
  });
}

}  // namespace nearmiss::interface

// Reads queries from the caller's memory (queries.h), some hundreds at a time.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <span>

#include "ccd/query/queries.h"
#include "ccd/query/query.hpp"
#include "ccd/query/query_rows.hpp"

namespace nearmiss::interface {

/// Whether the queries can be read: their kind and the type of their numbers are known, and no required
/// pointer is null.
inline bool are_readable(const nearmiss_queries* queries) {
  return queries != nullptr && kind_of_bit(queries->kind).has_value() &&
         (queries->type == NEARMISS_DOUBLE || queries->type == NEARMISS_FLOAT) &&
         (queries->count == 0 || (queries->start != nullptr && queries->end != nullptr));
}

/// The number that is `offset` bytes after `base` in the caller's memory.
template <class Number>
Number number_at(const void* base, std::ptrdiff_t offset) {
  Number value;
  std::memcpy(&value, static_cast<const std::byte*>(base) + offset, sizeof value);
  return value;
}

/// The separation of query q. `queries.separation` must not be null.
inline double separation_of(const nearmiss_queries& queries, std::size_t q) {
  return number_at<double>(queries.separation, static_cast<std::ptrdiff_t>(q) * queries.separation_stride);
}

/// Whether `count` queries, from number `first` on, all have the separation 0.
inline bool ask_for_contact(const nearmiss_queries& queries, std::size_t first, std::size_t count) {
  if (queries.separation == nullptr) return true;
  if (queries.separation_stride == 0) count = std::min<std::size_t>(count, 1);
  for (std::size_t q = first; q < first + count; ++q)
    if (separation_of(queries, q) != 0) return false;
  return true;
}

inline bool ask_for_contact(const nearmiss_queries& queries) {
  return ask_for_contact(queries, 0, queries.count);
}

/// Whether all numbers of a query are finite, and its separation is not negative.
inline bool is_answerable(const Query& query) {
  return query.separation >= 0 && query.separation < HUGE_VAL && is_finite(query);
}

/// Whether the coordinates of each query at t = 0 are contiguous, and its coordinates at t = 1 are
/// contiguous, too. T must be the type of the coordinates.
template <class T>
bool has_packed_points(const nearmiss_queries& queries) {
  return queries.coordinate_stride == sizeof(T) && queries.vertex_stride == 3 * sizeof(T) &&
         queries.vertices == nullptr;
}

/// Whether each query is 24 contiguous doubles in the order of Query::x.
inline bool lie_in_rows(const nearmiss_queries& queries) {
  return vertices(*kind_of_bit(queries.kind)) == 4 && queries.type == NEARMISS_DOUBLE &&
         has_packed_points<double>(queries) && static_cast<const double*>(queries.start) + 12 == queries.end;
}

/// Reads single queries, whose coordinates are of type T.
template <class T>
class Reader {
 public:
  explicit Reader(const nearmiss_queries& queries)
      : queries_(queries),
        vertices_(static_cast<std::size_t>(vertices(*kind_of_bit(queries.kind)))),
        is_packed_(has_packed_points<T>(queries) && vertices_ == 4) {}

  void read(std::size_t q, Query& query) const {
    const auto offset = static_cast<std::ptrdiff_t>(q);
    read_points(q, static_cast<const std::byte*>(queries_.start) + offset * queries_.query_stride,
                &query.x[0]);
    read_points(q, static_cast<const std::byte*>(queries_.end) + offset * queries_.query_stride,
                &query.x[12]);
    repeat_vertices(query);
    if (queries_.separation != nullptr) query.separation = separation_of(queries_, q);
  }

 private:
  void read_points(std::size_t q, const std::byte* first, double* x) const {
    if (is_packed_) {
      std::array<T, 12> numbers;
      std::memcpy(numbers.data(), first, sizeof numbers);
      std::copy(numbers.begin(), numbers.end(), x);
      return;
    }
    for (std::size_t i = 0; i < vertices_; ++i) {
      const std::ptrdiff_t vertex = queries_.vertices == nullptr ? static_cast<std::ptrdiff_t>(i)
                                                                 : queries_.vertices[vertices_ * q + i];
      const std::ptrdiff_t point = vertex * queries_.vertex_stride;
      for (std::ptrdiff_t k = 0; k < 3; ++k)
        *x++ = number_at<T>(first, point + k * queries_.coordinate_stride);
    }
  }

  const nearmiss_queries& queries_;
  std::size_t vertices_;  ///< the number of vertices of a query
  bool is_packed_;
};

/// Query number q. The queries must be readable (are_readable()).
inline Query query_at(const nearmiss_queries& queries, std::size_t q) {
  Query query{.kind = *kind_of_bit(queries.kind)};
  if (queries.type == NEARMISS_DOUBLE)
    Reader<double>(queries).read(q, query);
  else
    Reader<float>(queries).read(q, query);
  return query;
}

/// The largest number of queries that for_blocks() passes to `visit` at once.
inline constexpr std::size_t block_size = 256;

/// Divides `count` queries into blocks of at most `most` queries, and calls visit(block_of(first, size),
/// first) for each block. `first` is the index of the block's first query, and `size` the number of its
/// queries. Returns the last status of `visit` that is not NEARMISS_OK, or NEARMISS_OK if there is none.
template <class BlockOf, class Visit>
int for_parts(std::size_t count, std::size_t most, const BlockOf& block_of, const Visit& visit) {
  int status = NEARMISS_OK;
  for (std::size_t first = 0; first < count; first += most) {
    const int each = visit(block_of(first, std::min(most, count - first)), first);
    if (each != NEARMISS_OK) status = each;
  }
  return status;
}

/// Copies the queries into blocks, and calls visit(block, first) for each block. T must be the type of the
/// coordinates in the caller's memory.
template <class T, class Visit>
int for_copies(const nearmiss_queries& queries, Kind kind, const Visit& visit) {
  constexpr std::size_t most = 128;  // this number of queries fits into the L1 cache
  union Block {                      // a union, so that only the queries in use are initialised
    Block() {}
    Query queries[most];
  } block;
  std::uninitialized_fill_n(block.queries, std::min(most, queries.count), Query{.kind = kind});
  const Reader<T> reader(queries);
  return for_parts(
      queries.count, most,
      [&](std::size_t first, std::size_t size) {
        for (std::size_t i = 0; i < size; ++i) reader.read(first + i, block.queries[i]);
        return QueryRows(std::span<const Query>(block.queries, size));
      },
      visit);
}

/// Calls visit(block, first) for each block of queries. Copies the queries unless they lie in rows and ask
/// for contact. Returns a status, and throws nothing. The caller must have made arithmetic plain
/// (arithmetic.hpp).
template <class Visit>
int for_blocks(const nearmiss_queries* queries, const Visit& visit) noexcept {
  if (!are_readable(queries)) return NEARMISS_BAD_ARGUMENT;
  const Kind kind = *kind_of_bit(queries->kind);
  try {
    if (lie_in_rows(*queries) && ask_for_contact(*queries)) {
      const QueryRows rows(kind, static_cast<const double*>(queries->start), queries->query_stride,
                           queries->count);
      return for_parts(
          queries->count, block_size,
          [&](std::size_t first, std::size_t size) { return rows.part(first, size); }, visit);
    }
    return queries->type == NEARMISS_DOUBLE ? for_copies<double>(*queries, kind, visit)
                                            : for_copies<float>(*queries, kind, visit);
  } catch (const std::bad_alloc&) {
    return NEARMISS_OUT_OF_MEMORY;
  }
}

/// Calls answer(query, q) for each query q that is_answerable(), and refuse(q) for every other query. Returns
/// a status, and throws nothing.
template <class Answer, class Refuse>
int for_each_query(const nearmiss_queries* queries, const Answer& answer, const Refuse& refuse) noexcept {
  return for_blocks(queries, [&](const QueryRows& block, std::size_t first) {
    int status = NEARMISS_OK;
    for (std::size_t i = 0; i < block.size(); ++i) {
      const Query query = block[i];
      if (is_answerable(query)) {
        answer(query, first + i);
      } else {
        refuse(first + i);
        status = NEARMISS_NOT_FINITE;
      }
    }
    return status;
  });
}

}  // namespace nearmiss::interface

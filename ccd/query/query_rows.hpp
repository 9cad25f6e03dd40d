// A view of queries in memory, for code that decides many of them at once.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// Queries of 24 contiguous coordinates each, in the order of Query::x and with repeated vertices. The
/// queries are a span of Query values, or an array of doubles in a calling program; the queries of an array
/// have one kind and the separation 0. The memory that holds the queries must outlive the view.
class QueryRows {
 public:
  explicit QueryRows(std::span<const Query> queries)
      : queries_(queries.data()),
        x_(reinterpret_cast<const std::byte*>(queries.data()) + offsetof(Query, x)),
        stride_(sizeof(Query)),
        size_(queries.size()) {}
  /// `stride` is the number of bytes from one query to the next.
  QueryRows(Kind kind, const double* x, std::ptrdiff_t stride, std::size_t size)
      : kind_(kind), x_(reinterpret_cast<const std::byte*>(x)), stride_(stride), size_(size) {}

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const double* x(std::size_t q) const {
    return reinterpret_cast<const double*>(x_ + static_cast<std::ptrdiff_t>(q) * stride_);
  }
  [[nodiscard]] Kind kind(std::size_t q) const { return queries_ == nullptr ? kind_ : queries_[q].kind; }

  /// The queries first .. first + size - 1.
  [[nodiscard]] QueryRows part(std::size_t first, std::size_t size) const {
    QueryRows some = *this;
    if (queries_ != nullptr) some.queries_ += first;
    some.x_ += static_cast<std::ptrdiff_t>(first) * stride_;
    some.size_ = size;
    return some;
  }

  [[nodiscard]] Query operator[](std::size_t q) const {
    if (queries_ != nullptr) return queries_[q];
    Query query{.kind = kind_};
    std::copy_n(x(q), query.x.size(), query.x.begin());
    return query;
  }

 private:
  const Query* queries_ = nullptr;  ///< null if all queries have the kind `kind_`
  Kind kind_{};
  const std::byte* x_;
  std::ptrdiff_t stride_;
  std::size_t size_;
};

}  // namespace nearmiss

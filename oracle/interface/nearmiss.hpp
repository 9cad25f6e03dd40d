/// \file
/// The C++ interface of nearmiss: exact answers and the failure-proof CCD for queries in the caller's memory.
/// It is a thin layer over the C functions of nearmiss.h, whose comments say what the answers mean. C++20.
/// Link with nearmiss::oracle, or -lnearmiss.
///
///     const auto pairs = nearmiss::Queries::of_mesh(nearmiss::Kind::edge_edge, indices, start, end);
///     std::vector<std::int8_t> answers(pairs.size());
///     if (nearmiss::collides(pairs, answers) != nearmiss::Status::ok) ...
#pragma once

#if __cplusplus < 202002L
#error "nearmiss.hpp needs C++20"
#endif

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>

#include "ccd/query/kind.hpp"
#include "oracle/interface/nearmiss.h"

/// The namespace of the C++ interface, and of the header-only CCD.
namespace nearmiss {

/// The status that a function returns.
enum class Status : int {
  ok = NEARMISS_OK,
  not_finite = NEARMISS_NOT_FINITE,  ///< every query is answered, but some answers are Answer::none or NaN
  /// no query is answered, because an argument is wrong, such as the length of a span
  bad_argument = NEARMISS_BAD_ARGUMENT,
  out_of_memory = NEARMISS_OUT_OF_MEMORY,  ///< memory ran out, and some queries are not answered
};

/// The answers in a span of std::int8_t.
enum class Answer : std::int8_t {
  none = NEARMISS_NO_ANSWER,
  no_collision = NEARMISS_NO_COLLISION,
  collision = NEARMISS_COLLISION,
};

/// The values that functions write to the span `decided_by`. Each value says what decided a query.
enum class DecidedBy : std::uint8_t {
  boxes = NEARMISS_BY_BOXES,
  filter = NEARMISS_BY_FILTER,
  exact = NEARMISS_BY_EXACT,
};

/// The statements that a certificate proves.
enum class Prove : int {
  decision = NEARMISS_PROVE_DECISION,
  time = NEARMISS_PROVE_TIME,
  distance = NEARMISS_PROVE_DISTANCE,
};

/// Two numbers that enclose a time or a distance. If there is no answer, both are NaN. If there is no
/// collision, both ends of a time are infinite.
struct Interval {
  double lo = std::numeric_limits<double>::quiet_NaN();  ///< the lower end
  double hi = std::numeric_limits<double>::quiet_NaN();  ///< the upper end
};

/// A sentence that explains a status.
inline const char* message(Status status) noexcept { return nearmiss_message(static_cast<int>(status)); }

/// Queries of one kind, which stay in the caller's memory. This memory must outlive the object.
class Queries {
 public:
  /// Queries that are stored one after another. Each query consists of the coordinates of x0 x1 .. at t = 0,
  /// followed by the coordinates of the same points at t = 1. Numbers that are left at the end, too few for a
  /// whole query, are ignored.
  static Queries packed(Kind kind, std::span<const double> x) noexcept {
    return Queries(nearmiss_packed(to_c(kind), count_of(kind, x.size(), 6), x.data()));
  }
  /// Queries that are stored one after another, with coordinates of type float.
  static Queries packed(Kind kind, std::span<const float> x) noexcept {
    return Queries(nearmiss_packed_float(to_c(kind), count_of(kind, x.size(), 6), x.data()));
  }

  /// Pairs of primitives of a moving mesh. `vertices` has the vertex numbers of each pair. `start` and `end`
  /// have three coordinates for each vertex of the mesh, at t = 0 and at t = 1.
  static Queries of_mesh(Kind kind, std::span<const std::int32_t> vertices, const double* start,
                         const double* end) noexcept {
    return Queries(
        nearmiss_of_mesh(to_c(kind), count_of(kind, vertices.size(), 1), vertices.data(), start, end));
  }
  /// Pairs of primitives of a moving mesh, with coordinates of type float.
  static Queries of_mesh(Kind kind, std::span<const std::int32_t> vertices, const float* start,
                         const float* end) noexcept {
    return Queries(
        nearmiss_of_mesh_float(to_c(kind), count_of(kind, vertices.size(), 1), vertices.data(), start, end));
  }

  /// Queries in any other layout that nearmiss_queries can describe.
  explicit Queries(const nearmiss_queries& layout) noexcept : layout_(layout) {}

  /// These queries with one separation h for all. `h` must outlive the result.
  [[nodiscard]] Queries with_separation(const double& h) const noexcept { return with_separations(&h, 0); }
  Queries with_separation(double&&) const = delete;
  /// These queries with a separation h[q] for each query q. If the number of separations is wrong, no query
  /// will be answered, and the status will be bad_argument.
  [[nodiscard]] Queries with_separations(std::span<const double> h) const noexcept {
    Queries queries = with_separations(h.data(), sizeof(double));
    queries.separations_ = h.size();
    return queries;
  }

  /// Number of queries.
  [[nodiscard]] std::size_t size() const noexcept { return layout_.count; }
  /// Whether the span of separations, if one was given, has one element for each query.
  [[nodiscard]] bool has_its_separations() const noexcept {
    return separations_ == any_number || separations_ == size();
  }
  /// The layout of the queries, in the form that the C functions take.
  [[nodiscard]] const nearmiss_queries& layout() const noexcept { return layout_; }
  /// The layout of the queries, which the caller may change.
  nearmiss_queries& layout() noexcept { return layout_; }

 private:
  static int to_c(Kind kind) { return static_cast<std::size_t>(kind) < kinds.size() ? bit_of(kind) : 0; }
  /// The number of whole queries that `size` numbers contain if each vertex takes `of_a_vertex` numbers. This
  /// function accepts an unknown kind, which the C functions refuse later.
  static std::size_t count_of(Kind kind, std::size_t size, int of_a_vertex) {
    const int of_a_query = of_a_vertex * nearmiss_vertices(to_c(kind));
    return of_a_query > 0 ? size / static_cast<std::size_t>(of_a_query) : size;
  }
  [[nodiscard]] Queries with_separations(const double* h, std::ptrdiff_t stride) const noexcept {
    Queries queries = *this;
    queries.layout_.separation = h;
    queries.layout_.separation_stride = stride;
    queries.separations_ = any_number;
    return queries;
  }

  static constexpr std::size_t any_number = std::numeric_limits<std::size_t>::max();

  nearmiss_queries layout_;
  std::size_t separations_ = any_number;  // the length of the span of separations, if one was given
};

namespace detail {

/// Whether a span has one element for each query. If `may_be_empty` is true, an empty span fits, too.
template <class T>
bool fits(const Queries& queries, std::span<T> to, bool may_be_empty = false) {
  return to.size() == queries.size() || (may_be_empty && to.empty());
}

/// Calls a C function with the layout. If a span does not fit, returns bad_argument instead. If there are no
/// queries, returns ok without a call: the pointer of an empty span may be null, and the C functions refuse
/// null pointers.
template <class Call>
Status ask(const Queries& queries, bool fit, const Call& call) {
  if (!fit || !queries.has_its_separations()) return Status::bad_argument;
  return queries.size() == 0 ? Status::ok : static_cast<Status>(call(&queries.layout()));
}

}  // namespace detail

/// nearmiss_collides(): whether each query is a collision, and, if wanted, what decided it.
inline Status collides(const Queries& queries, std::span<std::int8_t> answers,
                       std::span<std::uint8_t> decided_by = {}) noexcept {
  const bool fit = detail::fits(queries, answers) && detail::fits(queries, decided_by, true);
  return detail::ask(queries, fit, [&](const nearmiss_queries* layout) {
    return nearmiss_collides(layout, answers.data(), decided_by.data());
  });
}

/// nearmiss_earliest_time(): the earliest time of each collision. With a `width` of 0, `lo` is the largest
/// double that is not after this time.
inline Status earliest_times(const Queries& queries, std::span<double> lo, std::span<double> hi = {},
                             double width = 0) noexcept {
  const bool fit = detail::fits(queries, lo) && detail::fits(queries, hi, true);
  return detail::ask(queries, fit, [&](const nearmiss_queries* layout) {
    return nearmiss_earliest_time(layout, width, lo.data(), hi.data());
  });
}

/// nearmiss_time_of_impact(): whether each query is a collision in [0, tmax], and the largest double that is
/// not after the earliest time of the collision.
inline Status times_of_impact(const Queries& queries, std::span<std::int8_t> answers, std::span<double> toi,
                              double tmax = 1) noexcept {
  const bool fit = detail::fits(queries, answers) && detail::fits(queries, toi);
  return detail::ask(queries, fit, [&](const nearmiss_queries* layout) {
    return nearmiss_time_of_impact(layout, tmax, answers.data(), toi.data());
  });
}

/// nearmiss_smallest_distance(): the smallest distance over the step.
inline Status smallest_distances(const Queries& queries, std::span<double> lo, std::span<double> hi = {},
                                 double relative_width = 1e-3) noexcept {
  const bool fit = detail::fits(queries, lo) && detail::fits(queries, hi, true);
  return detail::ask(queries, fit, [&](const nearmiss_queries* layout) {
    return nearmiss_smallest_distance(layout, relative_width, lo.data(), hi.data());
  });
}

/// nearmiss_certificate(): sets `text` to the certificate of query q, or to "" if there is no certificate.
/// Throws nothing but std::bad_alloc.
inline Status certificate(const Queries& queries, std::size_t q, std::string& text,
                          Prove what = Prove::decision) {
  std::size_t length = 0;
  const auto ask_for = [&](std::size_t size) {
    text.resize(size);
    return detail::ask(queries, q < queries.size(), [&](const nearmiss_queries* layout) {
      return nearmiss_certificate(layout, q, static_cast<int>(what), text.data(), size + 1, &length);
    });
  };
  constexpr std::size_t of_most = 4000;
  Status status = ask_for(of_most);
  if (length > of_most) status = ask_for(length);
  text.resize(length);
  return status;
}

/// nearmiss_wang(): whether the failure-proof CCD reports each query.
inline Status wang(const Queries& queries, std::span<std::int8_t> answers) noexcept {
  const bool fit = detail::fits(queries, answers);
  return detail::ask(queries, fit,
                     [&](const nearmiss_queries* layout) { return nearmiss_wang(layout, answers.data()); });
}

/// nearmiss_wang_bound(): a bound for each query. If wang reports the query, its smallest distance exceeds
/// its separation by at most this bound.
inline Status wang_bounds(const Queries& queries, std::span<double> bounds) noexcept {
  const bool fit = detail::fits(queries, bounds);
  return detail::ask(queries, fit, [&](const nearmiss_queries* layout) {
    return nearmiss_wang_bound(layout, bounds.data());
  });
}

/// The coordinates of one query: those of x0 x1 .. at t = 0, then those of the same points at t = 1. If these
/// are fewer numbers than a query of the given kind has, the functions give no answer.
using Coordinates = std::span<const double>;

/// nearmiss_collides() for one query.
inline Answer collides(Kind kind, Coordinates x, double h = 0) noexcept {
  std::int8_t answer = NEARMISS_NO_ANSWER;
  (void)collides(Queries::packed(kind, x).with_separation(h), {&answer, 1});
  return Answer{answer};
}

/// nearmiss_earliest_time() for one query.
inline Interval earliest_time(Kind kind, Coordinates x, double h = 0, double width = 0) noexcept {
  Interval time;
  (void)earliest_times(Queries::packed(kind, x).with_separation(h), {&time.lo, 1}, {&time.hi, 1}, width);
  return time;
}

/// nearmiss_smallest_distance() for one query.
inline Interval smallest_distance(Kind kind, Coordinates x, double relative_width = 1e-3) noexcept {
  Interval distance;
  (void)smallest_distances(Queries::packed(kind, x), {&distance.lo, 1}, {&distance.hi, 1}, relative_width);
  return distance;
}

/// nearmiss_certificate() for one query.
inline std::string certificate(Kind kind, Coordinates x, double h = 0, Prove what = Prove::decision) {
  std::string text;
  (void)certificate(Queries::packed(kind, x).with_separation(h), 0, text, what);
  return text;
}

/// nearmiss_wang() for one query.
inline Answer wang(Kind kind, Coordinates x, double h = 0) noexcept {
  std::int8_t answer = NEARMISS_NO_ANSWER;
  (void)wang(Queries::packed(kind, x).with_separation(h), {&answer, 1});
  return Answer{answer};
}

/// nearmiss_wang_bound() for one query.
inline double wang_bound(Kind kind, Coordinates x, double h = 0) noexcept {
  double bound = std::numeric_limits<double>::quiet_NaN();
  (void)wang_bounds(Queries::packed(kind, x).with_separation(h), {&bound, 1});
  return bound;
}

}  // namespace nearmiss

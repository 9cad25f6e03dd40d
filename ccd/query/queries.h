/** \file
 * Queries in the caller's own memory, for the functions of wang.h and oracle.h. C99.
 *
 * A query has two primitives: a vertex x0 and a triangle x1 x2 x3, the edges x0x1 and x2x3, the vertices x0
 * and x1, or a vertex x0 and an edge x1x2. The vertices move linearly from t = 0 to t = 1. All coordinates
 * have one unit, which is arbitrary; times are fractions of the step. The question is whether the distance of
 * the two closed primitives is at most the separation h at some t in [0, 1]; h = 0 asks whether they
 * touch. */
#ifndef NEARMISS_QUERIES_H
#define NEARMISS_QUERIES_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** \cond */
#ifdef __cplusplus
#define NEARMISS_NULL nullptr
#else
#define NEARMISS_NULL NULL
#endif
/** \endcond */

/* Kinds of queries, as in nearmiss_subject.h. */
#define NEARMISS_VERTEX_TRIANGLE 1 /**< vertex x0, triangle x1 x2 x3 */
#define NEARMISS_EDGE_EDGE 2       /**< edges x0x1 and x2x3 */
#define NEARMISS_VERTEX_VERTEX 4   /**< vertices x0 and x1 */
#define NEARMISS_VERTEX_EDGE 8     /**< vertex x0, edge x1x2 */

/* Types of coordinates. */
#define NEARMISS_DOUBLE 0 /**< 64 bits */
#define NEARMISS_FLOAT 1  /**< 32 bits; a float means the double of the same value */

/* Answers. */
#define NEARMISS_NO_COLLISION 0 /**< the distance is always above the separation */
#define NEARMISS_COLLISION 1    /**< the distance is at most the separation at some time */
#define NEARMISS_NO_ANSWER (-1) /**< a number is not finite, or the separation is negative */

/* The status that a function returns. */
#define NEARMISS_OK 0         /**< all queries are answered */
#define NEARMISS_NOT_FINITE 1 /**< all queries are answered, some of them by NEARMISS_NO_ANSWER, or by NaN */
#define NEARMISS_BAD_ARGUMENT \
  2 /**< no answers: a null pointer, a number out of range, or a separation that wang does not take */
#define NEARMISS_OUT_OF_MEMORY 3 /**< some queries are not answered */

/** Queries of one kind. Each has n = nearmiss_vertices(kind) vertices. Coordinate k (0 to 2) of
 * vertex i (0 to n - 1) of query q is at
 *
 *     start + q * query_stride + v * vertex_stride + k * coordinate_stride
 *
 * at t = 0. At t = 1, `end` takes the place of `start`. Here v is vertices[n * q + i], or i if `vertices` is
 * null. Strides are in bytes, and may be 0 or negative. Coordinates must be aligned for their type.
 * nearmiss_packed() and nearmiss_of_mesh() fill in the usual cases. */
typedef struct {
  int kind;                    /**< NEARMISS_VERTEX_TRIANGLE or another kind */
  int type;                    /**< NEARMISS_DOUBLE or NEARMISS_FLOAT */
  size_t count;                /**< number of queries */
  const void* start;           /**< coordinates at t = 0 */
  const void* end;             /**< coordinates at t = 1 */
  ptrdiff_t query_stride;      /**< from a query to the next, in bytes */
  ptrdiff_t vertex_stride;     /**< from a vertex to the next, in bytes */
  ptrdiff_t coordinate_stride; /**< from a coordinate to the next, in bytes */
  const int32_t* vertices;     /**< n numbers v for each query, or null */
  const double* separation;    /**< h of the first query; null: h = 0 for all */
  ptrdiff_t separation_stride; /**< from the h of a query to the next, in bytes; 0 if all share one h */
} nearmiss_queries;

/** The number of vertices of a query of this kind; 0 if `kind` is not a kind. */
static inline int nearmiss_vertices(int kind) {
  switch (kind) {
    case NEARMISS_VERTEX_TRIANGLE:
    case NEARMISS_EDGE_EDGE:
      return 4;
    case NEARMISS_VERTEX_EDGE:
      return 3;
    case NEARMISS_VERTEX_VERTEX:
      return 2;
    default:
      return 0;
  }
}

/** Queries whose vertices lie one after another, three coordinates each. Each query begins `query_size`
 * coordinates after the query before it. */
static inline nearmiss_queries nearmiss_of_points(int kind, int type, size_t count, const int32_t* vertices,
                                                  const void* start, const void* end, ptrdiff_t query_size) {
  const ptrdiff_t of_float = sizeof(float);
  const ptrdiff_t of_double = sizeof(double);
  const ptrdiff_t size = type == NEARMISS_FLOAT ? of_float : of_double;
  const nearmiss_queries queries = {kind,     type, count,    start,         end, query_size * size,
                                    3 * size, size, vertices, NEARMISS_NULL, 0};
  return queries;
}

/** Queries that lie one after another in `x`. Each query is the coordinates of x0 x1 .. at t = 0, then those
 * at t = 1. */
static inline nearmiss_queries nearmiss_packed(int kind, size_t count, const double* x) {
  const ptrdiff_t half = 3 * nearmiss_vertices(kind);
  return nearmiss_of_points(kind, NEARMISS_DOUBLE, count, NEARMISS_NULL, x, x ? x + half : x, 2 * half);
}

/** nearmiss_packed() in float. */
static inline nearmiss_queries nearmiss_packed_float(int kind, size_t count, const float* x) {
  const ptrdiff_t half = 3 * nearmiss_vertices(kind);
  return nearmiss_of_points(kind, NEARMISS_FLOAT, count, NEARMISS_NULL, x, x ? x + half : x, 2 * half);
}

/** Pairs of a moving mesh: `vertices` has the numbers of the vertices of each pair, and `start` and `end`
 * have three coordinates for each vertex of the mesh, at t = 0 and t = 1. If each vertex has more than three
 * numbers, change vertex_stride. */
static inline nearmiss_queries nearmiss_of_mesh(int kind, size_t count, const int32_t* vertices,
                                                const double* start, const double* end) {
  return nearmiss_of_points(kind, NEARMISS_DOUBLE, count, vertices, start, end, 0);
}

/** nearmiss_of_mesh() in float. */
static inline nearmiss_queries nearmiss_of_mesh_float(int kind, size_t count, const int32_t* vertices,
                                                      const float* start, const float* end) {
  return nearmiss_of_points(kind, NEARMISS_FLOAT, count, vertices, start, end, 0);
}

/** The version of the library: major, minor and patch, such as "1.0.0". A program need not be compiled again
 * for a later version with the same major number. */
const char* nearmiss_version(void);

/** The explanation of a status that a function of the library returned. */
const char* nearmiss_message(int status);

#undef NEARMISS_NULL

#ifdef __cplusplus
}
#endif

#endif

// The subject wang as a plug-in with planted defects. If the environment variable NEARMISS_PLANTED is N > 0,
// one answer in N is wrong; the bits of the coordinates choose which one. If NEARMISS_SLOWED is a number
// above 1, the subject decides each query of the family kilometres several times, NEARMISS_SLOWED times on
// average. So this family becomes slower.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "ccd/nearmiss_subject.h"
#include "ccd/query/arithmetic.hpp"
#include "ccd/wang/wang.hpp"

namespace {

using nearmiss::Kind;
using nearmiss::Query;

/// The number in an environment variable; 0 if the variable is not set.
double number_in(const char* variable) {
  const char* const text = std::getenv(variable);
  return text == nullptr ? 0 : std::strtod(text, nullptr);
}

std::uint64_t hash_of(const Query& query) {
  std::uint64_t hash = 0;
  for (const double x : query.x) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15U;
    hash ^= hash >> 29;
  }
  return hash;
}

bool is_wrong(const Query& query) {
  static const auto one_in = static_cast<std::uint64_t>(number_in("NEARMISS_PLANTED"));
  return one_in != 0 && hash_of(query) % one_in == 0;
}

/// Whether a query is like those of the family kilometres: small primitives, far from the origin.
bool is_of_kilometres(const Query& query) {
  double farthest = 0;
  double size = 0;
  for (std::size_t i = 0; i < query.x.size(); ++i) {
    farthest = std::max(farthest, std::abs(query.x[i]));
    size = std::max(size, std::abs(query.x[i] - query.x[i % 3]));
  }
  return size <= 3 && farthest > 100 && farthest < 20000;
}

/// The number of times that a query is decided: NEARMISS_SLOWED on average if is_of_kilometres() is true for
/// the query, otherwise 1.
int decisions(const Query& query) {
  static const double mean = number_in("NEARMISS_SLOWED");
  if (!is_of_kilometres(query)) return 1;
  const double fraction = static_cast<double>(hash_of(query) % 1000) / 1000;
  return std::max(1, static_cast<int>(mean + fraction));
}

template <Kind kind>
int decide(const double* x) {
  Query query{.kind = kind};
  std::copy(x, x + query.x.size(), query.x.begin());
  volatile bool hit = false;  // keeps the compiler from removing repeated decisions
  int made = 0;
  do {
    hit = nearmiss::wang<kind, double, nearmiss::WangOptions{}>(query).hit;
    ++made;
    // The condition calls decisions() after each decision, so that the time of decisions() is multiplied,
    // too.
  } while (made < decisions(query));
  return hit != is_wrong(query) ? NEARMISS_COLLISION : NEARMISS_NO_COLLISION;
}

void decide_all(void* /*state*/, int kind, std::size_t n, const double* x, const double* /*h*/, int* answer,
                double* /*toi*/) {
  const bool is_vertex_triangle = kind == NEARMISS_VERTEX_TRIANGLE;
  for (std::size_t i = 0; i < n; ++i)
    answer[i] =
        is_vertex_triangle ? decide<Kind::vertex_triangle>(x + 24 * i) : decide<Kind::edge_edge>(x + 24 * i);
}

}  // namespace

extern "C" const nearmiss_subject* nearmiss_get_subject(std::size_t index) {
  static const nearmiss_subject subject = [] {
    nearmiss_subject own{};
    own.interface_version = NEARMISS_INTERFACE;
    own.name = "planted-in-wang";
    own.version = "1";
    own.about = "a CCD with a planted defect";
    own.kinds = NEARMISS_VERTEX_TRIANGLE | NEARMISS_EDGE_EDGE;
    own.decide = decide_all;
    return own;
  }();
  return index == 0 ? &subject : nullptr;
}

// The subjects basic and wang as plug-ins with a planted defect. If the environment variable NEARMISS_PLANTED
// is N, one answer in N is wrong, chosen by the bits of the coordinates. If it is 0 or not set, no answer is
// wrong.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "ccd/arithmetic.hpp"
#include "ccd/basic.hpp"
#include "ccd/nearmiss_subject.h"
#include "ccd/wang.hpp"

#define NEARMISS_QUOTED(x) #x
#define NEARMISS_TEXT(x) NEARMISS_QUOTED(x)

namespace {

using nearmiss::Kind;
using nearmiss::Query;

bool is_chosen(const Query& query) {
  static const char* const text = std::getenv("NEARMISS_PLANTED");
  static const unsigned long long one_in = text == nullptr ? 0 : std::strtoull(text, nullptr, 10);
  if (one_in == 0) return false;
  std::uint64_t hash = 0;
  for (const double x : query.x) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15U;
    hash ^= hash >> 29;
  }
  return hash % one_in == 0;
}

template <Kind kind>
bool basic(const Query& query) {
  return nearmiss::basic<kind, double, true>(query).hit;
}

template <Kind kind>
bool wang(const Query& query) {
  using nearmiss::WangOptions;
  return nearmiss::wang<kind, double, WangOptions{true, nearmiss::VeCulling::per_root}>(query, std::nullopt)
      .hit;
}

template <Kind kind>
int decide(const double* x) {
  Query query{.kind = kind};
  std::copy(x, x + query.x.size(), query.x.begin());
  const bool hit = PLANTED_IN<kind>(query);
  return hit != is_chosen(query) ? NEARMISS_COLLISION : NEARMISS_NO_COLLISION;
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
  static const nearmiss_subject subject{.interface_version = NEARMISS_INTERFACE,
                                        .name = "planted-in-" NEARMISS_TEXT(PLANTED_IN),
                                        .version = "1",
                                        .about = "a CCD with a planted defect",
                                        .kinds = NEARMISS_VERTEX_TRIANGLE | NEARMISS_EDGE_EDGE,
                                        .bits = 53,
                                        .time_sort = NEARMISS_NO_TIME,
                                        .takes_separation = 0,
                                        .batch = 1,
                                        .contract = {},
                                        .open = nullptr,
                                        .close = nullptr,
                                        .decide = decide_all,
                                        .distance_bound = nullptr};
  return index == 0 ? &subject : nullptr;
}

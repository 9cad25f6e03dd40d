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
int decide(const double* x, double* /*toi*/) {
  Query query{.kind = kind};
  std::copy(x, x + query.x.size(), query.x.begin());
  const bool hit = PLANTED_IN<kind>(query);
  return hit != is_chosen(query) ? 1 : 0;
}

}  // namespace

extern "C" const nearmiss_subject* nearmiss_get_subject() {
  static const nearmiss_subject subject{NEARMISS_SUBJECT_ABI,
                                        "planted-in-" NEARMISS_TEXT(PLANTED_IN),
                                        "1",
                                        decide<Kind::vertex_triangle>,
                                        decide<Kind::edge_edge>,
                                        nullptr};
  return &subject;
}

// The subjects basic and wang as plug-ins, with a defect that the environment plants: the wrong way round is the answer to
// one query in NEARMISS_PLANTED, chosen by the bits of its coordinates; none if that is 0 or not set.
#include <bit>
#include <cstdlib>
#include <limits>

#include "ccd/arithmetic.hpp"
#include "ccd/basic.hpp"
#include "ccd/nearmiss_subject.h"
#include "ccd/wang.hpp"

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
int decide(const double* x, double* /*toi*/) {
  Query query{.kind = kind};
  std::copy(x, x + query.x.size(), query.x.begin());
#ifdef PLANTED_IN_WANG
  const bool hit = nearmiss::wang<kind, double, nearmiss::WangOptions{true, nearmiss::VeCulling::per_root}>(
                       query, std::nullopt)
                       .hit;
#else
  const bool hit = nearmiss::basic<kind, double, true>(query).hit;
#endif
  return hit != is_chosen(query) ? 1 : 0;
}

}  // namespace

extern "C" const nearmiss_subject* nearmiss_get_subject() {
  static const nearmiss_subject subject{NEARMISS_SUBJECT_ABI,
#ifdef PLANTED_IN_WANG
                                        "planted-in-wang",
#else
                                        "planted-in-basic",
#endif
                                        "1",
                                        decide<Kind::vertex_triangle>,
                                        decide<Kind::edge_edge>,
                                        nullptr};
  return &subject;
}

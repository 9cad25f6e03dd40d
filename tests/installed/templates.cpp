// Uses the header-only CCD together with the library, to check that their names do not clash.
#include <nearmiss/ccd/pair_bound.hpp>
#include <nearmiss/ccd/wang.hpp>
#include <nearmiss/ccd/wang_time.hpp>

#include <cstdio>
#include <nearmiss/contact.hpp>
#include <nearmiss/nearmiss.hpp>
extern "C" {
#include <nearmiss/ccd/nearmiss_subject.h>
}

int main() {
  using nearmiss::Kind;
  const nearmiss::Query query{
      .kind = Kind::vertex_triangle,
      .x = {0.25, 0.25, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.25, 0.25, -1, 0, 0, 0, 1, 0, 0, 0, 1, 0}};
  const bool hit = nearmiss::wang<Kind::vertex_triangle, double, nearmiss::WangOptions{}>(query).hit;
  const auto tolerances = nearmiss::paper_tolerances(1.0);
  const double bound = nearmiss::distance_bound_of(tolerances, nearmiss::pair_bound(query));
  const bool agree = nearmiss::wang(Kind::vertex_triangle, query.x) == nearmiss::Answer::collision &&
                     bound == nearmiss::wang_bound(Kind::vertex_triangle, query.x);
  std::printf("templates: %s, %s\n", hit ? "a collision" : "MISSED",
              agree ? "as the library" : "NOT as the library");
  return hit && agree ? 0 : 1;
}

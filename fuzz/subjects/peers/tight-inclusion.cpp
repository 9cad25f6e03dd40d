// Tight-Inclusion (Wang, Ferguson, Schneider, Jiang, Attene and Panozzo, "A large-scale benchmark and an
// inclusion-based algorithm for continuous collision detection", 2021).
// Source: github.com/Continuous-Collision-Detection/Tight-Inclusion, ca9a8c24. Licence: MIT.
// Question: contact, or a separation. The time of impact is a lower bound. If the iterations run out, the
// answer is "cannot tell". Contract: none.
// $TIGHT_INCLUSION is the folder in which Tight-Inclusion is installed:
//
//   tools/subject --pkg-config 'eigen3 spdlog' fuzz/subjects/peers/tight-inclusion.cpp --
//       -I$TIGHT_INCLUSION/include $TIGHT_INCLUSION/lib/libtight_inclusion.a
#include <tight_inclusion/ccd.hpp>

#include "ccd/nearmiss_functions.hpp"

namespace {

using nearmiss::plugin::Answer;
using nearmiss::plugin::Question;

struct Settings {
  double tolerance = ticcd::DEFAULT_CCD_DISTANCE_TOL;
  double iterations = 1e6;  // the value that the authors' benchmark passes; -1: no limit
};

constexpr std::array<nearmiss::Option<Settings>, 2> settings{
    {{"tolerance", &Settings::tolerance, 1e-300, 1e300}, {"iterations", &Settings::iterations, -1, 1e15}}};

Answer decide(const Settings& set, const Question& q) {
  const ticcd::Array3 of_query =
      // -1: the CCD allows for the rounding errors of this query, not for those of a whole scene.
      ticcd::Array3::Constant(-1);
  double toi = 0, reached = 0;
  const auto test = q.kind == NEARMISS_VERTEX_TRIANGLE ? ticcd::vertexFaceCCD : ticcd::edgeEdgeCCD;
  const bool collides = with_vertices(q, [&](const auto&... v) {
    return test(v..., of_query, q.separation, toi, set.tolerance, 1, static_cast<long>(set.iterations),
                reached, ticcd::DEFAULT_NO_ZERO_TOI, ticcd::CCDRootFindingMethod::BREADTH_FIRST_SEARCH);
  });
  // If the CCD runs out of iterations before it reaches the tolerance, it returns `true` without knowing the
  // answer.
  if (collides && reached > set.tolerance) return {NEARMISS_UNKNOWN, toi};
  return Answer::of(collides, toi);
}

}  // namespace

NEARMISS_SUBJECT(detector("tight-inclusion", "ca9a8c24",
                          "Tight-Inclusion, conservative; options tolerance=1e-6, iterations=1e6 (-1: no "
                          "limit; unknown if they "
                          "run out)")
                     .options<settings>()
                     .vertex_triangle(decide)
                     .edge_edge(decide)
                     .set(&nearmiss_subject::time_sort, NEARMISS_TIME_LOWER_BOUND)
                     .set(&nearmiss_subject::takes_separation, 1))

// Tight-Inclusion (Wang, Ferguson, Schneider, Jiang, Attene and Panozzo, "A large-scale benchmark and an
// inclusion-based algorithm for continuous collision detection", 2021).
#include <tight_inclusion/ccd.hpp>

#include "fuzz/subjects/peers/sources/eigen.hpp"

namespace nearmiss::peers {
namespace {

struct Settings {
  double tolerance = ticcd::DEFAULT_CCD_DISTANCE_TOL;
  double iterations = 1e6;  // as in the authors' benchmark; -1: no limit
};

constexpr std::array<Option<Settings>, 2> options{
    {{"tolerance", &Settings::tolerance, 1e-300, 1e300}, {"iterations", &Settings::iterations, -1, 1e15}}};

Answer decide(const void* state, int kind, const Question& q) {
  const auto& settings = *static_cast<const Settings*>(state);
  const ticcd::Array3 of_query =
      ticcd::Array3::Constant(-1);  // rounding errors bounded for the query, not for a scene
  double toi = 0, reached = 0;
  const bool collides = with_vectors(q, [&](const auto&... v) {
    const auto test = kind == NEARMISS_VERTEX_TRIANGLE ? ticcd::vertexFaceCCD : ticcd::edgeEdgeCCD;
    return test(v..., of_query, q.separation, toi, settings.tolerance, 1,
                static_cast<long>(settings.iterations), reached, ticcd::DEFAULT_NO_ZERO_TOI,
                ticcd::CCDRootFindingMethod::BREADTH_FIRST_SEARCH);
  });
  // It ran out of iterations before the tolerance was reached, and says `true` without knowing.
  if (collides && reached > settings.tolerance) return {NEARMISS_UNKNOWN, toi};
  return Answer::of(collides, toi);
}

nearmiss_subject subject() {
  nearmiss_subject subject = detector<decide>(
      "tight-inclusion", "ca9a8c24",
      "Tight-Inclusion, conservative; options tolerance=1e-6, iterations=1e6 (-1: no limit; unknown if they "
      "run out)");
  subject.time_sort = NEARMISS_TIME_LOWER_BOUND;
  subject.takes_separation = 1;
  take_options<Settings, options>(subject);
  return subject;
}

}  // namespace
}  // namespace nearmiss::peers

const nearmiss_subject* nearmiss_get_subject(std::size_t index) {
  return nearmiss::peers::numbered<nearmiss::peers::subject>(index);
}

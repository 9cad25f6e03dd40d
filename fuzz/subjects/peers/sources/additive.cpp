// Additive CCD (Li, Kaufman and Jiang, "Codimensional incremental potential contact", 2021) as implemented in
// ipc-toolkit. Its authors say there that rounding errors can make it miss collisions.
#include <ipc/ccd/additive_ccd.hpp>

#include "fuzz/subjects/peers/sources/eigen.hpp"

namespace nearmiss::peers {
namespace {

struct Settings {
  double rescaling = ipc::AdditiveCCD::DEFAULT_CONSERVATIVE_RESCALING;
  double iterations = ipc::AdditiveCCD::UNLIMITTED_ITERATIONS;
};

constexpr std::array<Option<Settings>, 2> options{
    {{"rescaling", &Settings::rescaling, 1e-3, 1}, {"iterations", &Settings::iterations, -1, 1e15}}};

Answer decide(const void* state, int kind, const Question& q) {
  const auto& settings = *static_cast<const Settings*>(state);
  const ipc::AdditiveCCD ccd(static_cast<long>(settings.iterations), settings.rescaling);
  double toi = 0;
  const bool collides = with_vectors(q, [&](const auto&... v) {
    return kind == NEARMISS_VERTEX_TRIANGLE ? ccd.point_triangle_ccd(v..., toi, q.separation)
                                            : ccd.edge_edge_ccd(v..., toi, q.separation);
  });
  return Answer::of(collides, toi);
}

nearmiss_subject subject() {
  nearmiss_subject subject = detector<decide>(
      "additive", "b40e9c07",
      "additive CCD of ipc-toolkit, conservative advancement; options rescaling=0.9, iterations=-1 (no "
      "limit)");
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

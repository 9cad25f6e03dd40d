// The minimum separation root finder (Harmon, Panozzo, Sorkine and Zorin, "Interference-aware geometric
// modeling", 2011, in the implementation of the Tight-Inclusion authors). It looks for the times at which the
// distance is equal to a separation, and accepts those at which the squared distance is at most h² + h / 10.
// With h = 0, that leaves no room for rounding, and it finds hardly any collision, so it is always asked with
// a separation h > 0. It does not notice if the distance is below h already at t = 0.
#include <minimum_separation_root_finder.hpp>

#include "fuzz/subjects/peers/sources/eigen.hpp"

namespace nearmiss::peers {
namespace {

/// The separation that stands for contact: what its authors use in their benchmark when they want collisions
/// at distance 0 (DEFAULT_MIN_DISTANCE of CCD-Wrapper, src/ccd.hpp).
constexpr double contact = 1e-8;

Answer decide(const void* /*state*/, int kind, const Question& q) {
  const double separation = q.separation > 0 ? q.separation : contact;
  double toi = 0;
  const bool collides = with_vectors(q, [&](const auto&... v) {
    const auto test = kind == NEARMISS_VERTEX_TRIANGLE ? msccd::root_finder::vertexFaceMSCCD
                                                       : msccd::root_finder::edgeEdgeMSCCD;
    return test(v..., separation, toi);
  });
  return Answer::of(collides, toi);
}

nearmiss_subject subject() {
  nearmiss_subject subject = detector<decide>(
      "msrf", "1aeb9ac0",
      "minimum separation root finder; when asked for contact, answers for a separation of 1e-8");
  subject.time_sort = NEARMISS_TIME_ESTIMATE;
  subject.takes_separation = 1;
  subject.contract.apart_at_start = 1;
  subject.contract.apart_by = contact;
  return subject;
}

}  // namespace
}  // namespace nearmiss::peers

const nearmiss_subject* nearmiss_get_subject(std::size_t index) {
  return nearmiss::peers::numbered<nearmiss::peers::subject>(index);
}

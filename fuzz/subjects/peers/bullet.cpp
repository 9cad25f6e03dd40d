// The continuous collision detection of Bullet's soft bodies, which tests vertices against triangles, but no
// edges. This adapter is compiled twice: with Bullet in single precision, and in double precision
// (BT_USE_DOUBLE_PRECISION).
// Built with Debian's libbullet-dev 3.24. Licence: zlib.
// Question: contact. Contract: none.
//
//   tools/subject --pkg-config bullet fuzz/subjects/peers/bullet.cpp
#include <BulletSoftBody/btSoftBodyInternals.h>

#include "ccd/nearmiss_functions.hpp"

namespace {

using nearmiss::plugin::Answer;
using nearmiss::plugin::Question;

constexpr btScalar dt = 1;  // in our queries, the unit of time is the time step

/// The normal of a triangle, not normalised.
btVector3 normal(const btVector3& a, const btVector3& b, const btVector3& c) { return (b - a).cross(c - a); }

/// Fills a node (the vertex) and a face as Bullet's world does, and calls bernsteinCCD. Bullet computes the
/// positions at the end of the time step from velocities, so it sees our positions at t = 1 with rounding
/// errors.
Answer decide(const Question& q) {
  std::array<btSoftBody::Node, 4> nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    btSoftBody::Node& node = nodes[i];
    node.m_x = q.start(i);
    node.m_v = (btVector3(q.end(i)) - node.m_x) / dt;
    node.m_q = node.m_x + dt * node.m_v;
  }
  btSoftBody::Node &a = nodes[1], &b = nodes[2], &c = nodes[3];
  btSoftBody::Face face;
  face.m_n[0] = &a;
  face.m_n[1] = &b;
  face.m_n[2] = &c;
  face.m_n0 = normal(a.m_x, b.m_x, c.m_x);
  face.m_n1 = normal(a.m_q, b.m_q, c.m_q);
  face.m_vn = normal(a.m_v, b.m_v, c.m_v) * dt * dt;
  btVector3 weights;
  return Answer::of(bernsteinCCD(&face, nodes.data(), dt, SAFE_EPSILON, weights));
}

const std::string version =
    std::to_string(BT_BULLET_VERSION / 100) + "." + std::to_string(BT_BULLET_VERSION % 100);

}  // namespace

#ifdef BT_USE_DOUBLE_PRECISION
NEARMISS_SUBJECT(detector("bullet-double", version.c_str(),
                          "the CCD of Bullet's soft bodies, in double precision; vertex-triangle only")
                     .vertex_triangle(decide))
#else
NEARMISS_SUBJECT(detector("bullet", version.c_str(),
                          "the CCD of Bullet's soft bodies, in single precision; vertex-triangle only")
                     .vertex_triangle(decide)
                     .set(&nearmiss_subject::bits, 24))
#endif

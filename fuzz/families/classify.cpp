#include "fuzz/families/classify.hpp"
#include <cmath>
#include <Eigen/Dense>
namespace nearmiss {
QueryClass classify(const Query& q) {
  double largest = 0;
  for (double c : q.x) largest = std::max(largest, std::abs(c));
  if (largest > 1e30 || largest < 1e-30) return QueryClass::extreme;
  for (int time = 0; time < 2; ++time) {
    auto at = [&](int i) { return time == 0 ? q.start(i) : q.end(i); };
    const Vector3<double> a = at(1) - at(0), b = at(2) - at(0), c = at(3) - at(0);
    if (std::abs(a.dot(b.cross(c))) <= 1e-6 * a.norm() * b.norm() * c.norm()) return QueryClass::degenerate;
  }
  return QueryClass::ordinary;
}
}

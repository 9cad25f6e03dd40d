// libFuzzer: OBJ files.
#include <algorithm>

#include "fuzz/libfuzzer/reader_target.hpp"
#include "fuzz/scenes/mesh.hpp"

void nearmiss::libfuzzer::read(std::istream& in) {
  const Mesh mesh = parse_obj(in, "input.obj");
  const int points = static_cast<int>(mesh.points.size());
  expect(!mesh.triangles.empty(), "a triangle");
  for (const auto& p : mesh.points) expect(p.allFinite(), "finite coordinates");
  for (const auto& t : mesh.triangles)
    expect(std::all_of(t.begin(), t.end(), [&](int i) { return 0 <= i && i < points; }),
           "vertices that exist");
}

// Tests the search for pairs whose swept boxes meet, in meshes of every sort, and in successive steps of a
// mesh.
#include "fuzz/scenes/candidates.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "ccd/query/error.hpp"
#include "fuzz/random.hpp"
#include "fuzz/stop.hpp"
#include "oracle/filter/box.hpp"
#include "tests/fuzz/moving_meshes.hpp"

namespace nearmiss {
namespace {

/// The candidates of a mesh, in the order in which a new finder finds them.
std::vector<Candidate> found_candidates(const MovingMesh& mesh) {
  std::vector<Candidate> found;
  find_candidates(mesh, [&](const Candidate& candidate) { found.push_back(candidate); });
  return found;
}

/// All pairs whose boxes meet, in the order of their rows. The finder must give the same list.
std::vector<Candidate> candidates_by_brute_force(const MovingMesh& mesh) {
  std::vector<Candidate> found;
  for (const Kind kind : kinds_of_meshes)
    for (std::size_t row = 0; row < pair_rows(mesh, kind); ++row)
      for_pairs_of_row(
          mesh, kind, row,
          [&](const Candidate& candidate) {
            if (boxes_meet(make_query(mesh, candidate))) found.push_back(candidate);
          },
          never_over);
  return found;
}

using Points = std::vector<Vector3<double>>;
using Point = std::function<Vector3<double>(Random&)>;

/// Expects that the finder finds the same pairs as brute force, without a separation and with each of the
/// given separations. Returns the number of candidates.
std::size_t expect_brute_force(MovingMesh mesh, const std::vector<double>& separations = {}) {
  const auto expected = candidates_by_brute_force(mesh);
  EXPECT_TRUE(found_candidates(mesh) == expected);
  for (const double separation : separations) {
    mesh.separation = separation;
    EXPECT_TRUE(found_candidates(mesh) == candidates_by_brute_force(mesh)) << "separation " << separation;
  }
  return expected.size();
}

/// A mesh with integer coordinates. The points of each triangle have indices near each other.
MovingMesh random_mesh(std::uint64_t seed, int points, int triangles) {
  Random random(seed, 0, 0);
  Points start;
  Points end;
  std::vector<std::array<int, 3>> faces;
  for (int i = 0; i < points; ++i) {
    start.push_back(random.integer_vector(6));
    end.push_back(start.back() + random.integer_vector(1));
  }
  for (int i = 0; i < triangles; ++i) {
    const int a = random.integer(0, points - 4);
    faces.push_back({a, a + 1, a + random.integer(2, 3)});
  }
  return make_moving_mesh({start, faces, {}}, end);
}

// Many boxes of this mesh only touch each other, or are exactly the separation apart.
TEST(Candidates, FindsTheSameAsBruteForceWithIntegerCoordinates) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    EXPECT_GT(
        expect_brute_force(random_mesh(seed, 60, 80), {1, 2, 0.3, std::numeric_limits<double>::denorm_min()}),
        100);
  }
}

TEST(Candidates, InManyPartsPairsAreFoundOnceAndThoseWithACommonVertexAreCounted) {
  const MovingMesh mesh = random_mesh(1, 600, 900);
  EXPECT_TRUE(found_candidates(mesh) == candidates_by_brute_force(mesh));
  const CandidateSink ignore = [](const Candidate& /*candidate*/) {};
  for (const Kind kind : kinds_of_meshes) {
    std::uint64_t expected = 0;
    for (std::size_t row = 0; row < pair_rows(mesh, kind); ++row)
      expected += for_pairs_of_row(mesh, kind, row, ignore, never_over);
    const CandidateFinder finder(mesh, kind, 1, never_over);
    ASSERT_GT(finder.parts(), 3);
    std::uint64_t sharing = 0;
    for (std::size_t part = 0; part < finder.parts(); ++part)
      sharing += finder.find(part, ignore, never_over);
    EXPECT_EQ(sharing, expected);
    EXPECT_GT(sharing, 1000);
  }
}

/// A vertex at rest, at a height along an axis, beside a triangle at rest whose box is the unit cube.
MovingMesh vertex_beside_triangle(int axis, double height) {
  Vector3<double> vertex(0.5, 0.5, 0.5);
  vertex[axis] = height;
  const Points points{{0, 0, 0}, {1, 1, 0}, {0, 1, 1}, vertex};
  return make_moving_mesh({points, {{0, 1, 2}}, {}}, points);
}

// The vertex is exactly at a side of the box, or one double away from it.
TEST(Candidates, BoxesThatTouchMeet) {
  for (int axis = 0; axis < 3; ++axis)
    for (const auto& [height, expected] :
         {std::pair(0.0, 1), {1.0, 1}, {-0x1p-1074, 0}, {1 + 0x1p-52, 0}, {0x1p-1074, 1}, {1 - 0x1p-53, 1}})
      EXPECT_EQ(found_candidates(vertex_beside_triangle(axis, height)).size(), expected)
          << axis << ' ' << height;
}

MovingMesh any_mesh(std::uint64_t seed, int n, const Point& point) {
  Random random(seed, 0, 0);
  Mesh mesh;
  Points end;
  const auto any = [&] { return random.integer(0, n - 1); };
  for (int i = 0; i < n; ++i) {
    mesh.points.push_back(point(random));
    end.push_back(point(random));
    mesh.triangles.push_back({any(), any(), any()});
    mesh.lines.push_back({any(), any()});
  }
  return make_moving_mesh(std::move(mesh), std::move(end));
}

/// Separations: distances between two coordinates of a mesh, and the doubles next to these distances.
std::vector<double> distances(const MovingMesh& mesh, std::uint64_t seed) {
  Random random(seed, 1, 0);
  const auto any = [&](const Points& points) {
    return points[static_cast<std::size_t>(random.integer(0, static_cast<int>(points.size()) - 1))];
  };
  std::vector<double> found;
  for (int k = 0; k < 3; ++k) {
    const double distance = std::abs(any(mesh.start)[k] - any(mesh.end)[k]);
    if (!std::isfinite(distance) || distance == 0) continue;
    for (const double towards : {0.0, distance, std::numeric_limits<double>::max()})
      if (const double next = std::nextafter(distance, towards); next > 0) found.push_back(next);
  }
  return found;
}

TEST(Candidates, FindsTheSameAsBruteForceInAnyRangeOfCoordinates) {
  for (const double size : {0x1p-1074, 0x1p-1060, 1e-310, 1e-300, 1e-200, 1.0, 1e17, 1e200, 1e300, 8e307})
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      SCOPED_TRACE(testing::Message() << "size " << size << ", seed " << seed);
      const MovingMesh mesh = any_mesh(seed, 40, [&](Random& random) -> Vector3<double> {
        return size * (random.integer_vector(9) / 4.5);
      });
      EXPECT_GT(expect_brute_force(mesh, distances(mesh, seed)), 100);
    }
}

TEST(Candidates, FindsTheSameAsBruteForceWithCoordinatesOfAllSizesAtOnce) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const MovingMesh mesh = any_mesh(seed, 40, [](Random& random) {
      Vector3<double> p;
      for (int k = 0; k < 3; ++k)
        p[k] = (random.one_in(2) ? 1 : -1) * std::ldexp(1 + random.uniform(), random.integer(-1074, 1022));
      return p;
    });
    EXPECT_GT(expect_brute_force(mesh, distances(mesh, seed)), 100) << seed;
  }
}

// All coordinates are a few ulps from 1, where the spacing of doubles changes by a factor of two. The sum of
// a coordinate and a separation is rounded, and cells are smaller than an ulp.
TEST(Candidates, FindsTheSameAsBruteForceInAMeshOfAFewUlps) {
  const double ulp = 0x1p-53;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const MovingMesh mesh = any_mesh(seed, 60, [ulp](Random& random) -> Vector3<double> {
      return Vector3<double>(1, 1, 1) + ulp * random.integer_vector(40);
    });
    EXPECT_GT(expect_brute_force(mesh, {ulp / 2, ulp, 1.5 * ulp, 2 * ulp, 3 * ulp, 5 * ulp, 7 * ulp}), 100);
  }
}

// The separation is the distance between a vertex and a triangle, rounded to a double. The midpoint between
// the vertex and the triangle lies on the border of two cells, because the grid extends from -2 to 2 times
// the midpoint.
TEST(Candidates, LosesNoPairWhoseDistanceIsRoundedToTheSeparation) {
  std::size_t found = 0;
  Random random(1, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    const double vertex = random.uniform(0.5, 2);
    const double triangle = random.uniform(-0.1, 0.3);
    const double separation = vertex - triangle;
    const double middle = vertex - separation / 2;
    const Points points{{vertex, 0, 0},      {triangle, 0, 0},   {triangle, 1e-9, 0},
                        {triangle, 0, 1e-9}, {2 * middle, 0, 0}, {-2 * middle, 0, 0}};
    MovingMesh mesh = make_moving_mesh({points, {{1, 2, 3}}, {}}, points);
    mesh.separation = separation;
    const auto expected = candidates_by_brute_force(mesh);
    ASSERT_EQ(found_candidates(mesh), expected) << i;
    found += expected.size();
  }
  EXPECT_GT(found, 1000);
}

TEST(Candidates, FindsAllPairsOfEqualBoxes) {
  const MovingMesh mesh = any_mesh(1, 70, [](Random& random) -> Vector3<double> {
    return {0, random.one_in(2) ? 1.0 : -1.0, 3};
  });
  EXPECT_GT(expect_brute_force(mesh, {1.0, 2.0}), 1000);
  const MovingMesh point = any_mesh(1, 70, [](Random&) -> Vector3<double> { return {5, 5, 5}; });
  EXPECT_GT(expect_brute_force(point, {1.0, 1e308}), 1000);
}

// A group holds four boxes. So the smallest of these meshes have one group, and larger meshes have two
// groups, a group of groups, and so on.
TEST(Candidates, FindsTheSameAsBruteForceInMeshesOfFewPrimitives) {
  std::size_t found = 0;
  for (int n = 1; n <= 40; ++n)
    found += expect_brute_force(any_mesh(3, n, [](Random& random) { return random.integer_vector(4); }));
  EXPECT_GT(found, 2000);
  EXPECT_EQ(expect_brute_force(make_moving_mesh({}, {})), 0);
  const Points corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(expect_brute_force(make_moving_mesh({corners, {{0, 1, 2}}, {}}, corners)), 0);
}

std::vector<Candidate> all_of(const CandidateFinder& finder) {
  std::vector<Candidate> found;
  for (std::size_t part = 0; part < finder.parts(); ++part)
    finder.find(
        part, [&](const Candidate& each) { found.push_back(each); }, never_over);
  return found;
}

/// Moves each tetrahedron by a random vector, whose components have magnitudes of at most `way`.
void displace(Points& points, Random& random, double way) {
  for (std::size_t first = 0; first < points.size(); first += 4) {
    const Vector3<double> displacement = random.vector(way);
    for (std::size_t i = 0; i < 4; ++i) points[first + i] += displacement;
  }
}

// In the first steps, bodies move a little, and the tree keeps its groups. Then the bodies fly apart.
TEST(Candidates, AMovedFinderFindsTheSameAsANewOne) {
  for (const Kind kind : kinds_of_meshes)
    for (const int jobs : {1, 3}) {
      MovingMesh mesh = tetrahedra(1, 400);
      CandidateFinder finder(mesh, kind, jobs, never_over);
      Random random(1, 0, 0);
      for (int step = 0; step < 6; ++step) {
        mesh.start = mesh.end;
        displace(mesh.end, random, 0.1);
        if (step >= 3) {
          displace(mesh.start, random, 20);
          mesh.end = mesh.start;
        }
        mesh.separation = step % 2 == 0 ? 0 : 0.25;
        finder.move(mesh, jobs, never_over);
        const auto found = all_of(finder);
        EXPECT_GT(found.size(), 200) << step;
        EXPECT_TRUE(found == all_of(CandidateFinder(mesh, kind, 1, never_over))) << step;
      }
    }
}

TEST(Candidates, StopsWhenItIsTold) {
  const MovingMesh mesh = grids(60);
  EXPECT_THROW(CandidateFinder(mesh, Kind::edge_edge, 1, [] { return true; }), Stopped);
  const CandidateFinder finder(mesh, Kind::edge_edge, 1, never_over);
  int all = 0;
  finder.find(
      0, [&](const Candidate&) { ++all; }, never_over);
  int found = 0;
  finder.find(
      0, [&](const Candidate&) { ++found; }, [&] { return found > 0; });
  EXPECT_GT(found, 0);
  EXPECT_LT(found, all / 2);
}

TEST(Candidates, RefusesCoordinatesThatAreNotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    MovingMesh mesh = tetrahedra(1);
    mesh.end[5][2] = bad;
    EXPECT_THROW(found_candidates(mesh), Error);
  }
}

}  // namespace
}  // namespace nearmiss

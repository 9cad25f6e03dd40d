// The published CCDs that are built together with nearmiss, and the names and adapters of all published CCDs.
#include "fuzz/subjects/peers.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <set>
#include <string>

#include "fuzz/subjects/subjects.hpp"
#include "oracle/oracle.hpp"
#include "tests/queries.hpp"
#include "tests/refused.hpp"

namespace nearmiss {
namespace {

constexpr const char* with_both_kinds[] = {"fcl", "fcl-newton"};
constexpr const char* from_debian[] = {"fcl", "fcl-newton", "bullet", "bullet-double"};

/// A vertex that crosses the triangle at an angle, with all coordinates in motion.
Query crossing_vertex() {
  Query query = testing::falling_vertex(0.25, 0.25, 1, -1);
  query.set_end(0, Vector3<double>(0.375, 0.3125, -1));
  return query;
}

TEST(Peers, DecideAPlainHitAndAPlainMiss) {
  ASSERT_TRUE(collides(crossing_vertex()));
  for (const char* name : from_debian) {
    const auto subject = make_any_subject(name);
    EXPECT_EQ(subject->name(), name);
    EXPECT_TRUE(subject->decide(crossing_vertex()).hit) << name;
    EXPECT_FALSE(subject->decide(testing::falling_vertex(0.25, 0.25, 2, 1)).hit) << name;
    EXPECT_FALSE(subject->decide(testing::falling_vertex(4, 4, 1, -1)).hit) << name;
  }
  for (const char* name : with_both_kinds) {
    const auto subject = make_any_subject(name);
    EXPECT_NEAR(subject->decide(crossing_vertex()).time, 0.5, 1e-6) << name;
    EXPECT_TRUE(subject->decide(testing::falling_edge(1, -1)).hit) << name;
    EXPECT_FALSE(subject->decide(testing::falling_edge(2, 1)).hit) << name;
  }
}

TEST(Peers, BulletDecidesVertexTriangleOnlyAndInFloatWhereItIsBuiltSo) {
  for (const char* name : {"bullet", "bullet-double"}) {
    const auto subject = make_any_subject(name);
    EXPECT_TRUE(subject->decides(Kind::vertex_triangle)) << name;
    EXPECT_FALSE(subject->decides(Kind::edge_edge)) << name;
    EXPECT_EQ(subject->rounds(), std::string(name) == "bullet") << name;
  }
}

// Bullet looks for an axis along which the triangle is on one side of the vertex. Let an axis be
// perpendicular to the vertex's path, and let the triangle have corners on both sides of the vertex along
// this axis. Bullet then takes the vertex and the triangle for separated, unless a corner has exactly the
// vertex's coordinate along the axis.
TEST(Peers, BulletMissesAVertexThatFallsStraightDown) {
  const Query falls = testing::falling_vertex(0.25, 0.25, 1, -1);
  ASSERT_TRUE(collides(falls));
  for (const char* name : {"bullet", "bullet-double"})
    EXPECT_FALSE(make_any_subject(name)->decide(falls).hit) << name;
}

TEST(Peers, NamesAreUniqueAndNoneIsBuiltIn) {
  std::set<std::string_view> names;
  for (const SubjectInfo& info : built_in_subjects()) names.insert(info.name);
  for (const Peer& peer : peers()) EXPECT_TRUE(names.insert(peer.name).second) << peer.name;
}

TEST(Peers, EachHasAnAdapter) {
  const std::filesystem::path adapters(NEARMISS_PEER_ADAPTERS);
  std::set<std::string> expected, found;
  for (const Peer& peer : peers()) expected.insert(std::string(peer.adapter));
  for (const auto& each : std::filesystem::directory_iterator(adapters))
    if (each.path().extension() == ".cpp") found.insert(each.path().stem().string());
  EXPECT_EQ(found, expected);
}

TEST(Peers, ANameStandsForThePluginThatWasBuilt) {
  EXPECT_THAT(plugin_of_peer("fcl-newton").value(), ::testing::EndsWith("/peers/fcl.so:fcl-newton"));
  EXPECT_FALSE(plugin_of_peer("fcl-bisection"));
  EXPECT_REFUSED(make_any_subject("fcl:tolerance=1"), "fcl: found the options 'tolerance=1', expected none");
  for (const char* known : {"wang", "fcl, fcl-newton, bullet", "additive"})
    EXPECT_REFUSED(make_any_subject("fkl"), known);
}

}  // namespace
}  // namespace nearmiss

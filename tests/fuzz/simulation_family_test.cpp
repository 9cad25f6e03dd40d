// Families of the queries that simulations ask.
#include "fuzz/simulation/simulation_family.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <set>

#include "fuzz/scenes/scene_trial.hpp"
#include "tests/bit_hash.hpp"
#include "tests/fuzz/trials.hpp"
#include "tests/refused.hpp"

namespace nearmiss {
namespace {

using QueryCoordinates = std::array<double, 24>;

/// The pairs about which a simulation asks its CCD. The simulation runs as in `nearmiss simulate`, with the
/// CCD `exact`.
std::set<QueryCoordinates> pairs_asked(const std::string& scene) {
  const Subjects subjects = testing::subjects_named({"exact"});
  Trials trials(subjects, {}, 1, Stop::never(), false, [](TrialResult&&) {});
  Simulation simulation = SimulationOptions{.scene = scene}.simulation();
  const Scene named{.name = scene, .frames = simulation.steps() + 1, .mesh = {}, .points = {}};
  SceneTrial trial(named, LeaveOut::boxes, trials);
  std::set<QueryCoordinates> asked;
  for (std::size_t step = 0; step < simulation.steps(); ++step) {
    SimulatedStep counts;
    simulation.advance([&](const MovingMesh& motion, const auto& is_asked) {
      find_candidates(motion, [&](const Candidate& pair) {
        if (is_asked(pair)) asked.insert(make_query(motion, pair).x);
      });
      return trial.ask(step, motion, is_asked, counts);
    });
  }
  trials.finish();
  return asked;
}

TEST(SimulationFamily, AsksWhatASimulationAsks) {
  const auto asked = pairs_asked("cloths@16");
  const Family family = find_any_family("sim:cloths@16");
  std::set<QueryCoordinates> drawn;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Query query = make_query(family, 1, i);
    ASSERT_EQ(query.kind, kinds_of_meshes[i % 2]);
    ASSERT_TRUE(asked.contains(query.x)) << i;
    drawn.insert(query.x);
  }
  EXPECT_GT(drawn.size(), 1500);
}

/// A finding names its query by the query's family, seed and index. The same family, seed and index must
/// always give the same query.
TEST(SimulationFamily, QueriesStayTheSame) {
  const auto fingerprint = [](const char* name) {
    const Family family = find_any_family(name);
    testing::BitHash hash;
    for (std::uint64_t i = 0; i < 200; ++i) hash.add_all(make_query(family, 7, i).x);
    return hash.value();
  };
  EXPECT_EQ(fingerprint("sim:cloths@50"), 0xdfe28e1686e7b396U);
  EXPECT_EQ(fingerprint("sim:cloths@50:stiffness=500:step=2ms"), 0x776bd0416833388cU);
  EXPECT_EQ(fingerprint("sim:hair@100:steps-per-frame=1"), 0x483abdaac83548f4U);
}

TEST(SimulationFamily, MayHaveASeparation) {
  const Family family = find_any_family("sim:cloths@16:step=2ms~0.125");
  EXPECT_EQ(family.name, "sim:cloths@16:step=2ms~0.125");
  EXPECT_EQ(make_query(family, 1, 0).separation, 0.125);
  EXPECT_EQ(find_any_family("uniform").name, "uniform");
}

TEST(SimulationFamily, HairHasOnlyPairsOfEdges) {
  const Family hair = find_any_family("sim:hair@100:steps-per-frame=1");
  for (std::uint64_t i = 0; i < 20; ++i) EXPECT_EQ(make_query(hair, 1, i).kind, Kind::edge_edge);
  EXPECT_THAT(kinds_asked(of_kinds(hair, kinds_of_meshes).value()), ::testing::ElementsAre(Kind::edge_edge));
  EXPECT_FALSE(of_kinds(hair, std::array{Kind::vertex_triangle}));
  EXPECT_REFUSED(expect_kind(hair, Kind::vertex_triangle, "--kind"),
                 "--kind: found vt, expected ee for the family");
}

TEST(SimulationFamily, NamesAreWrittenInOneWay) {
  const SimulationOptions options{.scene = "knot@300", .stiffness = "100", .steps_per_frame = "2"};
  EXPECT_EQ(options.name(), "sim:knot@300:stiffness=100:steps-per-frame=2");
  EXPECT_EQ(parse_simulation_name(options.name()).name(), options.name());
  for (const char* bad : {"sim:knot:stiffness=20", "sim:knot:step=2ms:edge=1", "sim:knot:colour=red",
                          "sim:knot:", "sim:knot:edge=1:edge=1", "sim:knot:edge", "sim:knot::edge=1"})
    EXPECT_REFUSED(find_any_family(bad),
                   "found the simulation '" + std::string(bad) + "', expected 'sim:knot");
  EXPECT_REFUSED(find_any_family("sim:knots"), "family 'sim:knots': knots: found no scene of that name");
  EXPECT_REFUSED(find_any_family("sim:knot:edge=x"), "family 'sim:knot:edge=x': --edge: found 'x'");
  EXPECT_REFUSED(find_any_family("sim:knot:steps-per-frame=0"),
                 "--steps-per-frame: found '0', expected a whole");
}

TEST(SimulationFamily, StopsAtARequest) {
  const std::atomic<bool> requested{true};
  EXPECT_THROW(find_any_family("sim:knot", Stop(requested)), Stopped);
}

}  // namespace
}  // namespace nearmiss

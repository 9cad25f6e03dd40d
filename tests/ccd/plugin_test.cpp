// Subjects from plug-ins that keep the rules of the interface, and from plug-ins that break them.
#include "ccd/subjects/plugin.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "ccd/query/arithmetic.hpp"
#include "tests/plugins.hpp"
#include "tests/refused.hpp"
#include "tests/temporary_folder.hpp"

namespace nearmiss {
namespace {

using ::testing::HasSubstr;
using testing::plugin;

TEST(Plugin, PassesOnWhatTheDetectorSays) {
  const auto example = make_subject(plugin("example"));
  EXPECT_EQ(example->name(), "boxes");
  EXPECT_TRUE(example->decide(testing::falling_vertex(0.25, 0.25, 1, -1)).hit);
  EXPECT_FALSE(example->decide(testing::falling_vertex(0.25, 0.25, 2, 1)).hit);
  EXPECT_TRUE(std::isinf(example->distance_bound(testing::falling_edge(1, -1))));
  const auto of_kind = make_subject(plugin("bound_of_kind"));
  EXPECT_EQ(of_kind->distance_bound(testing::falling_vertex(0.25, 0.25, 1, -1)), 0.5);
  EXPECT_EQ(of_kind->distance_bound(testing::falling_edge(1, -1)), 1.5);
  const Verdict always = make_subject(plugin("always"))->decide(testing::falling_vertex(0, 0, 2, 1));
  EXPECT_EQ(always.time, 0.5);
  EXPECT_EQ(always.stage, Stage::unspecified);
  const Verdict error = make_subject(plugin("error"))->decide(Query{});
  EXPECT_EQ(error.fault, Fault::error);
  EXPECT_EQ(error.fault_code, -7);
}

TEST(Plugin, LeavesArithmeticPlain) {
  const auto subject = make_subject(plugin("hostile"));
  EXPECT_EQ(odd_arithmetic(), "");
  const Query query = testing::falling_vertex(0, 0, 2, 1);
  for (int i = 0; i < 2; ++i) {
    EXPECT_FALSE(subject->decide(query).hit);
    EXPECT_EQ(odd_arithmetic(), "");
    EXPECT_EQ(subject->distance_bound(query), 0);
    EXPECT_EQ(odd_arithmetic(), "");
  }
}

TEST(Plugin, AFileThatIsNoPluginIsRefused) {
  EXPECT_REFUSED(make_subject(plugin("version_1")), "found version 1 of the plug-in interface, expected 2");
  EXPECT_REFUSED(make_subject(plugin("no_function")), "no function nearmiss_get_subject");
  EXPECT_REFUSED(make_subject("./no/such.so"), "cannot load");
}

class PluginNames : public testing::TemporaryFolder {
 protected:
  struct Parts {
    std::string path, subject, options;
    bool operator==(const Parts&) const = default;
  };
  static Parts parts(const std::string& name) {
    EXPECT_TRUE(is_plugin(name)) << name;
    const PluginName parsed = PluginName::parse(name);
    return {parsed.path, parsed.subject, parsed.options};
  }
};

TEST_F(PluginNames, BeginWithTheShortestPartThatIsAFile) {
  const std::string path = write("a.so", "").string();
  EXPECT_EQ(parts(path), (Parts{path, "", ""}));
  EXPECT_EQ(parts(path + ":first:f=/tmp/x"), (Parts{path, "first", "f=/tmp/x"}));
  EXPECT_EQ(parts(path + ":f=a/b:g=2"), (Parts{path, "", "f=a/b:g=2"}));
  const std::string odd = write("d:1/e=2/a.so:b", "").string();
  EXPECT_EQ(parts(odd + ":first:f=/"), (Parts{odd, "first", "f=/"}));
  write("d:1/e=2/a.so", "");
  EXPECT_EQ(parts(odd), (Parts{odd.substr(0, odd.rfind(':')), "b", ""}));
}

TEST_F(PluginNames, OfNoFileEndBehindTheLastSlashBeforeAnOption) {
  EXPECT_EQ(parts("./d:1/none.so:first"), (Parts{"./d:1/none.so", "first", ""}));
  EXPECT_EQ(parts("./none.so:first:f=/tmp/x"), (Parts{"./none.so", "first", "f=/tmp/x"}));
}

TEST_F(PluginNames, HaveASlashInThePath) {
  for (const char* name : {"wang", "wang@2", "fcl:f=/tmp/x", "tight-inclusion:f=./x:g=1"})
    EXPECT_FALSE(is_plugin(name)) << name;
  EXPECT_TRUE(is_plugin("pipe:cat"));
}

/// A description of a subject, in which nearmiss finds no fault.
nearmiss_subject sound() {
  nearmiss_subject subject{};
  subject.interface_version = NEARMISS_INTERFACE;
  subject.name = "mine";
  subject.kinds = NEARMISS_EDGE_EDGE;
  subject.decide = [](void*, int, std::size_t, const double*, const double*, int*, double*) {};
  return subject;
}

TEST(DetectorName, HasNoneOfTheCharactersThatSeparateNames) {
  nearmiss_subject subject = sound();
  EXPECT_EQ(fault_of(subject), "");
  const std::string longest(255, 'n');
  for (const char* name : {"a b", "naïve", "ψ.1-(2)", longest.c_str()}) {
    subject.name = name;
    EXPECT_EQ(fault_of(subject), "") << name;
  }
  const std::string longer(256, 'n');
  for (const char* name :
       {"", "a:b", "a=b", "a/b", "a,b", "a\nb", "a\x1b", "a\x7f", "a\xff", "\xc3", longer.c_str()}) {
    subject.name = name;
    EXPECT_NE(fault_of(subject), "") << name;
  }
}

TEST(DetectorDistance, NeedsKindsAndAFunction) {
  nearmiss_subject subject = sound();
  subject.distance_kinds = NEARMISS_EDGE_EDGE;
  EXPECT_THAT(fault_of(subject),
              HasSubstr("'mine' with distance_kinds or the function distance, but not both"));
  subject.distance = [](void*, int, const double*, double*) { return 0.0; };
  EXPECT_EQ(fault_of(subject), "");
  subject.distance_kinds = 16;
  EXPECT_THAT(fault_of(subject), HasSubstr("'mine' with unknown kinds in distance_kinds"));
  subject.distance_kinds = 0;
  EXPECT_THAT(fault_of(subject), HasSubstr("but not both"));
}

TEST(DetectorDistance, IsEnoughWithoutDecisions) {
  nearmiss_subject subject = sound();
  subject.kinds = 0;
  subject.decide = nullptr;
  EXPECT_THAT(fault_of(subject), HasSubstr("'mine' without the function decide"));
  subject.distance_kinds = NEARMISS_VERTEX_EDGE;
  subject.distance = [](void*, int, const double* x, double*) { return x[8]; };
  EXPECT_EQ(fault_of(subject), "");
  const Detector detector(subject, "");
  Query query{.kind = Kind::vertex_edge};
  query.x[8] = 0.5;  // the last coordinate of x2 at t = 0
  EXPECT_EQ(detector.distance(query.kind, query.x.data()).distance, 0.5);
}

// The structure of an older version of the interface is shorter, and the memory after this structure belongs
// to something else.
TEST(DetectorDistance, IsNotReadFromAnOlderVersion) {
  nearmiss_subject subject = sound();
  subject.interface_version = 3;
  subject.distance_kinds = 12345;
  EXPECT_EQ(fault_of(subject), "");
  EXPECT_FALSE(gives_distance(Detector(subject, "").info(), Kind::edge_edge));
}

TEST(DetectorContract, HasFiniteSizes) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto fault = [](const Contract& contract) { return fault_of(contract); };
  EXPECT_EQ(fault({.grid = 0x1p-1074, .shortest = 1e-300, .longest = 1e300}), "");
  EXPECT_EQ(fault({.shortest = 3}), "");
  EXPECT_THAT(fault({.grid = infinity}), HasSubstr("a grid that is no power of two"));
  EXPECT_THAT(fault({.grid = 3}), HasSubstr("a grid that is no power of two"));
  for (const double limit : {infinity, -1.0, std::nan("")}) {
    EXPECT_THAT(fault({.longest = limit}), HasSubstr("limits of lengths")) << limit;
    EXPECT_THAT(fault({.shortest = limit}), HasSubstr("limits of lengths")) << limit;
  }
  EXPECT_EQ(fault({.apart_at_start = true, .apart_by = 1e-8}), "");
  for (const double by : {infinity, -1.0, std::nan("")})
    EXPECT_THAT(fault({.apart_at_start = true, .apart_by = by}), HasSubstr("a distance at t = 0")) << by;
  EXPECT_THAT(fault({.apart_by = 1}), HasSubstr("without apart_at_start"));
  EXPECT_THAT(fault({.shortest = 2, .longest = 1}), HasSubstr("limits of lengths"));
  nearmiss_subject subject = sound();
  subject.contract.longest = infinity;
  EXPECT_THAT(fault_of(subject), HasSubstr("'mine' with limits of lengths"));
}

TEST(Subjects, AnUnknownNameListsTheKnownOnes) {
  EXPECT_REFUSED(make_subject("wong"), "basic, basic-plain, bridson, wang");
}

}  // namespace
}  // namespace nearmiss

// Tests the comparison of exact methods: which answers it accepts, which contradictions it finds, and how a
// method is added.
#include "oracle/agreement/answers.hpp"
#include "oracle/agreement/checked.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "oracle/oracle.hpp"
#include "tests/queries.hpp"

namespace nearmiss {
namespace {

using testing::falling_vertex;
using ::testing::HasSubstr;

const Query hit = falling_vertex(0.25, 0.25, 1, -1);
const Query miss = falling_vertex(0.25, 0.25, 2, 1);

/// A method that gives this answer to every query.
Method saying(std::string_view name, Claim claim, const Answer& answer) {
  return {name, "", claim, [answer](const Query&) { return answer; }};
}

std::string disagreement(const std::vector<Method>& methods, std::optional<bool> by_filter = {}) {
  return ask_all(hit, methods).disagreement({.collision = by_filter});
}

/// Three methods that agree: there is one root, and the contact is not on the boundary.
std::vector<Method> three() {
  return {saying("first", Claim::complete, {.collision = true}),
          saying("second", Claim::complete, {.collision = true, .on_boundary = false, .odd = true}),
          saying("third", Claim::parity, {.collision = true, .on_boundary = false, .odd = true})};
}

TEST(Agreement, IsThatNothingContradicts) {
  EXPECT_EQ(disagreement(three()), "");
  EXPECT_EQ(disagreement(three(), true), "");
  EXPECT_TRUE(ask_all(hit, three()).agree());
}

TEST(Agreement, NamesWhoSaysNoAndWhoSaysYes) {
  EXPECT_EQ(disagreement(three(), false), "collision (no: filter; yes: first, second, third)");
  auto methods = three();
  methods[0] = saying("first", Claim::complete, {.collision = false});
  EXPECT_EQ(disagreement(methods, true), "collision (no: first; yes: second, third, filter)");
  methods = three();
  methods[2] = saying("third", Claim::parity, {.on_boundary = false, .odd = false});
  EXPECT_EQ(disagreement(methods), "odd (no: third; yes: second)");
  methods[2] = saying("third", Claim::parity, {.collision = true, .on_boundary = true});
  EXPECT_EQ(disagreement(methods), "boundary (no: second; yes: third)");
}

TEST(Agreement, ParityThatSeesACollisionContradictsThoseThatSeeNone) {
  const std::vector<Method> methods{saying("complete", Claim::complete, {.collision = false}),
                                    saying("parity", Claim::parity, {.collision = true})};
  EXPECT_EQ(disagreement(methods), "collision (no: complete; yes: parity)");
}

TEST(Agreement, ACompleteMethodHasToAnswer) {
  auto methods = three();
  methods[1] = saying("second", Claim::complete, {});
  EXPECT_EQ(disagreement(methods), "no answer of second");
}

TEST(Agreement, ACompleteMethodNeedNotKnowATie) {
  const auto disagreement_beside = [](const Answer& answer) {
    return disagreement({saying("first", Claim::complete, {.collision = false, .at_most = true}),
                         saying("second", Claim::complete, answer)});
  };
  EXPECT_EQ(disagreement_beside({}), "");
  EXPECT_EQ(disagreement_beside({.at_most = true}), "");
  EXPECT_EQ(disagreement_beside({.at_most = false}), "at most h (no: second; yes: first)");
  EXPECT_EQ(disagreement_beside({.collision = true, .at_most = true}), "collision (no: first; yes: second)");
}

TEST(Agreement, TheFilterContradictsATie) {
  const std::vector<Method> methods{saying("first", Claim::complete, {.collision = false, .at_most = true})};
  EXPECT_EQ(ask_all(hit, methods).disagreement({.collision = false, .at_most = false}),
            "at most h (no: filter; yes: first)");
}

// The decision wrongly claims a tie: the smallest distance is not exactly h. The test asks no method, so no
// method contradicts the decision. But a tie needs a proof, and there is none.
TEST(Agreement, AWrongDecisionIsNotProved) {
  const Query far = with_separation(miss, 0.5);  // the smallest distance of `miss` is 1
  const Query near = with_separation(miss, 2);
  const std::vector<Method> none;
  const auto without_methods = [&](const Query& query, const Decision& decision) {
    return disagreement(query, decision, Answers(none, {}));
  };
  for (const Query& query : {far, near})
    EXPECT_EQ(without_methods(query, {.stage = FilterStage::undecided, .is_tie = true}), "tie (not proved)");
}

TEST(Agreement, ATieAtTheLargestDoubleNeedsNoProofAboveIt) {
  constexpr double M = std::numeric_limits<double>::max();
  // The triangle is degenerate: it is a segment. When 2 t² = 1, the distance between the vertex and the
  // segment is exactly M, the largest double. At all other times, the distance is larger.
  const Query tie{.kind = Kind::vertex_triangle,
                  .x = {0,  -.5, M, -1, 0,  0, 1, 0, 0, -1, 0,  0,  //
                        -1, -.5, M, -1, -1, 0, 1, 1, 0, -1, -1, 0},
                  .separation = M};
  ASSERT_TRUE(decide(tie).is_tie);
  EXPECT_EQ(disagreement(tie, decide(tie), ask_all(tie)), "");
}

TEST(Agreement, ATieIsProvedUpToTheDoublesNextToIt) {
  const auto is_tie_at = [](double h) {
    return is_proved(with_separation(miss, h),
                     {.collision = false, .is_tie = true});  // the smallest distance of `miss` is 1
  };
  EXPECT_TRUE(is_tie_at(1));
  EXPECT_FALSE(is_tie_at(1 - 0x1p-52));
  EXPECT_FALSE(is_tie_at(1 + 0x1p-51));
  EXPECT_FALSE(is_tie_at(2));
}

TEST(Agreement, AnEvenNumberOfRootsIsMissedByParityAlone) {
  const auto missed = [](bool collision, const Answer& parity) {
    const std::vector<Method> methods{saying("complete", Claim::complete, {.collision = collision}),
                                      saying("parity", Claim::parity, parity)};
    return ask_all(hit, methods).missed_by_parity();
  };
  const Answer even{.on_boundary = false, .odd = false};
  EXPECT_TRUE(missed(true, even));
  EXPECT_FALSE(missed(true, {.collision = true, .on_boundary = false, .odd = true}));
  EXPECT_FALSE(missed(false, even));
  EXPECT_FALSE(missed(true, {}));  // the method `parity` gives no answer about this query
}

TEST(Agreement, OneMoreMethodThatLiesOnceIsCaught) {
  const Query lied_about = testing::falling_edge(1, -1);
  std::vector<Method> more(methods().begin(), methods().end());
  std::string others;
  for (const Method& method : more) others += (others.empty() ? "" : ", ") + std::string(method.name);
  more.push_back({"one more", "as exact, except for one query", Claim::complete, [&](const Query& query) {
                    return Answer{.collision = collides_exactly(query) != (query == lied_about)};
                  }});
  for (const Query& query : {hit, miss, testing::falling_edge(2, 1), testing::falling_edge(0, 1)})
    EXPECT_EQ(ask_all(query, more).disagreement(), "");
  const std::string caught = "collision (no: one more; yes: " + others + ")";
  EXPECT_EQ(ask_all(lied_about, more).disagreement(), caught);
  EXPECT_EQ(ask_others(lied_about, {.collision = true}, more).disagreement(), caught);
  EXPECT_EQ(ask_all(lied_about).disagreement(), "");
}

TEST(Agreement, KnownAnswersAreNotAskedForAgain) {
  auto methods = three();
  methods[0].ask = [](const Query&) -> Answer { throw "asked"; };
  EXPECT_EQ(ask_others(hit, {.collision = true}, methods).disagreement(), "");
  EXPECT_EQ(ask_others(hit, {.collision = false}, methods).disagreement(),
            "collision (no: first; yes: second, third)");
}

// --- the table -------------------------------------------------------------------------------------------

TEST(Methods, TheFirstOneIsComplete) { EXPECT_EQ(methods().front().claim, Claim::complete); }

TEST(Methods, AnswerAsTheyClaim) {
  for (const Method& method : methods()) {
    EXPECT_EQ(method.ask(hit).collision, true) << method.name;
    const auto none = method.ask(miss).collision;
    EXPECT_EQ(none, method.claim == Claim::complete ? std::optional(false) : std::nullopt) << method.name;
    EXPECT_LT(method.ask(hit).detail, 32) << method.name;
  }
}

TEST(Methods, ACertificateProvesAnswersAndTies) {
  EXPECT_EQ(proved_answer(hit).collision, true);
  EXPECT_EQ(proved_answer(hit).at_most, std::nullopt);
  EXPECT_EQ(proved_answer(miss).collision, false);
  const auto expect = [](double h, std::optional<bool> collision,
                         bool at_most) {  // the smallest distance of `miss` is 1
    const Answer answer = proved_answer(with_separation(miss, h));
    EXPECT_EQ(answer.collision, collision) << h;
    EXPECT_EQ(answer.at_most, at_most) << h;
  };
  expect(0.5, false, false);
  expect(1, std::nullopt, true);
  expect(2, true, true);
}

TEST(Methods, AParityMethodCountsRootsOffTheBoundary) {
  const Query on_boundary = falling_vertex(0.25, 0.25, 1, 0);
  for (const Method& method : methods()) {
    if (method.claim != Claim::parity) continue;
    EXPECT_EQ(method.ask(hit).odd, true) << method.name;
    EXPECT_EQ(method.ask(miss).odd, false) << method.name;
    EXPECT_EQ(method.ask(on_boundary).odd, std::nullopt) << method.name;
    EXPECT_EQ(method.ask(on_boundary).on_boundary, true) << method.name;
  }
}

TEST(Methods, TheReadmeListsThem) {
  std::ifstream file(NEARMISS_ORACLE_README);
  const std::string readme{std::istreambuf_iterator<char>(file), {}};
  std::string table = "| method | claims | how it decides |\n|---|---|---|\n";
  for (const Method& method : methods())
    table.append("| `")
        .append(method.name)
        .append("` | ")
        .append(name(method.claim))
        .append(" | ")
        .append(method.about)
        .append(" |\n");
  EXPECT_THAT(readme, HasSubstr("\n" + table + "\n"));
}

}  // namespace
}  // namespace nearmiss

// Explanations of queries whose roots and contacts are known.
#include "oracle/explanation.hpp"

#include <gtest/gtest.h>

#include "tests/queries.hpp"

namespace nearmiss {
namespace {

using testing::falling_vertex;
using testing::make_query;
using Contact = Explanation::Contact;

TEST(Explanation, TellsWhenTheContactIs) {
  EXPECT_EQ(explain(falling_vertex(0.25, 0.25, 2, 1)).contact, Contact::none);
  EXPECT_EQ(explain(falling_vertex(0.25, 0.25, 0, -1)).contact, Contact::start);
  EXPECT_EQ(explain(falling_vertex(0.25, 0.25, 0x1p-50, -1)).contact, Contact::early);
  EXPECT_EQ(explain(falling_vertex(0.25, 0.25, 0x1p-40, 0x1p-40 - 1)).contact,
            Contact::early);  // at t = 2^-40
  EXPECT_EQ(explain(falling_vertex(0.25, 0.25, 0x1.0000001p-40, 0x1p-40 - 1)).contact, Contact::inside);
  EXPECT_EQ(explain(falling_vertex(0.25, 0.25, 1, -1)).contact, Contact::inside);
  EXPECT_EQ(explain(falling_vertex(0.25, 0.25, 1, 0)).contact, Contact::end);
}

TEST(Explanation, CountsTheTimesAtWhichTheVerticesAreCoplanar) {
  EXPECT_EQ(explain(falling_vertex(0.25, 0.25, 2, 1)).roots, 0);
  EXPECT_EQ(explain(falling_vertex(0.25, 0.25, 1, -1)).roots, 1);
  EXPECT_EQ(explain(falling_vertex(4, 4, 1, -1)),
            (Explanation{.roots = 1, .contact = Contact::none, .unseen_by_parity = false}));
  EXPECT_EQ(explain(Query{}),
            (Explanation{.roots = -1, .contact = Contact::start, .unseen_by_parity = false}));
}

TEST(Explanation, SaysWhetherRootParitySeesTheContact) {
  // The plane of the triangle is z = s x, with s = 2t - 1. The vertex has x = 2t - 1 and z = 1/4. So the
  // vertex meets the plane at t = 1/4 and at t = 3/4, and is inside the triangle at both times.
  const Query twice = make_query(Kind::vertex_triangle, {{-1, 0, 0.25}, {-4, -4, 4}, {4, -4, -4}, {0, 8, 0}},
                                 {{1, 0, 0.25}, {-4, -4, -4}, {4, -4, 4}, {0, 8, 0}});
  EXPECT_EQ(explain(twice), (Explanation{.roots = 2, .contact = Contact::inside, .unseen_by_parity = true}));
  EXPECT_FALSE(explain(falling_vertex(0.25, 0.25, 1, -1)).unseen_by_parity);
}

TEST(Explanation, IsASentence) {
  EXPECT_EQ(to_text(explain(falling_vertex(0.25, 0.25, 2, 1))),
            "no contact; the vertices are never coplanar");
  EXPECT_EQ(to_text(explain(falling_vertex(0.25, 0.25, 1, 0))),
            "contact at t = 1; the vertices are coplanar once");
  EXPECT_EQ(to_text(explain(Query{})), "contact at t = 0; the vertices are always coplanar");
  EXPECT_EQ(to_text({.roots = 2, .contact = Contact::early, .unseen_by_parity = true}),
            "contact within 2^-40 after t = 0; the vertices are coplanar 2 times; root parity counts an even "
            "number "
            "of roots and cannot see the contact");
}

}  // namespace
}  // namespace nearmiss

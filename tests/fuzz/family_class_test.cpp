// Every family has the class that its queries deserve, by the criterion of fuzz/families/README.md.
#include "reports/statistics/family_class.hpp"

#include <gtest/gtest.h>

#include <array>
#include <iostream>

#include "fuzz/families/classify.hpp"
#include "tests/fuzz/family_queries.hpp"

namespace nearmiss {
namespace {

TEST(FamilyClass, IsTheLastOneToWhichATenthOfTheQueriesBelong) {
  for (const Family& family : all_families()) {
    std::array<int, 4> of_class{};
    testing::count_of_400(family.name, [&](const Query& query) {
      ++of_class[static_cast<std::size_t>(classify(query))];
      return true;
    });
    const auto [ordinary, degenerate, extreme, unclassified] = of_class;
    std::cout << family.name << ": " << extreme << " of 400 are extreme, " << degenerate << " degenerate\n";
    const QueryClass deserved = extreme >= 40      ? QueryClass::extreme
                                : degenerate >= 40 ? QueryClass::degenerate
                                                   : QueryClass::ordinary;
    EXPECT_EQ(name(class_of(family.name)), name(deserved))
        << family.name << ": " << extreme << " extreme, " << degenerate << " degenerate";
    EXPECT_EQ(unclassified, 0) << family.name;
  }
}

TEST(FamilyClass, EveryFamilyHasOne) {
  for (const Family& family : all_families())
    EXPECT_NE(class_of(family.name), QueryClass::unclassified) << family.name;
  EXPECT_EQ(class_of("mesh"), QueryClass::ordinary);
}

}  // namespace
}  // namespace nearmiss

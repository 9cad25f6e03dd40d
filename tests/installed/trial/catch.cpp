// A trial as a test of Catch2, version 2 or 3.
#if __has_include(<catch2/catch_test_macros.hpp>)
#include <catch2/catch_test_macros.hpp>
#else
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
#endif

#include <nearmiss/trial.hpp>

#include "my_ccd.hpp"

TEST_CASE("a bug is found") {
  const auto mine = nearmiss::plugin::detector("mine").vertex_triangle(user::point_triangle_ccd);
  const auto report = nearmiss::trial(mine);
  INFO(report);
  CHECK_FALSE(report.clean());
  CHECK(report.text().find("CHECK(nearmiss::ask(mine, {NEARMISS_VERTEX_TRIANGLE, x, 0}))") !=
        std::string_view::npos);
}

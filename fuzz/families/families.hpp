// Families of queries to hunt with: each query is a pure function of (family, seed, index).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ccd/query.hpp"
#include "fuzz/random.hpp"

namespace nearmiss {

/// What a sweep drives: a number x from lo to hi.
struct Parameter {
  std::string
      about;  ///< what x is, with its base where it is an exponent: "speed / size of the primitives = 10^x"
  double lo, hi;
  bool whole = false;  ///< only whole numbers
  std::function<Query(Random&, Kind, double)> make;
};

/// A way of making queries.
struct Family {
  std::string name;  ///< NAME@VALUE where the parameter has a fixed value
  std::string about;
  bool planted = false;  ///< every query is a collision, by construction
  std::function<Query(Random&, Kind)> make;
  std::optional<Parameter> parameter{};  ///< each query draws its own value, uniformly
  std::uint64_t block_cases = 100;       ///< queries in a round of a campaign; fewer where they are dear
  bool timed = true;                     ///< whether the time that answers take counts
  bool compare_all = false;              ///< every query is decided by all methods of the oracle
};

/// A family with a parameter.
Family with_parameter(std::string name, std::string about, Parameter parameter);

/// The family NAME@VALUE. Its query is the one that NAME makes where it draws VALUE, so that along a sweep
/// nothing but the parameter changes. Throws Error where there is no such parameter or value.
Family at_value(const Family& family, double value);

/// The families at so many values of the parameter, evenly from its lowest to its highest; fewer where there
/// are not so many whole numbers. Throws Error where there is no parameter.
std::vector<Family> sweep(const Family& family, int steps);

/// All families, in the order in which they are listed.
std::span<const Family> families();

/// A family by its name, NAME or NAME@VALUE. Throws Error that lists the known ones.
Family find_family(std::string_view name, std::span<const Family> known = families());

/// The kind of a family's query by its number: vertex-triangle where that is even, edge-edge where it is odd.
constexpr Kind kind_of(std::uint64_t index) { return kinds[index % kinds.size()]; }

/// Query number `index` of a family.
Query make_query(const Family& family, std::uint64_t seed, std::uint64_t index);

}  // namespace nearmiss

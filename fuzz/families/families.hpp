// Families of queries for the hunt. Each query is a pure function of (family, seed, index).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ccd/query/query.hpp"
#include "fuzz/random.hpp"

namespace nearmiss {

/// The parameter of a family: a number x from lo to hi, which a sweep varies.
struct Parameter {
  std::string about;  ///< the meaning of x, such as "speed / size of the primitives = 10^x"
  double lo, hi;
  bool whole = false;  ///< whether x must be a whole number
  std::function<Query(Random&, Kind, double)> make;
  std::string factor = "";  ///< if set, reports count queries by whole x, as FACTOR=2^x
};

/// A way of making queries.
struct Family {
  std::string name;  ///< NAME, or NAME@VALUE if the parameter has a fixed value
  std::string about;
  bool planted = false;  ///< whether every query is a collision by construction
  std::function<Query(Random&, Kind)> make;
  std::optional<Parameter> parameter{};         ///< each query draws its own value, uniformly
  std::uint64_t block_cases = 25;               ///< queries in the first round of a campaign
  bool timed = true;                            ///< whether the subjects' times count
  bool compare_all = false;                     ///< whether all methods of the oracle decide every query
  bool has_separation = false;                  ///< whether the queries have a separation h > 0
  std::array<Kind, 2> kinds = kinds_of_meshes;  ///< the kinds of queries with even and with odd indices
  std::optional<Kind> only{};                   ///< if set, campaigns ask only the queries of this kind
  /// Draws the value of each factor for a query, as texts "FACTOR=VALUE"; `make` starts with the same draws.
  /// Null if the family has no factors.
  std::function<std::vector<std::string>(Random&)> factors{};
};

/// A family with a parameter.
Family with_parameter(std::string name, std::string about, Parameter parameter);

/// The family, marked as one whose queries are all collisions by construction.
Family with_collisions(Family family);

/// The family NAME@VALUE. Each query is the one that NAME makes when it draws VALUE, so only the parameter
/// changes along a sweep. Throws Error if the family has no parameter, or if its parameter cannot have this
/// value.
Family at_value(const Family& family, double value);

/// The family at `steps` evenly spaced values of its parameter, from the lowest to the highest. If the
/// parameter is whole and has fewer values than `steps`, each value occurs once. Throws Error if the family
/// has no parameter.
std::vector<Family> sweep(const Family& family, int steps);

/// The text in place of a number that makes each query draw its own separation.
inline constexpr std::string_view drawn_separation = "drawn";

/// Returns the separation of a query. Takes random numbers only if separations are drawn.
using ChooseSeparation = std::function<double(Random&, const Query&)>;

/// Parses the separation of all queries: a positive number, or `drawn`. A drawn separation is between 1e-6
/// and 1 times the extent of the query's primitives; one in four is a power of two. Throws an Error that
/// starts with `where` for any other text.
ChooseSeparation parse_family_separation(std::string_view text, std::string_view where);

/// The family NAME~SEPARATION: the queries of NAME with a separation, which each query draws after everything
/// else if it is `drawn`. Throws Error if parse_family_separation() refuses the text, or if the family has
/// separations of its own.
Family with_separation(const Family& family, std::string_view separation);

/// All families that ask for contact, in the order of lists and campaigns; the extreme families come last.
std::span<const Family> families();

/// The families whose queries have separations of their own.
std::span<const Family> separation_families();

/// Families of vv and ve queries. Each query is a query of another family without its last vertices: those of
/// "v-uniform" come from "uniform". In such a query, contact happens only by coincidence, so campaigns give
/// these families separations.
std::span<const Family> vertex_families();

/// The family as campaigns ask it by default: families of vv and ve queries draw separations, unless they
/// have their own.
Family as_asked(const Family& family);

/// families() and separation_families(), whose queries are pairs of triangle meshes.
std::span<const Family> mesh_families();

/// Families whose primitives are at rest, for all four kinds. `nearmiss distance` asks them; campaigns do
/// not.
std::span<const Family> families_at_rest();

/// mesh_families(), vertex_families() and families_at_rest().
std::span<const Family> all_families();

/// Finds a family by its name: NAME, NAME@VALUE, or one of these with ~SEPARATION. For an unknown name,
/// throws an Error that lists the known families.
Family find_family(std::string_view name, std::span<const Family> known = all_families());

/// The kind of a family's query `index`: vertex-triangle or vertex-vertex for an even index, edge-edge or
/// vertex-edge for an odd index.
inline Kind kind_of(const Family& family, std::uint64_t index) { return family.kinds[index % 2]; }

/// Whether the family has queries of a kind.
bool has_kind(const Family& family, Kind kind);

/// Throws an Error that starts with `where` if the family has no queries of a kind.
void expect_kind(const Family& family, Kind kind, std::string_view where);

/// The kinds of the family's queries that campaigns ask: Family::only if it is set, otherwise both.
inline std::span<const Kind> kinds_asked(const Family& family) {
  return family.only ? std::span(&*family.only, 1) : std::span<const Kind>(family.kinds);
}

/// The family, changed so that campaigns ask only queries of the given kinds; nothing if it has no such
/// queries.
std::optional<Family> of_kinds(const Family& family, std::span<const Kind> some);

/// The random numbers from which query number `index` of a family is made.
Random random_of(const Family& family, std::uint64_t seed, std::uint64_t index);

/// The value of each factor of query number `index` of a family with factors.
std::vector<std::string> factors_of(const Family& family, std::uint64_t seed, std::uint64_t index);

/// Query number `index` of a family.
Query make_query(const Family& family, std::uint64_t seed, std::uint64_t index);

/// Makes many queries of a family. The family must outlive this object.
class QueryMaker {
 public:
  QueryMaker(const Family& family, std::uint64_t seed);
  /// Query number `index`.
  [[nodiscard]] Query operator()(std::uint64_t index) const {
    Random random(seed_, stream_, index);
    return family_.make(random, kind_of(family_, index));
  }

 private:
  const Family& family_;
  std::uint64_t seed_;
  std::uint64_t stream_;
};

}  // namespace nearmiss

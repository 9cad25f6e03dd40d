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
  std::string factor = "";  ///< if set, the queries of each whole x are reported by it, as FACTOR=2^x
};

/// A way of making queries.
struct Family {
  std::string name;  ///< NAME, or NAME@VALUE if the parameter has a fixed value
  std::string about;
  bool planted = false;  ///< whether every query is a collision by construction
  std::function<Query(Random&, Kind)> make;
  std::optional<Parameter> parameter{};  ///< each query draws its own value, uniformly
  std::uint64_t block_cases = 25;        ///< queries in the first round of a campaign; fewer if they are slow
  bool timed = true;                     ///< whether the subjects' times count
  bool compare_all = false;              ///< whether all methods of the oracle decide every query
  bool has_separation = false;           ///< whether the queries have a separation h > 0
  std::array<Kind, 2> kinds = kinds_of_meshes;  ///< of queries with even and with odd indices
  std::optional<Kind> only{};                   ///< if set, campaigns ask the queries of this kind alone
  /// Draws a query's value of each factor, "FACTOR=VALUE", as `make` does before anything else; null if the
  /// family has no factors.
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

/// The family at `steps` evenly spaced values of its parameter, from the lowest to the highest. If there are
/// fewer whole numbers than steps, each occurs once. Throws Error if the family has no parameter.
std::vector<Family> sweep(const Family& family, int steps);

/// The word that replaces the number if each query draws its own separation.
inline constexpr std::string_view drawn_separation = "drawn";

/// Gives a query its separation. Takes random numbers only if separations are drawn.
using ChooseSeparation = std::function<double(Random&, const Query&)>;

/// Parses the separation of all queries: a positive number, or `drawn`. A drawn separation is between 1e-6
/// and 1 times the extent of the query's primitives; one in four is a power of two. Throws an Error that
/// starts with `where` for any other text.
ChooseSeparation parse_family_separation(std::string_view text, std::string_view where);

/// The family NAME~SEPARATION: the same queries with a separation (parse_family_separation). A query draws it
/// after everything else. Throws Error for any other text, or if the family has separations of its own.
Family with_separation(const Family& family, std::string_view separation);

/// All families that ask for contact, in the order of lists and campaigns: the extreme ones come last.
std::span<const Family> families();

/// The families whose queries have separations of their own.
std::span<const Family> separation_families();

/// Families whose queries are two vertices, or a vertex and an edge: what is left of the queries of other
/// families without their last vertices. "v-uniform" is that of "uniform". Contact of two vertices, or of a
/// vertex and an edge, is a coincidence, so campaigns give these families separations.
std::span<const Family> vertex_families();

/// The family as it is asked if nobody says otherwise: families of vertices and edges draw separations,
/// unless they have their own.
Family as_asked(const Family& family);

/// families() and separation_families(), whose queries are pairs of triangle meshes.
std::span<const Family> mesh_families();

/// Families whose primitives are at rest, of pairs of meshes and of vertices and edges. Functions that give a
/// distance are asked them; campaigns are not.
std::span<const Family> families_at_rest();

/// mesh_families(), vertex_families() and families_at_rest().
std::span<const Family> all_families();

/// Finds a family by its name: NAME, NAME@VALUE, or one of these with ~SEPARATION. For an unknown name,
/// throws an Error that lists the known families.
Family find_family(std::string_view name, std::span<const Family> known = all_families());

/// The kind of a family's query by its index: vertex-triangle or vertex-vertex if it is even, edge-edge or
/// vertex-edge if it is odd.
inline Kind kind_of(const Family& family, std::uint64_t index) { return family.kinds[index % 2]; }

/// Whether queries of the family have a kind.
bool has_kind(const Family& family, Kind kind);

/// Throws an Error that starts with `where` if they do not.
void expect_kind(const Family& family, Kind kind, std::string_view where);

/// The kinds that campaigns ask: all that the family's queries have, or `only` one.
inline std::span<const Kind> kinds_asked(const Family& family) {
  return family.only ? std::span(&*family.only, 1) : std::span<const Kind>(family.kinds);
}

/// The family, of which campaigns ask some kinds alone; nothing if its queries have none of them.
std::optional<Family> of_kinds(const Family& family, std::span<const Kind> some);

/// The random numbers from which query number `index` of a family is made.
Random random_of(const Family& family, std::uint64_t seed, std::uint64_t index);

/// The value of each factor of query number `index` of a family with factors.
std::vector<std::string> factors_of(const Family& family, std::uint64_t seed, std::uint64_t index);

/// Query number `index` of a family.
Query make_query(const Family& family, std::uint64_t seed, std::uint64_t index);

/// Makes many queries of a family, which must outlive it.
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

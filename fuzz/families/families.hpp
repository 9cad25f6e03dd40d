// Families of queries. Each query is a pure function of the family, a seed and an index.
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

/// The parameter of a family: a number x from lo to hi, which sweep() varies.
struct Parameter {
  std::string about;  ///< the meaning of x, such as "speed / size of the primitives = 10^x"
  double lo, hi;
  bool whole = false;  ///< whether x must be a whole number
  std::function<Query(Random&, Kind, double)> make;
  std::string factor{};  ///< if set, reports count the queries for each whole x, under the name FACTOR=2^x
};

struct Family {
  std::string name;  ///< NAME; or NAME@VALUE, if the parameter is fixed at VALUE
  std::string about;
  bool planted = false;  ///< whether every query is a collision by construction
  std::function<Query(Random&, Kind)> make;
  std::optional<Parameter> parameter{};         ///< each query draws its own x, uniformly
  std::uint64_t block_cases = 25;               ///< queries in the first round of a campaign
  bool timed = true;                            ///< whether trials measure the subjects' run times
  bool compare_all = false;                     ///< whether every method of the oracle decides each query
  bool has_separation = false;                  ///< whether the queries have a separation h > 0
  std::array<Kind, 2> kinds = kinds_of_meshes;  ///< the kind of queries with even indices, then with odd ones
  std::optional<Kind> only{};                   ///< if set, campaigns ask only the queries of this kind

  /// Draws the values of a query's factors (properties that vary from query to query), and returns them as
  /// texts "FACTOR=VALUE". `make` starts by drawing the same values. This function is null if the family has
  /// no factors.
  std::function<std::vector<std::string>(Random&)> factors{};
};

Family with_parameter(std::string name, std::string about, Parameter parameter);

Family with_collisions(Family family);

/// The family NAME@VALUE. Each of its queries is the query that the family NAME would make if NAME drew VALUE
/// as the parameter. So two queries with the same seed and index, but different VALUEs, differ only by the
/// parameter. Throws Error if the family has no parameter, or if the parameter cannot have this value.
Family at_value(const Family& family, double value);

/// The families NAME@VALUE for `steps` evenly spaced values of the family's parameter, from the lowest to the
/// highest. If x must be a whole number and has fewer than `steps` possible values, each value occurs once.
/// Throws Error if the family has no parameter.
std::vector<Family> sweep(const Family& family, int steps);

/// The text that a user gives in place of a separation, so that each query draws its own separation.
inline constexpr std::string_view drawn_separation = "drawn";

/// A function that returns the separation of a query. It draws random numbers only if each query is to have a
/// random separation.
using ChooseSeparation = std::function<double(Random&, const Query&)>;

/// Parses the separation of all queries: a positive number, or `drawn`. A drawn separation is between 1e-6
/// and 1 times extent(query); one in four is then rounded down to a power of two. Throws an Error that starts
/// with `where` for any other text.
ChooseSeparation parse_family_separation(std::string_view text, std::string_view where);

/// The family NAME~SEPARATION: the queries of NAME, with this separation. If the separation is `drawn`, the
/// separation of each query is drawn after all other numbers of the query. Throws Error if
/// parse_family_separation() refuses the text, or if the family has separations of its own.
Family with_separation(const Family& family, std::string_view separation);

/// The families of vertex-triangle and edge-edge queries that ask whether the primitives touch. They are in
/// the order in which lists and campaigns show them; the families of extreme queries come last.
std::span<const Family> families();

/// The families of vertex-triangle and edge-edge queries that have separations of their own.
std::span<const Family> separation_families();

/// The families of vertex-vertex and vertex-edge queries. Most of these families take the queries of another
/// family, and leave out the last vertices of each query: "v-uniform" takes its queries from "uniform". Two
/// vertices, or a vertex and an edge, touch only by coincidence, so campaigns give the queries separations.
std::span<const Family> vertex_families();

/// The family in the form that campaigns use by default. A family of vertex-vertex and vertex-edge queries
/// without separations of its own gets drawn separations; any other family stays as it is.
Family as_asked(const Family& family);

/// families() and separation_families(): all families of vertex-triangle and edge-edge queries.
std::span<const Family> mesh_families();

/// Families of queries of all four kinds, in which the primitives are at rest. `nearmiss distance` uses them;
/// campaigns do not.
std::span<const Family> families_at_rest();

/// All families: mesh_families(), vertex_families() and families_at_rest().
std::span<const Family> all_families();

/// Finds a family by its name: NAME, NAME@VALUE, NAME~SEPARATION or NAME@VALUE~SEPARATION. For an unknown
/// NAME, throws an Error that lists the known families.
Family find_family(std::string_view name, std::span<const Family> known = all_families());

/// The kind of a family's query `index`. Queries with even indices are vertex-triangle (in a family of
/// vertices, vertex-vertex), and queries with odd indices are edge-edge (in a family of vertices,
/// vertex-edge).
inline Kind kind_of(const Family& family, std::uint64_t index) { return family.kinds[index % 2]; }

bool has_kind(const Family& family, Kind kind);

/// Throws an Error that starts with `where` if the family has no queries of this kind.
void expect_kind(const Family& family, Kind kind, std::string_view where);

/// The kinds of queries that campaigns ask: Family::only if it is set, otherwise both kinds of the family.
inline std::span<const Kind> kinds_asked(const Family& family) {
  return family.only ? std::span(&*family.only, 1) : std::span<const Kind>(family.kinds);
}

/// The family, changed so that campaigns ask only its queries of the given kinds. Returns nothing if the
/// family has no such queries.
std::optional<Family> of_kinds(const Family& family, std::span<const Kind> some);

/// The stream of random numbers from which query number `index` of a family is made.
Random random_of(const Family& family, std::uint64_t seed, std::uint64_t index);

/// The value of each factor of query number `index`, for a family with factors (Family::factors).
std::vector<std::string> factors_of(const Family& family, std::uint64_t seed, std::uint64_t index);

Query make_query(const Family& family, std::uint64_t seed, std::uint64_t index);

/// Makes many queries of a family. The family must outlive this object.
class QueryMaker {
 public:
  QueryMaker(const Family& family, std::uint64_t seed);
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

// The factors of the family `crossed`: properties that vary from query to query. Each query draws a value of
// every factor, independently of the other values.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/families/families.hpp"

namespace nearmiss::crossed {

struct Factor {
  std::string_view name;
  std::span<const std::string_view> values;
};

// The values of the first five factors, each in the order of Factor::values. README.md explains the values.
enum class Shape : std::uint8_t { ordinary, sliver, needle, tiny, parallel, zero_edge, point };
enum class Motion : std::uint8_t { translation, rotation, collapse, deforming, fast, slow, along, rest };
enum class When : std::uint8_t { at_0, after_0, inside, before_1, at_1, outside };
enum class Where : std::uint8_t { inside, edge, vertex, outside };
enum class Roots : std::uint8_t { one, two, three, double_root, triple, all };

inline constexpr std::size_t factor_count = 7;

/// The levels of a query. A query has one level for each factor: the index of the query's value in
/// Factor::values. The order of the factors is shape, motion, when, where, roots, scale, offset.
struct Levels : std::array<std::uint8_t, factor_count> {
  [[nodiscard]] Shape shape() const { return static_cast<Shape>((*this)[0]); }
  [[nodiscard]] Motion motion() const { return static_cast<Motion>((*this)[1]); }
  [[nodiscard]] When when() const { return static_cast<When>((*this)[2]); }
  [[nodiscard]] Where where() const { return static_cast<Where>((*this)[3]); }
  [[nodiscard]] Roots roots() const { return static_cast<Roots>((*this)[4]); }
  [[nodiscard]] int scale() const { return (*this)[5]; }
  [[nodiscard]] std::size_t offset() const { return (*this)[6]; }
};

/// All factors, in the order of the levels in Levels.
std::span<const Factor> factors();

bool is_made(const Levels& levels);

/// Draws every level independently. If the family makes no query with the drawn levels, draws all of them
/// again.
Levels draw_levels(Random& random);

/// The levels of query `index` of the family, without making the query.
Levels levels_of(std::uint64_t seed, std::uint64_t index);

/// "shape=sliver", "motion=rest" and so on, in the order of the factors.
std::vector<std::string> to_texts(const Levels& levels);

Query make_query(Random& random, Kind kind, const Levels& levels);

/// Counts the combinations of values of two factors, or of three factors. `made` is the number of
/// combinations that occur in any queries of the family. `seen` is the number of those that occur in the
/// queries that coverage() looks at.
struct Combinations {
  std::uint64_t made = 0;
  std::uint64_t seen = 0;
  std::vector<std::string> missing;  ///< made, but not seen: for example, "shape=sliver when=at-1"
};

/// The combinations of values that occur in the queries that coverage() looks at.
struct Coverage {
  Combinations pairs, triples;
  std::vector<std::string> pairs_not_made;
};

Coverage coverage(std::uint64_t seed, std::uint64_t first, std::uint64_t count);

}  // namespace nearmiss::crossed

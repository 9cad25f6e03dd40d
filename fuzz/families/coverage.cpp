// Which combinations of the factors' values occur in the family `crossed`.
#include <fmt/format.h>

#include "fuzz/families/crossed.hpp"

namespace nearmiss::crossed {

namespace {

/// All values of all factors, numbered one after the other.
struct Numbering {
  std::array<std::size_t, factor_count> first{};  ///< the number of each factor's first value
  std::vector<std::size_t> factor;                ///< the factor to which the value with each number belongs
  std::vector<std::string> name;

  Numbering() {
    for (std::size_t f = 0; f < factor_count; ++f) {
      first[f] = name.size();
      for (const std::string_view value : factors()[f].values) {
        factor.push_back(f);
        name.push_back(fmt::format("{}={}", factors()[f].name, value));
      }
    }
  }
};

/// A flag for each pair and each triple of values: whether these values occur together. The place of the flag
/// follows from the numbers of the values.
struct Occurrences {
  std::size_t size;  ///< number of values
  std::vector<bool> pairs, triples;

  explicit Occurrences(const Numbering& numbering)
      : size(numbering.name.size()), pairs(size * size), triples(size * size * size) {}

  void add(const Numbering& numbering, const Levels& levels) {
    std::array<std::size_t, factor_count> number{};
    for (std::size_t f = 0; f < factor_count; ++f) number[f] = numbering.first[f] + levels[f];
    for (std::size_t i = 0; i < factor_count; ++i)
      for (std::size_t j = i + 1; j < factor_count; ++j) {
        const std::size_t pair = number[i] * size + number[j];
        pairs[pair] = true;
        for (std::size_t k = j + 1; k < factor_count; ++k) triples[pair * size + number[k]] = true;
      }
  }
};

/// The text of the combination whose flag is at `place`; `values` is 2 for a pair, and 3 for a triple.
std::string text_of(const Numbering& numbering, std::size_t place, int values) {
  const std::size_t size = numbering.name.size();
  const std::string& last = numbering.name[place % size];
  return values == 1 ? last : fmt::format("{} {}", text_of(numbering, place / size, values - 1), last);
}

/// Counts the combinations that the family makes (`made`), and those of them that occur in the given queries
/// (`seen`). Lists the other combinations that the family makes as missing.
Combinations compared(const Numbering& numbering, const std::vector<bool>& seen,
                      const std::vector<bool>& made, int values) {
  Combinations result;
  for (std::size_t place = 0; place < made.size(); ++place) {
    if (!made[place]) continue;
    ++result.made;
    if (seen[place])
      ++result.seen;
    else
      result.missing.push_back(text_of(numbering, place, values));
  }
  return result;
}

/// The pairs and triples of values that occur together in queries of the family.
Occurrences occurrences_made(const Numbering& numbering) {
  Occurrences made(numbering);
  std::size_t all = 1;
  for (const Factor& factor : factors()) all *= factor.values.size();
  for (std::size_t number = 0; number < all; ++number) {
    Levels levels;
    std::size_t rest = number;
    for (std::size_t f = 0; f < factor_count; ++f) {
      levels[f] = static_cast<std::uint8_t>(rest % factors()[f].values.size());
      rest /= factors()[f].values.size();
    }
    if (is_made(levels)) made.add(numbering, levels);
  }
  return made;
}

}  // namespace

Coverage coverage(std::uint64_t seed, std::uint64_t first, std::uint64_t count) {
  const Numbering numbering;
  const Occurrences made = occurrences_made(numbering);
  Occurrences seen(numbering);
  for (std::uint64_t i = 0; i < count; ++i) seen.add(numbering, levels_of(seed, first + i));
  Coverage result{
      compared(numbering, seen.pairs, made.pairs, 2), compared(numbering, seen.triples, made.triples, 3), {}};
  for (std::size_t i = 0; i < made.size; ++i)
    for (std::size_t j = i + 1; j < made.size; ++j)
      if (const std::size_t pair = i * made.size + j;
          numbering.factor[i] != numbering.factor[j] && !made.pairs[pair])
        result.pairs_not_made.push_back(text_of(numbering, pair, 2));
  return result;
}

}  // namespace nearmiss::crossed

#include "fuzz/families/coverage.hpp"

#include <fmt/format.h>

#include "fuzz/families/crossed.hpp"

namespace nearmiss::crossed {

namespace {

/// All values of all factors, numbered one after the other.
struct Numbering {
  std::array<std::size_t, factor_count> first{};  ///< the number of each factor's first value
  std::vector<std::size_t> factor;                ///< the factor of each number
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

/// The pairs and triples of values that occur together.
class Occurrences {
 public:
  explicit Occurrences(const Numbering& numbering)
      : numbering_(numbering),
        size_(numbering.name.size()),
        pairs_(size_ * size_),
        triples_(size_ * size_ * size_) {}

  void add(const Levels& levels) {
    std::array<std::size_t, factor_count> number{};
    for (std::size_t f = 0; f < factor_count; ++f) number[f] = numbering_.first[f] + levels[f];
    for (std::size_t i = 0; i < factor_count; ++i)
      for (std::size_t j = i + 1; j < factor_count; ++j) {
        const std::size_t pair = number[i] * size_ + number[j];
        pairs_[pair] = 1;
        for (std::size_t k = j + 1; k < factor_count; ++k) triples_[pair * size_ + number[k]] = 1;
      }
  }

  /// Calls use(text, whether it occurs) for each pair of values of different factors.
  template <class Use>
  void for_each_pair(const Use& use) const {
    for (std::size_t i = 0; i < size_; ++i)
      for (std::size_t j = i + 1; j < size_; ++j)
        if (numbering_.factor[i] != numbering_.factor[j])
          use(fmt::format("{} {}", numbering_.name[i], numbering_.name[j]), pairs_[i * size_ + j] != 0);
  }

  /// Says which of the pairs in `made`, those that the family makes, also occur here.
  [[nodiscard]] Combinations pairs_among(const Occurrences& made) const {
    return compared(pairs_, made.pairs_, 2);
  }
  [[nodiscard]] Combinations triples_among(const Occurrences& made) const {
    return compared(triples_, made.triples_, 3);
  }

 private:
  using Flags = std::vector<std::uint8_t>;

  [[nodiscard]] Combinations compared(const Flags& seen, const Flags& made, int values) const {
    Combinations result;
    for (std::size_t place = 0; place < made.size(); ++place) {
      if (made[place] == 0) continue;
      ++result.made;
      if (seen[place] != 0)
        ++result.seen;
      else
        result.missing.push_back(text(place, values));
    }
    return result;
  }

  [[nodiscard]] std::string text(std::size_t place, int values) const {
    const std::string& last = numbering_.name[place % size_];
    return values == 1 ? last : fmt::format("{} {}", text(place / size_, values - 1), last);
  }

  const Numbering& numbering_;
  std::size_t size_;
  Flags pairs_, triples_;
};

/// All levels that the family makes.
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
    if (is_made(levels)) made.add(levels);
  }
  return made;
}

}  // namespace

Coverage coverage(std::uint64_t seed, std::uint64_t first, std::uint64_t count) {
  const Numbering numbering;
  const Occurrences made = occurrences_made(numbering);
  Occurrences seen(numbering);
  for (std::uint64_t i = 0; i < count; ++i) seen.add(levels_of(seed, first + i));
  Coverage result{seen.pairs_among(made), seen.triples_among(made), {}};
  made.for_each_pair([&](const std::string& text, bool occurs) {
    if (!occurs) result.pairs_not_made.push_back(text);
  });
  return result;
}

}  // namespace nearmiss::crossed

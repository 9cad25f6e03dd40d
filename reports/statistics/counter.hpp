// Declarations of counters. A declaration says everything about a counter: its name, its member, and where
// files show it. The code for merging (merge_counters), for the store (store/values.hpp), for report.json
// (sections/measures.hpp) and for statistics.csv (csv.hpp) goes through these declarations.
// sections/measures.hpp declares the numbers that reports compute from counters.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <utility>

#include "ccd/query/error.hpp"

namespace nearmiss {

/// The declaration of a counter, or of another member that is merged as counters are, such as a histogram or
/// a list of cases.
template <class Owner, class Member>
struct Counter {
  std::string_view name;  ///< the counter's key in the store, and its column in statistics.csv
  Member Owner::*member;
  std::string_view json_key = name;
  /// Key of the object in report.json that contains the counter. If empty, the owner's object contains the
  /// counter.
  std::string_view json_object{};
};
template <class Owner, class Member, class... More>
Counter(std::string_view, Member Owner::*, More...) -> Counter<Owner, Member>;

/// The declaration of an array of counts, with a name for each entry.
template <class Owner, std::size_t size>
struct NamedCounts {
  std::string_view name;  ///< key in the store
  std::array<std::uint64_t, size> Owner::*member;
  std::array<std::string_view, size> names;
  std::string_view
      json_key;  ///< key of an object with an entry for each name; "" if the entries are in the object of
                 ///< the owner
  std::string_view csv_prefix{};  ///< start of the names of the columns PREFIX_NAME in statistics.csv; only
                                  ///< for members of Counts
  std::size_t first = 0;          ///< index of the first entry that is counted and shown
  bool shows_zeros = false;       ///< whether report.json shows entries that are 0
};

/// Calls `use` with each declaration of `Owner`, in the order in which files show them.
template <class Owner, class Use>
constexpr void for_each_counter(const Use& use) {
  std::apply([&](const auto&... counters) { (use(counters), ...); }, Owner::counters());
}

/// Whether every member of `Owner` is a declared counter. Compares sizes, so `Owner` must have no padding.
template <class Owner>
constexpr bool declares_all_members() {
  std::size_t declared = 0;
  for_each_counter<Owner>(
      [&](const auto& counter) { declared += sizeof(std::declval<Owner&>().*counter.member); });
  return declared == sizeof(Owner);
}

/// The largest sum of counts that is accepted. As a sum of nanoseconds, it is 36 years. A few sums of this
/// size can be added without overflow.
inline constexpr std::uint64_t largest_count = std::uint64_t{1} << 60U;

/// Throws Error if the sum is greater than largest_count.
inline void add_up(std::uint64_t& own, std::uint64_t other) {
  if (other > largest_count - std::min(own, largest_count))
    throw Error("found counts that add up to more than 2^60, expected fewer queries");
  own += other;
}

template <std::size_t size>
void add_up(std::array<std::uint64_t, size>& own, const std::array<std::uint64_t, size>& other) {
  for (std::size_t i = 0; i < size; ++i) add_up(own[i], other[i]);
}

template <class Merges>
requires requires(Merges& own, const Merges& other) { own.merge(other); }
void add_up(Merges& own, const Merges& other) { own.merge(other); }

/// Adds each counter of `other` to the same counter of `own`. Numbers are summed; every other type has its
/// own add_up or merge.
template <class Owner>
void merge_counters(Owner& own, const Owner& other) {
  for_each_counter<Owner>([&](const auto& counter) { add_up(own.*counter.member, other.*counter.member); });
}

}  // namespace nearmiss

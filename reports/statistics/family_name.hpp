// Names of families.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace nearmiss {

/// Prefixes of the families of directed searches. The prefix is followed by the name of the search's subject
/// and, if the queries have a separation, by ~SEPARATION.
inline constexpr std::string_view miss_search_family = "search-miss-";
inline constexpr std::string_view far_search_family = "search-far-";
inline constexpr std::string_view late_search_family = "search-late-";
inline constexpr std::string_view early_search_family = "search-early-";

/// Prefix of the families whose queries are two vertices, or a vertex and an edge.
inline constexpr std::string_view vertices_prefix = "v-";

/// The parts of a family's name: NAME, or NAME@VALUE with a fixed parameter; ~SEPARATION may follow either.
/// No other code takes the names of families apart. The parts point into the text of the name, so this text
/// must outlive them.
struct FamilyName {
  std::string_view base;  ///< NAME; for a directed search, NAME includes the name of the search's subject
  std::string_view root;  ///< NAME without "v-"
  std::optional<std::string_view> value;
  std::optional<std::string_view> separation;
  std::string_view search;  ///< "search-miss", "v-search-miss" and so on for a directed search; else ""

  explicit FamilyName(std::string_view name);

  [[nodiscard]] std::string text() const;
};

/// Appends a separation to a name that has none: NAME~SEPARATION.
std::string name_with_separation(std::string_view name, std::string_view separation);

}  // namespace nearmiss

// Classes of families: how near their queries are to those of a simulation.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <tuple>

#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// How near a family's queries are to those of a simulation. fuzz/families/README.md has the criterion.
enum class FamilyClass : std::uint8_t {
  ordinary,     ///< what a simulation meets in every step
  degenerate,   ///< what it meets now and then
  extreme,      ///< what no simulation should send
  unclassified  ///< cases, directed searches, and families that this program does not know
};

/// Names in files and reports, in order.
inline constexpr std::array<std::string_view, 4> class_names{"ordinary", "degenerate", "extreme",
                                                             "unclassified"};

constexpr std::string_view name(FamilyClass of) { return class_names[static_cast<std::size_t>(of)]; }

/// The class of a family by its name, NAME or NAME@VALUE. Scenes are ordinary.
FamilyClass class_of(std::string_view family);

/// Identifies the counters of a subject and kind over the families of a class.
struct ClassKey {
  std::string subject;
  Kind kind{};
  FamilyClass of{};

  bool operator<(const ClassKey& other) const {
    return std::tie(subject, kind, of) < std::tie(other.subject, other.kind, other.of);
  }
};

/// Sums over the families of each class. A class without queries is left out.
std::map<ClassKey, CountsSum> by_class(const Statistics& statistics);

}  // namespace nearmiss

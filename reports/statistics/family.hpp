// Facts about families that reports need: which families are random samples, how near their queries are to
// the queries of a simulation, and which families a report shows as one.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "reports/statistics/family_name.hpp"
#include "reports/statistics/query_class.hpp"
#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// Whether a family's queries are drawn at random. The queries of cases and scenes are not drawn at random.
bool is_random(std::string_view family);

/// The family under which a report shows a family's queries. A directed search has a family for each subject;
/// all searches of one sort are shown as one family: "search-miss", "search-far~drawn" and so on. Other
/// families keep their names.
std::string shown_family(std::string_view family);

/// The origin of a family's queries: "directed search" for the family of a directed search, otherwise the
/// family itself.
std::string_view origin(std::string_view family);

/// A name for the random draws of a family. The steps (NAME@VALUE) of a sweep make the same draws and differ
/// only in the value of the parameter, so all steps get one name. A family that is not a step of a sweep gets
/// its own name.
std::string draws_of(std::string_view family);

/// The largest number of a subject's queries that share one random draw, which is the number of steps of the
/// longest sweep.
std::uint64_t most_repeats(const Statistics& statistics, std::string_view subject);

/// The same statistics, in which shown_family replaces each family's name: the counters of families that a
/// report shows as one family are added up.
Statistics by_shown_family(const Statistics& statistics);

/// The name of the scene to which a step belongs: "scene:NAME" for the step "scene:NAME#STEP".
std::string scene_of(const std::string& step);

/// The class of a family by its name, NAME or NAME@VALUE. Scenes, and simulations with the usual options, are
/// ordinary; other simulations are unclassified.
QueryClass class_of(std::string_view family);

/// Identifies a sum of counters: those of one subject and kind, over all families of one class.
struct ClassKey {
  std::string subject;
  Kind kind{};
  QueryClass of{};

  auto operator<=>(const ClassKey&) const = default;
};

/// Sums over the families of each class. The map has no entry for a class without queries.
std::map<ClassKey, CountsSum> by_class(const Statistics& statistics);

}  // namespace nearmiss

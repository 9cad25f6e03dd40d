// Classes of families: how near their queries are to those of a simulation.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <tuple>

#include "reports/statistics/query_class.hpp"
#include "reports/statistics/statistics.hpp"

namespace nearmiss {

/// The class of a family by its name, NAME or NAME@VALUE. Scenes are ordinary. So are simulations with the
/// usual options; other simulations are unclassified.
QueryClass class_of(std::string_view family);

/// Identifies the counters of a subject and kind over the families of a class.
struct ClassKey {
  std::string subject;
  Kind kind{};
  QueryClass of{};

  bool operator<(const ClassKey& other) const {
    return std::tie(subject, kind, of) < std::tie(other.subject, other.kind, other.of);
  }
};

/// Sums over the families of each class. A class without queries is left out.
std::map<ClassKey, CountsSum> by_class(const Statistics& statistics);

}  // namespace nearmiss

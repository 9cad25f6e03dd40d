// Random queries for tests, and the command that asks the oracle about one of them again.
#pragma once

#include <sstream>
#include <string>

#include "ccd/query/query.hpp"
#include "fuzz/random.hpp"

namespace nearmiss::testing {

/// The number of a random case, and a command that decides its query: "case 7: echo '0x1p+0 ...' | nearmiss
/// oracle --kind vt -".
inline std::string repeat(std::size_t index, const Query& query) {
  std::ostringstream line;
  line << "case " << index << ": echo '" << std::hexfloat;
  for (const double c : query.x) line << c << ' ';
  if (query.separation != 0) line << query.separation << ' ';
  line << "' | nearmiss oracle --kind " << short_name(query.kind) << " -";
  return line.str();
}

/// The kind of the random case with this number: vt and ee alternate.
inline Kind kind_of_case(std::size_t index) { return kinds_of_meshes[index % kinds_of_meshes.size()]; }

inline Query integer_query(Random& random, Kind kind, int largest) {
  Query query{.kind = kind};
  for (double& c : query.x) c = random.integer(-largest, largest);
  return query;
}

inline Query uniform_query(Random& random, Kind kind) {
  Query query{.kind = kind};
  for (double& c : query.x) c = random.uniform(-1, 1);
  return query;
}

}  // namespace nearmiss::testing

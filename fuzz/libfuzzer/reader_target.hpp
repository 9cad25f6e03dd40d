// Common parts of the libFuzzer targets for readers. A reader must accept a file or throw Error. Cases,
// queries and campaigns that a reader accepts must stay the same when they are written and read again.
#pragma once

#include <iosfwd>

#include "corpus/case.hpp"
#include "fuzz/meshes/mesh.hpp"

namespace nearmiss::libfuzzer {

/// Passes a whole file to the reader that the target tests. Each target's file defines this function.
void read(std::istream& in);

/// Aborts with a line on stderr if the condition does not hold.
void expect(bool condition, const char* what);

/// Checks that a case is the same to the last bit after it is written as text and read again.
void expect_round_trip(const Case& each);

/// Checks that a mesh has at least one point, finite coordinates, and no primitive with a point that does not
/// exist.
void expect_sound(const Mesh& mesh);

}  // namespace nearmiss::libfuzzer

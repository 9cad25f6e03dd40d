// What the libFuzzer targets on readers share: whatever a file holds, a reader takes it or throws Error, and
// what it took can be written and read again.
#pragma once

#include <iosfwd>

#include "corpus/case.hpp"
#include "fuzz/meshes/mesh.hpp"

namespace nearmiss::libfuzzer {

/// Reads all that a file holds: each target has its own.
void read(std::istream& in);

/// Aborts with this line where the condition does not hold.
void expect(bool condition, const char* what);

/// A case as text must be read as the same case, to the last bit.
void expect_round_trip(const Case& each);

/// A mesh must have a point, finite coordinates, and primitives of points that exist.
void expect_sound(const Mesh& mesh);

}  // namespace nearmiss::libfuzzer

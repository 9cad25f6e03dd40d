// Common parts of the libFuzzer targets on readers. A reader must accept any file or throw Error; what it accepted must
// survive writing and reading.
#pragma once

#include <iosfwd>

#include "corpus/case.hpp"
#include "fuzz/meshes/mesh.hpp"

namespace nearmiss::libfuzzer {

/// Reads a whole file; each target defines it.
void read(std::istream& in);

/// Aborts with a line on stderr if the condition does not hold.
void expect(bool condition, const char* what);

/// Checks that a case, written as text and read again, is the same to the last bit.
void expect_round_trip(const Case& each);

/// Checks that a mesh has a point, finite coordinates, and primitives of existing points.
void expect_sound(const Mesh& mesh);

}  // namespace nearmiss::libfuzzer

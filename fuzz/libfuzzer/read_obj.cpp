// libFuzzer target: the reader of OBJ files.
#include "fuzz/libfuzzer/reader_target.hpp"
#include "fuzz/meshes/formats.hpp"

void nearmiss::libfuzzer::read(std::istream& in) { expect_sound(parse_obj(in, "input.obj")); }

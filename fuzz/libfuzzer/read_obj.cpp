// libFuzzer target: the reader of OBJ files.
#include "fuzz/libfuzzer/reader_target.hpp"
#include "fuzz/meshes/formats.hpp"
#include "fuzz/meshes/lines.hpp"

void nearmiss::libfuzzer::read(std::istream& in) {
  expect_sound(parse_obj(read_all(in, "input.obj"), "input.obj"));
}

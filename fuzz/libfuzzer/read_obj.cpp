// libFuzzer target: the reader of OBJ files.
#include "corpus/file.hpp"
#include "fuzz/libfuzzer/reader_target.hpp"
#include "fuzz/meshes/formats.hpp"

void nearmiss::libfuzzer::read(std::istream& in) {
  expect_sound(parse_obj(read_all(in, "input.obj"), "input.obj"));
}

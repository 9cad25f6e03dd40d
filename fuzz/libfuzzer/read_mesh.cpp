// libFuzzer target: the readers of OFF, PLY and STL files. Every reader gets every file.
#include <istream>

#include "ccd/error.hpp"
#include "fuzz/libfuzzer/reader_target.hpp"
#include "fuzz/meshes/formats.hpp"

void nearmiss::libfuzzer::read(std::istream& in) {
  for (const auto parse : {parse_off, parse_ply, parse_stl}) {
    in.clear();
    in.seekg(0);
    try {
      expect_sound(parse(in, "input"));
    } catch (const Error&) {  // refused
    }
  }
}

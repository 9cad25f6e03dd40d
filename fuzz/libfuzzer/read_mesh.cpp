// libFuzzer target: the readers of OFF, PLY and STL files. Each input is passed to all three readers.
#include "ccd/query/error.hpp"
#include "corpus/file.hpp"
#include "fuzz/libfuzzer/reader_target.hpp"
#include "fuzz/meshes/formats.hpp"

void nearmiss::libfuzzer::read(std::istream& in) {
  const std::string text = read_all(in, "input");
  for (const auto parse : {parse_off, parse_ply, parse_stl}) {
    try {
      expect_sound(parse(text, "input"));
    } catch (const Error&) {  // refused
    }
  }
}

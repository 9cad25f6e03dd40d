#include "fuzz/meshes/formats.hpp"

#include <fmt/format.h>

#include <map>

#include "ccd/query/error.hpp"
#include "corpus/file.hpp"
#include "fuzz/meshes/lines.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;

using Reader = Mesh (*)(std::string_view, const std::string&);

const std::map<std::string, Reader>& readers() {
  static const std::map<std::string, Reader> by_ending{
      {".obj", parse_obj}, {".off", parse_off}, {".ply", parse_ply}, {".stl", parse_stl}};
  return by_ending;
}

}  // namespace

std::string mesh_ending(const fs::path& file) {
  std::string ending = lower_case(file.extension().string());
  return readers().contains(ending) ? ending : "";
}

Mesh read_mesh(const fs::path& file) {
  const auto reader = readers().find(mesh_ending(file));
  if (reader == readers().end())
    throw Error(fmt::format("{}: found the ending '{}', expected .obj, .off, .ply or .stl", file.string(),
                            file.extension().string()));
  return reader->second(read_whole_file(file), file.string());
}

}  // namespace nearmiss

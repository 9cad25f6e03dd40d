#include "tests/temporary_folder.hpp"

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace nearmiss::testing {

TemporaryFolder::TemporaryFolder() {
  std::string path = (std::filesystem::temp_directory_path() / "nearmiss-XXXXXX").string();
  folder_ = mkdtemp(path.data());
}

TemporaryFolder::~TemporaryFolder() { std::filesystem::remove_all(folder_); }

std::filesystem::path TemporaryFolder::file(const std::string& name) const { return folder_ / name; }

std::filesystem::path TemporaryFolder::write(const std::string& name, const std::string& text) const {
  std::filesystem::create_directories(file(name).parent_path());
  std::ofstream(file(name), std::ios::binary) << text;
  return file(name);
}

std::string TemporaryFolder::read(const std::string& name) const {
  std::ostringstream text;
  text << std::ifstream(file(name), std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace nearmiss::testing

#include "fuzz/subjects/isolation/plugin_code.hpp"

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <sstream>
#include <utility>

#include "ccd/subjects/plugin.hpp"
#include "reports/sha256.hpp"
#include "reports/text/shell.hpp"

namespace nearmiss::isolation {

namespace {

namespace fs = std::filesystem;

/// The file that a shell runs for a command without '/'; "" if there is none.
std::string file_of_command(const std::string& command) {
  const char* const folders = std::getenv("PATH");
  std::istringstream each(folders == nullptr ? "" : folders);
  for (std::string folder; std::getline(each, folder, ':');)
    if (std::string path = fs::path(folder) / command; is_file(path)) return path;
  return "";
}

std::vector<std::string> files_of_program(const std::string& command) {
  std::vector<std::string> files = shell_words(command);
  if (files.empty())
    throw Error(std::string(program_prefix) + " found no command, expected one behind the colon");
  if (files.front().find('/') == std::string::npos) files.front() = file_of_command(files.front());
  std::erase_if(files, std::not_fn(is_file));
  return files;
}

}  // namespace

PluginCode::PluginCode(std::string name) : name_(std::move(name)) {
  if (!is_program(name_)) {
    files_.push_back(std::make_unique<PluginFile>(PluginName::parse(name_).path));
    sha256_ = files_.front()->sha256();
    build_id_ = files_.front()->build_id();
    return;
  }
  std::string digests;
  for (const std::string& file : files_of_program(name_.substr(program_prefix.size()))) {
    files_.push_back(std::make_unique<PluginFile>(file));
    digests += files_.back()->sha256() + "\n";
  }
  sha256_ = sha256_hex(digests);
}

void PluginCode::expect_unchanged() const {
  for (const auto& file : files_) file->expect_unchanged();
}

}  // namespace nearmiss::isolation

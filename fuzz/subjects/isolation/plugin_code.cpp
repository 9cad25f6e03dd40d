#include "fuzz/subjects/isolation/plugin_code.hpp"

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <utility>

#include "ccd/subjects/plugin.hpp"
#include "reports/sha256.hpp"
#include "reports/text/shell.hpp"

namespace nearmiss::isolation {

namespace {

namespace fs = std::filesystem;

/// The file that a shell runs for a command without '/'; "" if the shell finds no such file.
std::string file_of_command(const std::string& command) {
  const char* const folders = std::getenv("PATH");
  std::istringstream each(folders == nullptr ? "" : folders);
  for (std::string folder; std::getline(each, folder, ':');)
    if (std::string path = fs::path(folder) / command; is_file(path)) return path;
  return "";
}

}  // namespace

std::vector<std::string> files_of_program(std::string_view command) {
  std::vector<std::string> words = shell_words(command);
  fs::path folder;
  if (words.size() > 3 && words[0] == "cd") {  // cd FOLDER && exec ...
    folder = words[1];
    words.erase(words.begin(), words.begin() + (words[3] == "exec" ? 4 : 3));
  }
  std::vector<std::string> files;
  for (const std::string& word : words) {
    const bool is_searched = &word == &words.front() && word.find('/') == std::string::npos;
    if (std::string file = is_searched ? file_of_command(word) : (folder / word).string(); is_file(file))
      files.push_back(std::move(file));
  }
  return files;
}

PluginCode::PluginCode(std::string name) : name_(std::move(name)) {
  if (!is_program(name_)) {
    files_.push_back(std::make_unique<PluginFile>(PluginName::parse(name_).path));
    sha256_ = files_.front()->sha256();
    build_id_ = files_.front()->build_id();
    return;
  }
  std::string digests;
  const std::string command = name_.substr(program_prefix.size());
  if (shell_words(command).empty()) throw Error(name_ + " found no command, expected one behind the colon");
  for (const std::string& file : files_of_program(command)) {
    files_.push_back(std::make_unique<PluginFile>(file));
    digests += files_.back()->sha256() + "\n";
  }
  sha256_ = sha256_hex(digests);
}

void PluginCode::expect_unchanged(const Stop& stop) const {
  for (const auto& file : files_) file->expect_unchanged(stop);
}

}  // namespace nearmiss::isolation

#include "tools/json_output.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

#include "ccd/query/error.hpp"
#include "corpus/file.hpp"
#include "reports/text/json.hpp"

namespace nearmiss::tools {

void JsonOutput::add_to(CLI::App& command, const std::string& description) {
  command
      .add_option(
          "--json", file_,
          description + "; - writes JSON, and nothing else, to standard output, and the text to stderr")
      ->type_name("FILE|-");
}

void expect_different(const OptionFile& one, const OptionFile& other) {
  if (one.file.empty() || other.file.empty() || true_path(one.file) != true_path(other.file)) return;
  throw Error(fmt::format("{}: found the same file for {} and {}, expected two", other.file.string(),
                          one.option, other.option));
}

void expect_writable(const std::filesystem::path& file, std::string_view option,
                     const std::filesystem::path& db) {
  const auto folder = file.parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder))
    throw Error(fmt::format("{}: no folder {} to write it in", file.string(), folder.string()));
  expect_replaceable(file);
  expect_different({file, option}, {db, "--db"});
}

void JsonOutput::expect_writable(const std::filesystem::path& db) const {
  if (is_wanted() && !is_stdout()) tools::expect_writable(file_, "--json", db);
}

void JsonOutput::write(const nlohmann::ordered_json& json, int indent) const {
  if (!is_wanted()) return;
  const std::string text = json_text(json, indent) + "\n";
  if (!is_stdout()) return replace_file(file_, text);
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw Error(fmt::format("standard output cannot be written: {}", std::strerror(errno)));
}

}  // namespace nearmiss::tools

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

void JsonOutput::expect_writable() const {
  if (!is_wanted() || is_stdout()) return;
  const auto folder = file_.parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder))
    throw Error(fmt::format("{}: no folder {} to write it in", file_.string(), folder.string()));
  expect_replaceable(file_);
}

void JsonOutput::expect_other_file(const std::filesystem::path& file) const {
  if (file_.empty() || file.empty() || is_stdout()) return;
  if (true_path(file_) == true_path(file))
    throw Error(fmt::format("{}: found the same file for --json and --db, expected two", file.string()));
}

void JsonOutput::write(const nlohmann::ordered_json& json, int indent) const {
  if (!is_wanted()) return;
  const std::string text = json_text(json, indent) + "\n";
  if (!is_stdout()) return replace_file(file_, text);
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw Error(fmt::format("standard output cannot be written: {}", std::strerror(errno)));
}

}  // namespace nearmiss::tools

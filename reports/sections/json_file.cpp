#include "reports/sections/json_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"

namespace nearmiss {

void read_json_file(const std::filesystem::path& file, std::string_view expected,
                    const std::function<void(const nlohmann::ordered_json&)>& take) {
  std::ifstream in(file);
  if (!in) throw Error(fmt::format("{}: cannot be read", file.string()));
  try {
    take(nlohmann::ordered_json::parse(in));
  } catch (const nlohmann::ordered_json::exception& error) {
    // The library's message begins with the exception's name in brackets, "[json.exception.parse_error.101]
    // ".
    const std::string_view message = error.what();
    const std::size_t name = message.find("] ");
    throw Error(fmt::format("{}: found {}, expected {}", file.string(),
                            excerpt(message.substr(name == message.npos ? 0 : name + 2), 200), expected));
  }
}

}  // namespace nearmiss

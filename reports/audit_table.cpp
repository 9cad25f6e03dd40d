#include "reports/audit_table.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "ccd/error.hpp"

namespace nearmiss {

std::string load_audit(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw Error(fmt::format("{}: cannot be read", file.string()));
  const auto fail = [&](std::string_view found) {
    return Error(
        fmt::format("{}: found '{}', expected what nearmiss audit --json keeps", file.string(), found));
  };
  try {
    const auto json = nlohmann::ordered_json::parse(in);
    for (const char* table : {"constants", "tolerances"})
      if (!json.at(table).is_array()) throw fail(fmt::format("no list of {}", table));
    return json.dump();
  } catch (const nlohmann::ordered_json::exception& error) {
    throw fail(error.what());
  }
}

}  // namespace nearmiss

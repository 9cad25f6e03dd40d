#include "reports/sections/audit_table.hpp"

#include <nlohmann/json.hpp>

#include "reports/sections/json_file.hpp"

namespace nearmiss {

std::string load_audit(const std::filesystem::path& file) {
  std::string text;
  read_json_file(file, "what nearmiss audit --json keeps", [&](const nlohmann::ordered_json& json) {
    for (const char* table : {"constants", "tolerances"})
      json.at(table).get_ref<const nlohmann::ordered_json::array_t&>();  // throws if it is not a list
    text = json.dump();
  });
  return text;
}

}  // namespace nearmiss

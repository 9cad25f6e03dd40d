#include "reports/text/json.hpp"

#include <fmt/format.h>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "ccd/query/printable.hpp"
#include "corpus/file.hpp"

template class nlohmann::basic_json<>;
template class nlohmann::basic_json<nlohmann::ordered_map>;

namespace nearmiss {

template <class Json>
Json parse_json(std::string_view text) {
  static constexpr int most_levels = 32;
  try {
    return Json::parse(text, [](int level, typename Json::parse_event_t, const Json& each) {
      if (level > most_levels) throw Error(fmt::format("JSON with more than {} levels", most_levels));
      if (!each.is_string()) return true;
      if (const auto& own = each.template get_ref<const std::string&>(); printable(own) != own)
        throw Error(fmt::format("the text '{}' that is not printable", excerpt(own)));
      return true;
    });
  } catch (const typename Json::exception& error) {
    throw Error(plain_message(error));
  }
}
template nlohmann::json parse_json<nlohmann::json>(std::string_view text);
template nlohmann::ordered_json parse_json<nlohmann::ordered_json>(std::string_view text);

std::string plain_message(const std::exception& error) {
  const std::string message = error.what();
  const std::size_t end_of_name = message.starts_with("[json.exception.") ? message.find("] ") : message.npos;
  return end_of_name == message.npos ? message : message.substr(end_of_name + 2);
}

void read_json_file(const std::filesystem::path& file, std::string_view expected,
                    const std::function<void(const nlohmann::ordered_json&)>& take) {
  const std::string text = read_whole_file(file);
  try {
    take(parse_json<nlohmann::ordered_json>(text));
  } catch (const std::exception& error) {
    throw Error(fmt::format("{}: found {}, expected {}", file.string(), excerpt(plain_message(error), 200),
                            expected));
  }
}

}  // namespace nearmiss

// Includes the JSON library and makes it strict about integers. Also reads JSON that may be wrong: from
// stores, and from files that one command writes and another reads. Every file that needs the library
// includes this header, because the specialization below must be the same everywhere.
#pragma once

#include <concepts>
#include <exception>
#include <filesystem>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"

namespace nlohmann {

/// Reads an integer only from a JSON integer that the type can hold, and throws Error for anything else. The
/// library itself would cast any number, even 1e308.
template <std::integral Integer>
requires(!std::same_as<Integer, bool> && !std::same_as<Integer, char>) struct adl_serializer<Integer> {
  template <class Json>
  static void to_json(Json& json, Integer value) {
    nlohmann::to_json(json, value);
  }

  template <class Json>
  static void from_json(const Json& json, Integer& value) {
    if (const auto* const is = json.template get_ptr<const typename Json::number_unsigned_t*>())
      return store(*is, json, value);
    if (const auto* const is = json.template get_ptr<const typename Json::number_integer_t*>())
      return store(*is, json, value);
    refuse(json);
  }

 private:
  template <class Json>
  static void store(std::integral auto number, const Json& json, Integer& value) {
    if (!std::in_range<Integer>(number)) refuse(json);
    value = static_cast<Integer>(number);
  }

  template <class Json>
  [[noreturn]] static void refuse(const Json& json) {
    const std::string found = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    throw nearmiss::Error("found " + nearmiss::excerpt(found) + ", expected an integer from " +
                          std::to_string(std::numeric_limits<Integer>::min()) + " to " +
                          std::to_string(std::numeric_limits<Integer>::max()));
  }
};

}  // namespace nlohmann

// Only json.cpp compiles the members of these classes.
extern template class nlohmann::basic_json<>;
extern template class nlohmann::basic_json<nlohmann::ordered_map>;

namespace nearmiss {

/// JSON as text. A byte that is not part of valid UTF-8, for example in the name of a file, becomes U+FFFD.
template <class Json>
std::string json_text(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

/// Parses JSON into nlohmann::json or nlohmann::ordered_json. Throws Error if the text is not JSON, has more
/// than 32 levels of brackets (functions walk JSON recursively), or contains a string that is not printable.
/// nearmiss never writes a string that is not printable, because such a string could change how a terminal, a
/// page or a case shows other text.
template <class Json>
Json parse_json(std::string_view text);

/// The message of an exception, without the name with which the JSON library begins its messages, such as
/// "[json.exception.type_error.302]".
std::string plain_message(const std::exception& error);

/// Reads a JSON file and passes its content to `take`. Throws Error if the file is not a regular file,
/// cannot be read, or has more than 1 GiB. Also throws Error if parse_json or `take` throws an exception;
/// the message then contains `expected`.
void read_json_file(const std::filesystem::path& file, std::string_view expected,
                    const std::function<void(const nlohmann::ordered_json&)>& take);

}  // namespace nearmiss

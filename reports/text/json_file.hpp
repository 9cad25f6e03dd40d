// Reads JSON from outside: from stores, and from files that one command writes and another reads.
#pragma once

#include <exception>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace nearmiss {

/// Parses JSON into nlohmann::json or nlohmann::ordered_json. Throws Error if the text is not JSON; if it
/// has more than 32 levels of brackets, because functions walk JSON recursively; or if a string in it is not
/// printable. nearmiss writes no such strings; they could change how a terminal, a page or a case shows the
/// text around them.
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

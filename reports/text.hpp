// Numbers and tables as text, the same on every page and in every terminal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace nearmiss {

/// Text in columns: so many to the left, the others to the right.
std::string columns(const std::vector<std::vector<std::string>>& rows, std::size_t to_the_left);

/// 1234567 as "1,234,567".
std::string with_separators(std::uint64_t number);

/// A part of all as "12.3 %"; "" of nothing.
std::string percent(std::uint64_t part, std::uint64_t all);

/// Three digits, or as many as it takes to tell what is below 1 from 1; "below 1e-16" of a ratio that is given from
/// above only; "inf" for the largest double, which stands for any distance where 0 is claimed.
std::string fraction_of_bound(double ratio);

/// "at 0.987 of the bound", or "beyond a bound of 0".
std::string times_the_bound(double ratio);

/// "1 query", "1,234 queries"
std::string counted(std::uint64_t count, std::string_view one, std::string_view many);

}  // namespace nearmiss

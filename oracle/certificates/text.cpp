#include "oracle/certificates/text.hpp"

#include <CGAL/Gmpq.h>
#include <gmpxx.h>

#include <array>
#include <charconv>
#include <cmath>

namespace nearmiss::certificates {

namespace {

void append(std::string& text, double x) {
  std::array<char, 32> digits;
  constexpr double most = 0x1p30;  // larger integers are shorter in hexadecimal
  const double size = std::abs(x);
  const bool is_short = size == std::trunc(size) && size < most;
  const auto end = is_short ? std::to_chars(digits.begin(), digits.end(), static_cast<long>(size)).ptr
                            : std::to_chars(digits.begin(), digits.end(), size, std::chars_format::hex).ptr;
  text.append(x < 0 ? "-" : "").append(is_short ? "" : "0x").append(digits.begin(), end);
}

}  // namespace

std::string to_text(const exact::Number& x) {
  const double d = CGAL::to_double(x);
  if (!std::isfinite(d) || exact::Number(d) != x) return mpq_class(CGAL::Gmpq(x).mpq()).get_str();
  std::string text;
  append(text, d);
  return text;
}

std::string heading(const Query& query, const char* claim, double from, const std::string& to) {
  std::string text = R"({"kind":")";
  text.reserve(1 << 10);
  text.append(short_name(query.kind)).append(R"(","x":[)");
  for (const double x : coordinate_list(query)) {
    text.append(text.back() == '[' ? "\"" : ",\"");
    append(text, x);
    text += '"';
  }
  append(text += R"(],"h":")", query.separation);
  append(text.append(R"(","claim":")").append(claim).append(R"(","from":")"), from);
  return text.append(R"(","to":")").append(to).append("\"");
}

std::optional<std::string> if_short(std::string certificate) {
  constexpr std::size_t longest_line = 1 << 19;
  constexpr std::size_t longest_number = 10'000;
  if (certificate.size() <= longest_number) return certificate;
  if (certificate.size() > longest_line) return std::nullopt;
  for (std::size_t from = 0, to = 0; to != certificate.npos; from = to + 1) {
    to = certificate.find('"', from);
    if (to != certificate.npos && to - from > longest_number) return std::nullopt;
  }
  return certificate;
}

}  // namespace nearmiss::certificates

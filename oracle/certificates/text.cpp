#include "oracle/certificates/text.hpp"

#include <CGAL/Gmpq.h>
#include <gmpxx.h>

#include <array>
#include <charconv>
#include <cmath>

namespace nearmiss::certificates {

namespace {

std::string text_of(double x) {
  std::array<char, 40> text{};
  constexpr double most = 0x1p30;  // larger integers are shorter in hexadecimal
  if (x == std::trunc(x) && std::abs(x) < most) return std::to_string(static_cast<long>(x));
  const auto end = std::to_chars(text.begin(), text.end(), std::abs(x), std::chars_format::hex).ptr;
  return (x < 0 ? "-0x" : "0x") + std::string(text.begin(), end);
}

}  // namespace

std::string to_text(const exact::Number& x) {
  if (const double d = CGAL::to_double(x); std::isfinite(d) && exact::Number(d) == x) return text_of(d);
  return mpq_class(CGAL::Gmpq(x).mpq()).get_str();
}

std::string heading(const Query& query, const char* claim, double from, const std::string& to) {
  return R"({"kind":")" + std::string(short_name(query.kind)) + R"(","x":)" +
         list(coordinate_list(query), [](double x) { return quoted(text_of(x)); }) + R"(,"h":")" +
         text_of(query.separation) + R"(","claim":")" + claim + R"(","from":")" + text_of(from) +
         R"(","to":")" + to + '"';
}

std::optional<std::string> if_short(std::string certificate) {
  constexpr std::size_t longest_line = 1 << 19;
  constexpr std::size_t longest_number = 10'000;
  if (certificate.size() > longest_line) return std::nullopt;
  for (std::size_t from = 0, to = 0; to != certificate.npos; from = to + 1) {
    to = certificate.find('"', from);
    if (to != certificate.npos && to - from > longest_number) return std::nullopt;
  }
  return certificate;
}

}  // namespace nearmiss::certificates

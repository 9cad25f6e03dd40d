#include "corpus/sample_csv.hpp"

#include <fmt/format.h>
#include <gmpxx.h>

#include <cmath>
#include <istream>
#include <utility>
#include <vector>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "corpus/line_reader.hpp"

namespace nearmiss {

namespace {

Kind kind_of_folder(const std::filesystem::path& path) {
  const auto folder = std::filesystem::absolute(path).parent_path().filename();
  for (const Kind kind : kinds_of_meshes)
    if (folder == *sample_folder(kind)) return kind;
  throw Error(
      fmt::format("{}: found folder '{}', expected vertex-face or edge-edge, which determines the kind",
                  path.string(), folder.string()));
}

std::vector<std::string> split_commas(std::string_view line) {
  std::vector<std::string> words(1);
  for (const char c : line) {
    if (c == ',')
      words.emplace_back();
    else if (c != ' ' && c != '\t' && c != '\r')
      words.back() += c;
  }
  return words;
}

/// numerator / denominator, which must be exactly a double.
double exact_quotient(const std::string& numerator, const std::string& denominator,
                      const std::string& where) {
  mpz_class n, d;
  if (n.set_str(numerator, 10) != 0 || d.set_str(denominator, 10) != 0 || d == 0)
    throw Error(fmt::format("{}: found '{},{}', expected two integers, the second not 0", where,
                            excerpt(numerator), excerpt(denominator)));
  mpq_class quotient(n, d);
  quotient.canonicalize();
  const double value = quotient.get_d();
  if (!std::isfinite(value) || mpq_class(value) != quotient)
    throw Error(fmt::format("{}: found {}/{}, expected a number that is a double exactly", where,
                            excerpt(numerator), excerpt(denominator)));
  return value;
}

}  // namespace

std::optional<std::string_view> sample_folder(Kind kind) {
  switch (kind) {
    case Kind::vertex_triangle:
      return "vertex-face";
    case Kind::edge_edge:
      return "edge-edge";
    default:
      return std::nullopt;
  }
}

std::string to_sample_csv(const Query& query, bool truth) {
  std::string lines;
  for (std::size_t row = 0; row < 8; ++row) {
    for (std::size_t k = 0; k < 3; ++k) {
      const mpq_class number(query.x[3 * row + k]);
      lines += fmt::format("{},{},", number.get_num().get_str(), number.get_den().get_str());
    }
    lines += truth ? "1\n" : "0\n";
  }
  return lines;
}

void read_sample_csv(std::istream& in, const std::filesystem::path& path, const CaseSink& sink) {
  constexpr std::size_t rows = 8;
  const std::string file = path.string();
  const Kind kind = kind_of_folder(path);
  Case each;
  std::size_t row = 0;
  LineReader lines(in, file);
  while (lines.next()) {
    const std::string where = lines.where();
    const auto words = split_commas(lines.text());
    if (words.size() == 1 && words[0].empty()) continue;
    if (words.size() != 7) throw Error(fmt::format("{}: found {} columns, expected 7", where, words.size()));
    if (words[6] != "0" && words[6] != "1")
      throw Error(fmt::format("{}: found truth '{}', expected 0 or 1", where, excerpt(words[6])));
    const bool truth = words[6] == "1";
    if (row == 0) {
      each = Case{};
      each.name = where;
      each.query.kind = kind;
      each.truth = truth;
    }
    if (each.truth != truth)
      throw Error(fmt::format("{}: found a truth that differs from the query's first row", where));
    for (std::size_t k = 0; k < 3; ++k)
      each.query.x[3 * row + k] = exact_quotient(words[2 * k], words[2 * k + 1], where);
    if (++row == rows) {
      row = 0;
      sink(std::exchange(each, {}));
    }
  }
  if (row != 0)
    throw Error(fmt::format("{}:{}: found {} rows for a query, expected 8", file, lines.number(), row));
  if (lines.number() == 0) throw Error(fmt::format("{}: found no query", file));
}

}  // namespace nearmiss

#include "corpus/sample_csv.hpp"

#include <fmt/format.h>
#include <gmpxx.h>

#include <cmath>
#include <fstream>
#include <istream>
#include <iterator>
#include <utility>
#include <vector>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "corpus/line_reader.hpp"
#include "corpus/query_text.hpp"

namespace nearmiss {

namespace {

/// The kind of a file's queries, from the name of the folder or the end of the file's name.
Kind kind_of_file(const std::filesystem::path& path) {
  const auto folder = std::filesystem::absolute(path).lexically_normal().parent_path().filename();
  const std::string stem = path.stem().string();
  for (const Kind kind : kinds_of_meshes)
    if (const auto names = sample_names(kind); folder == names->folder || stem.ends_with(names->ending))
      return kind;
  throw Error(
      fmt::format("{}: found folder '{}', expected vertex-face or edge-edge, or a file's name that ends in "
                  "vf or ee, which determines the kind",
                  path.string(), folder.string()));
}

/// The recorded truths for a CSV file without a column for truths. They are read from the file
/// sample_truths(csv), if it exists.
class SeparateTruths {
 public:
  explicit SeparateTruths(const std::filesystem::path& csv)
      : file_(sample_truths(std::filesystem::canonical(std::filesystem::absolute(csv).parent_path()) /
                            csv.filename())) {
    if (std::filesystem::symlink_status(file_).type() == std::filesystem::file_type::not_found) return;
    if (!std::filesystem::is_regular_file(file_))
      throw Error(fmt::format("{}: found no file, expected the truths of {}", file_.string(), csv.string()));
    std::ifstream in(file_);
    if (!in) throw Error(fmt::format("{}: cannot be read", file_.string()));
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    std::string_view left = without_byte_order_mark(text);
    if (!skip(left, "[")) refuse(left);
    while (!skip(left, "]")) {
      if (!truths_.empty() && !skip(left, ",")) refuse(left);
      const bool truth = skip(left, "true");
      if (!truth && !skip(left, "false")) refuse(left);
      truths_.push_back(truth);
    }
    if (!trimmed(left).empty()) refuse(left);
    are_known_ = true;
  }

  /// The truth of the query with this number. Throws Error if the file of truths has too few truths.
  [[nodiscard]] std::optional<bool> operator[](std::size_t query) const {
    if (!are_known_) return std::nullopt;
    if (query >= truths_.size()) refuse_count("more");
    return truths_[query];
  }
  /// Throws Error if the file of truths has more truths than there are queries.
  void expect_end(std::size_t queries) const {
    if (are_known_ && queries < truths_.size()) refuse_count("fewer");
  }

 private:
  static std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    return first == std::string_view::npos ? "" : text.substr(first);
  }
  /// Removes leading white space, and then `word`. Returns whether the word was there.
  static bool skip(std::string_view& text, std::string_view word) {
    text = trimmed(text);
    if (!text.starts_with(word)) return false;
    text.remove_prefix(word.size());
    return true;
  }
  [[noreturn]] void refuse(std::string_view found) const {
    throw Error(fmt::format("{}: found '{}', expected an array of true and false in JSON", file_.string(),
                            excerpt(found.substr(0, 40))));
  }
  [[noreturn]] void refuse_count(const char* than) const {
    throw Error(fmt::format("{}: found {} truths, but {} queries, expected one for each", file_.string(),
                            truths_.size(), than));
  }

  std::filesystem::path file_;
  std::vector<bool> truths_;
  bool are_known_ = false;
};

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

/// The quotient numerator / denominator, which must be exactly a double.
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

std::optional<SampleNames> sample_names(Kind kind) {
  switch (kind) {
    case Kind::vertex_triangle:
      return SampleNames{"vertex-face", "vf"};
    case Kind::edge_edge:
      return SampleNames{"edge-edge", "ee"};
    default:
      return std::nullopt;
  }
}

std::filesystem::path sample_truths(const std::filesystem::path& csv) {
  return csv.parent_path().parent_path() / "mma_bool" / (csv.stem().string() + "_mma_bool.json");
}

std::string to_sample_csv(const Query& query, std::optional<bool> truth) {
  std::string lines;
  for (std::size_t row = 0; row < 8; ++row) {
    for (std::size_t k = 0; k < 3; ++k) {
      const mpq_class number(query.x[3 * row + k]);
      lines +=
          fmt::format("{}{},{}", k == 0 ? "" : ",", number.get_num().get_str(), number.get_den().get_str());
    }
    lines += truth ? fmt::format(",{:d}\n", *truth) : "\n";
  }
  return lines;
}

void read_sample_csv(std::istream& in, const std::filesystem::path& path, const CaseSink& sink) {
  constexpr std::size_t rows = 8;
  const std::string file = path.string();
  const Kind kind = kind_of_file(path);
  std::optional<SeparateTruths> truths;
  Case each;
  std::size_t row = 0, queries = 0;
  LineReader lines(in, file);
  while (lines.next()) {
    const std::string where = lines.where();
    const auto words = split_commas(lines.text());
    if ((words.size() == 1 && words[0].empty()) || words[0].starts_with('#')) continue;
    if (words.size() != 6 && words.size() != 7)
      throw Error(
          fmt::format("{}: found {} columns, expected 6, and a seventh for the truth", where, words.size()));
    const std::string written = words.size() == 7 ? words[6] : "";
    if (!written.empty() && written != "0" && written != "1")
      throw Error(fmt::format("{}: found truth '{}', expected 0 or 1", where, excerpt(written)));
    if (written.empty() && !truths) truths.emplace(path);
    const std::optional<bool> truth = written.empty() ? (*truths)[queries] : written == "1";
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
      ++queries;
      sink(std::exchange(each, {}));
    }
  }
  if (row != 0)
    throw Error(fmt::format("{}:{}: found {} rows for a query, expected 8", file, lines.number(), row));
  if (truths) truths->expect_end(queries);
  if (lines.number() == 0) throw Error(fmt::format("{}: found no query", file));
}

}  // namespace nearmiss

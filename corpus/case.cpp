#include "corpus/case.hpp"

#include <fmt/format.h>

#include <istream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "ccd/query/printable.hpp"
#include "corpus/file.hpp"
#include "corpus/line_reader.hpp"
#include "corpus/query_text.hpp"

namespace nearmiss {

namespace {

/// Labels of the points, in the order of Query::x.
constexpr std::array<std::string_view, 8> point_labels{"x0", "x1", "x2", "x3", "y0", "y1", "y2", "y3"};

std::vector<std::size_t> points_of(Kind kind) {
  std::vector<std::size_t> points;
  for (std::size_t i = 0; i < point_labels.size(); ++i)
    if (static_cast<int>(i % 4) < vertices(kind)) points.push_back(i);
  return points;
}

struct Line {
  std::string_view label, value;
};

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  return text.substr(0, text.find_last_not_of(blanks) + 1);
}

Line split_line(std::string_view text) {
  text = trimmed(text);
  const auto label = text.substr(0, text.find(' '));
  return {label, trimmed(text.substr(label.size()))};
}

}  // namespace

std::string to_text(const Case& each) {
  std::string text;
  std::istringstream why(each.why.empty() ? "" : each.why + '\n');  // else getline drops an empty last line
  for (std::string line; std::getline(why, line);) text += fmt::format("# {}\n", printable(line));
  text += fmt::format("kind {}\n", short_name(each.query.kind));
  if (each.truth) text += fmt::format("truth {}\n", *each.truth ? 1 : 0);
  if (each.query.separation != 0) text += fmt::format("separation {}\n", to_exact(each.query.separation));
  if (!each.provenance.empty()) text += fmt::format("provenance {}\n", printable(each.provenance));
  for (const std::size_t i : points_of(each.query.kind)) {
    const double* x = each.query.x.data() + 3 * i;
    text += fmt::format("{} {} {} {}\n", point_labels[i], to_exact(x[0]), to_exact(x[1]), to_exact(x[2]));
  }
  return text;
}

Case parse_case(std::istream& in, const std::string& file) {
  Case result;
  result.name = file;
  bool why_seen = false;
  std::set<std::string, std::less<>> seen;
  LineReader lines(in, file);
  while (lines.next()) {
    const std::string where = lines.where();
    const std::string_view text = lines.text();
    const auto [label, value] = split_line(text);
    if (label.empty()) continue;
    if (label.starts_with('#')) {
      if (why_seen) result.why += '\n';
      why_seen = true;
      result.why += trimmed(text.substr(text.find('#') + 1));
      continue;
    }
    if (label != "provenance" && !seen.emplace(label).second)
      throw Error(fmt::format("{}: found a second {}, expected one", where, label));
    if (label == "kind") {
      result.query.kind = parse_kind(value, where);
    } else if (label == "truth") {
      if (value != "0" && value != "1")
        throw Error(fmt::format("{}: found truth '{}', expected 0 or 1", where, excerpt(value)));
      result.truth = value == "1";
    } else if (label == "separation") {
      result.query.separation = parse_separation(value, where);
    } else if (label == "provenance") {
      result.provenance = value;
    } else {
      const auto point = std::find(point_labels.begin(), point_labels.end(), label) - point_labels.begin();
      const auto i = static_cast<std::size_t>(point);
      if (i == 8)
        throw Error(
            fmt::format("{}: found '{}', expected kind, truth, separation, provenance, or x0 .. x3, y0 .. y3",
                        where, excerpt(label)));
      parse_numbers(value, std::span(result.query.x).subspan(3 * i, 3), where);
    }
  }
  if (!seen.contains("kind"))
    throw Error(
        fmt::format("{}:{}: found no kind, expected {}", file, lines.number(), names_of_kinds("kind ")));
  const auto points = points_of(result.query.kind);
  for (const std::size_t point : points)
    if (!seen.contains(point_labels[point]))
      throw Error(fmt::format("{}:{}: found no {}, expected {} points", file, lines.number(),
                              point_labels[point], points.size()));
  for (std::size_t i = 0; i < point_labels.size(); ++i)
    if (seen.contains(point_labels[i]) && std::ranges::find(points, i) == points.end())
      throw Error(fmt::format("{}:{}: found {}, expected only the points of kind {}", file, lines.number(),
                              point_labels[i], short_name(result.query.kind)));
  repeat_vertices(result.query);
  return result;
}

void write_case(const Case& each, const std::filesystem::path& file) { replace_file(file, to_text(each)); }

}  // namespace nearmiss

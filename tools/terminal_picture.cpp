#include "tools/terminal_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

namespace nearmiss::tools {

namespace {

struct Place {
  double column, row;
};

/// A sheet of characters. A character is about twice as high as wide.
class Sheet {
 public:
  static constexpr int columns = 64;
  static constexpr int rows = 20;

  Sheet() : lines_(rows, std::string(columns, ' ')) {}

  void draw(const Place& at, char mark) {
    const auto inside = [](double x, int size) {
      return std::clamp(static_cast<int>(std::lround(x)), 0, size - 1);
    };
    lines_[static_cast<std::size_t>(inside(at.row, rows))]
          [static_cast<std::size_t>(inside(at.column, columns))] = mark;
  }

  void draw(const Place& from, const Place& to, char mark) {
    for (int i = 0; i <= 2 * columns; ++i) {
      const double part = static_cast<double>(i) / (2 * columns);
      draw({from.column + part * (to.column - from.column), from.row + part * (to.row - from.row)}, mark);
    }
  }

  [[nodiscard]] std::string text() const {
    std::string text;
    for (const std::string& line : lines_)
      if (const auto last = line.find_last_not_of(' '); last != std::string::npos)
        text += "  " + line.substr(0, last + 1) + "\n";
    return text;
  }

 private:
  std::vector<std::string> lines_;
};

class Projection {
 public:
  explicit Projection(const Query& query) : query_(query) {
    std::array<double, 3> extent{};
    for (std::size_t k = 0; k < 3; ++k) {
      lo_[k] = HUGE_VAL;
      double hi = -HUGE_VAL;
      for (std::size_t i = k; i < 24; i += 3) {
        // Divides coordinates by 4, so that no difference of two coordinates overflows.
        lo_[k] = std::min(lo_[k], query.x[i] / 4);
        hi = std::max(hi, query.x[i] / 4);
      }
      extent[k] = hi - lo_[k];
    }
    const auto shortest =
        static_cast<std::size_t>(std::min_element(extent.begin(), extent.end()) - extent.begin());
    across_ = shortest == 0 ? 1 : 0;
    up_ = shortest == 2 ? 1 : 2;
    const double scale =
        std::max(extent[across_] / (Sheet::columns - 1), extent[up_] / (2 * (Sheet::rows - 1)));
    scale_ = scale > 0 ? scale : 1;
  }

  [[nodiscard]] Place at(std::size_t vertex, double time) const {
    const auto along = [&](std::size_t k) {
      const double x =
          (1 - time) * (query_.x[3 * vertex + k] / 4) + time * (query_.x[12 + 3 * vertex + k] / 4);
      return (x - lo_[k]) / scale_;
    };
    return {along(across_), Sheet::rows - 1 - along(up_) / 2};
  }

 private:
  const Query& query_;
  std::array<double, 3> lo_{};
  std::size_t across_, up_;
  double scale_;
};

}  // namespace

std::string terminal_picture(const Query& query, double time) {
  const Projection projection(query);
  const auto at = [&](std::size_t vertex, double t) { return projection.at(vertex, t); };
  Sheet sheet;
  for (std::size_t i = 0; i < 4; ++i) sheet.draw(at(i, 0), at(i, 1), '.');
  const auto edge = [&](std::size_t i, std::size_t j, char mark) {
    sheet.draw(at(i, time), at(j, time), mark);
  };
  const auto& edges = topology(query.kind).edges;
  // Draws the edges of the first primitive last, so that they are on top.
  for (std::size_t i = edges.size(); i-- > 0;)
    edge(edges[i].from, edges[i].to, edges[i].from == 0 ? 'o' : '#');
  constexpr std::string_view numbers = "0123";
  for (std::size_t i = 4; i-- > 0;) sheet.draw(at(i, time), numbers[i]);
  return sheet.text();
}

std::string vertex_lines(const Query& query, std::size_t widest) {
  std::string lines;
  for (std::size_t i = 0; i < static_cast<std::size_t>(vertices(query.kind)); ++i) {
    const auto line = [&](const char* prefix, const char* number) {
      const auto point = [&](std::size_t time) {
        const double* const x = &query.x[12 * time + 3 * i];
        const auto text = [&](double c) { return fmt::format(fmt::runtime(number), c + 0.0); };  // no -0
        return fmt::format("({}, {}, {})", text(x[0]), text(x[1]), text(x[2]));
      };
      const bool moves = !std::equal(&query.x[3 * i], &query.x[3 * i] + 3, &query.x[12 + 3 * i]);
      return fmt::format("  x{} {}{}{}\n", i, prefix, point(0), moves ? " -> " + point(1) : "");
    };
    const std::string exact = line("", "{}");
    lines += exact.size() - 1 <= widest ? exact : line("~", "{:.6g}");
  }
  return lines;
}

}  // namespace nearmiss::tools

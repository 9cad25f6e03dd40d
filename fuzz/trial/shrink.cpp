#include "fuzz/trial/shrink.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "fuzz/trial/complexity.hpp"

namespace nearmiss {

namespace {

constexpr std::size_t separation = 24;  // among Numbers

/// The path of a vertex along axis k consists of two coordinates: that at t = 0 has this index, and that at
/// t = 1 has this index plus 12.
constexpr std::size_t path(std::size_t vertex, std::size_t k) { return 3 * vertex + k; }
constexpr std::size_t paths = 12;
constexpr std::array<std::size_t, 2> times{0, paths};

/// A set of numbers: bit i stands for number i.
using Set = std::uint32_t;
constexpr Set only(std::size_t i) { return Set{1} << i; }
constexpr Set path_set(std::size_t i) { return only(i) | only(paths + i); }
constexpr Set axis_set(std::size_t k) { return 0x249249U << k; }
constexpr Set vertex_set(std::size_t vertex) { return 0x7007U << path(vertex, 0); }
constexpr Set everything = 0x1ffffffU;

/// magnitudes() of the numbers in a set.
std::vector<double> magnitudes_in(Set set, const Numbers& x) {
  std::vector<double> some;
  for (std::size_t i = 0; i < x.size(); ++i)
    if ((set & only(i)) != 0) some.push_back(x[i]);
  return magnitudes(some);
}

/// The length, in words, of the integers in exact arithmetic with a query's numbers.
int words(const Numbers& x) {
  const auto all = magnitudes(x);
  if (all.empty()) return 1;
  int lowest = std::ilogb(all.front());
  for (const double m : all) lowest = std::min(lowest, std::ilogb(m) - significant_bits(m) + 1);
  return 1 + (std::ilogb(all.back()) - lowest) / 64;
}

/// Simplifies a failing query step by step.
class Shrinker {
 public:
  Shrinker(const Query& query, const std::function<bool(const Query&)>& fails)
      : kind_(query.kind), best_(numbers_of(query)), complexity_(complexity(query)), fails_(fails) {}

  Query run() {
    Numbers before;
    do {
      before = best_;
      round_all();
      change_numbers();
      move_axes();
      shear_axes();
      join_vertices();
      combine_vertices();
      change_times();
      scale();
      copy_paths();
      reorder();
    } while (best_ != before && work_ > 0);
    return query_of(best_);
  }

 private:
  [[nodiscard]] Query query_of(const Numbers& x) const {
    Query query{.kind = kind_, .separation = x[separation]};
    std::copy_n(x.begin(), query.x.size(), query.x.begin());
    return query;
  }

  /// Replaces the best query so far if the changed query is simpler and fails. Of two queries of equal
  /// complexity, the one with smaller coordinates counts as simpler, so that no step undoes another.
  template <class Change>
  bool take(const Change& change) {
    Numbers candidate = best_;
    change(candidate);
    for (double& c : candidate) c += 0.0;  // makes -0 into 0
    candidate[separation] = std::abs(candidate[separation]);
    const Query query = query_of(candidate);
    if (!is_finite(query) || !std::isfinite(query.separation)) return false;
    const Complexity own = complexity(query);
    if (complexity_ < own || (own == complexity_ && candidate >= best_) || work_ <= 0) return false;
    work_ -= words(candidate);
    if (!fails_(query)) return false;
    best_ = candidate;
    complexity_ = own;
    return true;
  }

  /// Scales the query by powers of two, and rounds all coordinates to integers that are small, or a little larger.
  /// Before that, a vertex moves to the origin: at t = 0, or at all times.
  void round_all() {
    for (const int exponent : {0, 1, 2, 3, 4, 6})
      for (const bool each_axis : {false, true}) {
        take([&](Numbers& x) { round(x, exponent, each_axis); });
        for (std::size_t vertex = 0; vertex < 4; ++vertex)
          for (const std::size_t end : times)
            take([&](Numbers& x) {
              for (std::size_t k = 0; k < 3; ++k)
                subtract(x, k, best_[path(vertex, k)], best_[end + path(vertex, k)]);
              round(x, exponent, each_axis);
            });
      }
  }

  /// Scales all axes together, or each one, so that the largest magnitude is in [2^exponent, 2^(exponent + 1)), and
  /// rounds. A separation that is scaled with all axes becomes 1 at least, since 0 asks another question.
  static void round(Numbers& x, int exponent, bool each_axis) {
    const bool has_separation = x[separation] != 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto all = magnitudes_in(each_axis ? axis_set(k) : everything, x);
      if (all.empty()) continue;
      const int up = exponent - std::ilogb(all.back());
      replace(x, each_axis ? axis_set(k) : everything,
              [&](double c) { return std::nearbyint(std::ldexp(c, up)); });
      if (each_axis) continue;
      if (has_separation) x[separation] = std::max(x[separation], 1.0);
      return;
    }
  }

  /// Subtracts numbers from the coordinates of all vertices along axis k, at t = 0 and t = 1.
  static void subtract(Numbers& x, std::size_t k, double of_start, double of_end) {
    for (std::size_t v = 0; v < 4; ++v) {
      x[path(v, k)] -= of_start;
      x[paths + path(v, k)] -= of_end;
    }
  }

  /// Sets all coordinates of an axis to 0, or subtracts the coordinates of one point at t = 0, at t = 1 or
  /// both, or those of a moving point. If the subtraction is exact, no contact is lost.
  void move_axes() {
    for (std::size_t k = 0; k < 3; ++k) {
      take([&](Numbers& x) { replace(x, axis_set(k), [](double) { return 0.0; }); });
      for (std::size_t vertex = 0; vertex < 4; ++vertex) {
        const std::array shifts{0.0, best_[path(vertex, k)], best_[paths + path(vertex, k)]};
        for (const double of_start : shifts)
          for (const double of_end : shifts) take([&](Numbers& x) { subtract(x, k, of_start, of_end); });
      }
    }
  }

  /// Subtracts a multiple of one axis from another, so that a coordinate becomes 0.
  void shear_axes() {
    for (std::size_t k = 0; k < 3; ++k)
      for (const std::size_t other : {(k + 1) % 3, (k + 2) % 3})
        for (std::size_t point = 0; point < 8; ++point) {
          const double from = best_[3 * point + other];
          if (from == 0) continue;
          const double factor = best_[3 * point + k] / from;
          take([&](Numbers& x) {
            for (std::size_t p = 0; p < 8; ++p) x[3 * p + k] -= factor * x[3 * p + other];
          });
        }
  }

  /// Copies the motion of one vertex to another, or one point to another.
  void join_vertices() {
    for (std::size_t to = 0; to < 8; ++to)
      for (std::size_t from = 0; from < 8; ++from)
        take([&](Numbers& x) { std::copy_n(x.begin() + 3 * from, 3, x.begin() + 3 * to); });
    for (std::size_t to = 0; to < 4; ++to)
      for (std::size_t from = 0; from < 4; ++from)
        take([&](Numbers& x) {
          for (const std::size_t time : times)
            std::copy_n(x.begin() + time + path(from, 0), 3, x.begin() + time + path(to, 0));
        });
  }

  /// Moves a vertex by the vector between two other vertices, or by half or twice that vector. Vertices of a
  /// triangle or of coplanar edges stay in their plane.
  void combine_vertices() {
    for (std::size_t vertex = 0; vertex < 4; ++vertex)
      for (std::size_t from = 0; from < 4; ++from)
        for (std::size_t to = 0; to < 4; ++to)
          for (const double factor : {1.0, 0.5, 2.0})
            take([&](Numbers& x) {
              for (std::size_t k = 0; k < 3; ++k)
                for (const std::size_t time : times)
                  x[time + path(vertex, k)] +=
                      factor * (best_[time + path(to, k)] - best_[time + path(from, k)]);
            });
  }

  /// Makes the motion start or end earlier or later.
  void change_times() {
    for (const double t : {-1.0, 0.25, 0.5, 0.75, 2.0})
      for (const std::size_t end : times)
        take([&](Numbers& x) {
          for (std::size_t i = 0; i < paths; ++i) x[end + i] = best_[i] + t * (best_[paths + i] - best_[i]);
        });
  }

  /// Divides all numbers, or the coordinates of an axis, a vertex or a path, by one of these numbers, by a
  /// power of two near one of them, or by a small number.
  void scale() {
    std::vector<Set> sets{everything};
    for (std::size_t k = 0; k < 3; ++k) sets.push_back(axis_set(k));
    for (std::size_t v = 0; v < 4; ++v) sets.push_back(vertex_set(v));
    for (std::size_t i = 0; i < paths; ++i) sets.push_back(path_set(i));
    for (const Set set : sets) {
      std::vector<double> divisors{-1, 3, 5};
      for (const double m : magnitudes_in(set, best_)) {
        divisors.push_back(m);
        for (int e = std::ilogb(m); e != 0; e /= 2) divisors.push_back(std::ldexp(1.0, e));
      }
      for (const double by : divisors)
        take([&](Numbers& x) { replace(x, set, [&](double c) { return c / by; }); });
    }
  }

  /// Simplifies numbers of one magnitude: all of them, those of an axis, those of a path, and single numbers.
  void change_numbers() {
    for (std::size_t i = 0; i < best_.size(); ++i) {
      const bool is_coordinate = i != separation;
      const Set of_axis = is_coordinate ? axis_set(i % 3) : only(i);
      const Set of_path = is_coordinate ? path_set(i % paths) : only(i);
      Set last = 0;
      for (const Set within : {everything, of_axis, of_path, only(i)}) {
        const Set set = alike(i) & within;
        if (set != last && set % only(i) == 0) change_number(set);  // each set once, at its first member
        last = set;
      }
    }
  }

  /// The numbers of the same magnitude as number i.
  [[nodiscard]] Set alike(std::size_t i) const {
    Set set = 0;
    for (std::size_t j = 0; j < best_.size(); ++j)
      if (std::abs(best_[j]) == std::abs(best_[i])) set |= only(j);
    return set;
  }

  /// Tries these replacements until the query still fails with one: 0; a small number; another number of the
  /// query; a number so small, or so large, that it, or 1, is lost by rounding in their sum; a number with
  /// fewer bits.
  void change_number(Set set) {
    const double magnitude = std::abs(best_[static_cast<std::size_t>(std::countr_zero(set))]);
    if (magnitude == 0) return;
    const auto become = [&](double other) {
      return take([&](Numbers& x) { replace(x, set, [&](double c) { return c < 0 ? -other : other; }); });
    };
    if (become(0)) return;
    std::vector<double> others = magnitudes(best_);
    others.insert(others.begin(), {1, 2, 3, 4, 5, 6, 7, 8, 9, 0.5, 0.25, 0.75, 1.5, 10});
    others.insert(others.end(), {0x1p-53, 0x1p53});
    for (const double other : others)
      if (become(other) || become(-other)) return;
    const int bits = significant_bits(magnitude);
    for (const int fewer : {1, 2, 3, 4, 6, 8, 11, 15, 20, 26, 34, 44, bits - 1}) {
      if (fewer < 1 || fewer >= bits) continue;
      const double unit = std::ldexp(1.0, std::ilogb(magnitude) - fewer + 1);
      const double down = std::floor(magnitude / unit) * unit;
      if (become(down) || become(down + unit)) return;
    }
  }

  /// Sets a coordinate to 0, or copies another one or its negative.
  void copy_paths() {
    for (std::size_t to = 0; to < paths; ++to)
      for (std::size_t from = 0; from < paths; ++from)
        for (const double sign : {0.0, 1.0, -1.0})
          take([&](Numbers& x) {
            for (const std::size_t time : times) x[time + to] = sign * x[time + from];
          });
  }

  /// Exchanges axes, vertices, and start and end.
  void reorder() {
    for (std::size_t k = 0; k < 3; ++k)
      take([&](Numbers& x) {
        for (std::size_t p = 0; p < 8; ++p) std::swap(x[3 * p + k], x[3 * p + (k + 1) % 3]);
      });
    const int first = split(kind_);
    for (int v = 0; v < 4; ++v)
      for (int w = v + 1; w < 4; ++w)
        if ((v < first) == (w < first)) take([&](Numbers& x) { exchange(x, v, w); });
    if (kind_ == Kind::edge_edge)
      take([&](Numbers& x) {
        exchange(x, 0, 2);
        exchange(x, 1, 3);
      });
    take([](Numbers& x) { std::swap_ranges(x.begin(), x.begin() + paths, x.begin() + paths); });
  }

  static void exchange(Numbers& x, int v, int w) {
    for (double* start : {x.data(), x.data() + paths})
      std::swap_ranges(start + 3 * v, start + 3 * v + 3, start + 3 * w);
  }

  template <class Function>
  static void replace(Numbers& x, Set set, const Function& function) {
    for (std::size_t i = 0; i < x.size(); ++i)
      if ((set & only(i)) != 0) x[i] = function(x[i]);
  }

  Kind kind_;
  Numbers best_;
  Complexity complexity_;
  const std::function<bool(const Query&)>& fails_;
  long work_ = 200000;  ///< the remaining budget, in words of exact arithmetic
};

}  // namespace

Query shrunk(const Query& query, const std::function<bool(const Query&)>& fails) {
  return fails(query) ? Shrinker(query, fails).run() : query;
}

}  // namespace nearmiss

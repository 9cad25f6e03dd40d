// The certified filter for many queries of one kind at once: patch.hpp's arithmetic in lanes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include "ccd/plane_culling.hpp"
#include "oracle/batch.hpp"
#include "oracle/filter.hpp"
#include "oracle/lanes.hpp"
#include "oracle/patch.hpp"

namespace nearmiss::certified {

/// Goes through the queries stage by stage, each time with those that are left side by side in n lanes:
/// moving planes; F of one sign; then parts of the step, as Search does, but with fewer means: what is hard
/// is left undecided. What is computed in a lane depends on its query alone, so n changes no answer.
template <int n, Kind kind>
class BatchFilter {
 public:
  explicit BatchFilter(double caution) : caution_(caution) {}

  /// Looks at those of the queries that are of its kind, at most batch_size; decides stages[i], which was
  /// `undecided`, or leaves it so.
  void run(const Query* queries, std::size_t count, FilterStage* stages, const Query* ahead) {
    queries_ = queries;
    ahead_ = ahead;
    const Rows all(count, [&](std::size_t q) { return queries[q].kind == kind; });
    const Rows crossing = cull_by_planes(all, stages);
    const Rows unsure = cull_by_sign(crossing, stages);
    prepare_weights(unsure);
    search(unsure, stages);
  }

 private:
  using Real = Lanes<n>;
  using Mask = typename Real::Mask;
  using Column = std::array<double, batch_size + n>;
  static constexpr std::size_t weight_count = kind == Kind::vertex_triangle ? 3 : 4;

  /// Numbers of queries, taken n at a time.
  class Rows {
   public:
    Rows() = default;
    /// Those of the first `count` rows for which `wanted` holds.
    template <class Wanted>
    Rows(std::size_t count, const Wanted& wanted) {
      std::size_t size = 0;
      for (std::size_t row = 0; row < count; ++row) {
        rows_[size] = static_cast<std::uint8_t>(row);
        size += wanted(row) ? 1 : 0;
      }
      size_ = size;
    }
    void add(std::size_t row) { add_if(true, row); }
    /// Without a branch, which could only be guessed.
    void add_if(bool wanted, std::size_t row) {
      rows_[size_] = static_cast<std::uint8_t>(row);
      size_ += wanted ? 1 : 0;
    }
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] std::size_t operator[](std::size_t i) const { return rows_[i]; }
    /// Rows first .. first + n - 1; behind the last one there are others, whose lanes mean nothing.
    [[nodiscard]] const std::uint8_t* pack(std::size_t first) const { return rows_.data() + first; }

   private:
    std::array<std::uint8_t, batch_size + n> rows_{};
    std::size_t size_ = 0;
  };

  /// Numbers of lanes as an array: `visit(lane, number)`.
  template <class Visit>
  static void for_lanes(const typename Real::Bits& bits, std::size_t count, const Visit& visit) {
    std::array<std::int64_t, n> numbers;
    std::memcpy(numbers.data(), &bits, sizeof(bits));
    for (std::size_t l = 0; l < std::min<std::size_t>(n, count); ++l) visit(l, numbers[l]);
  }

  /// The points of the queries in a pack of rows.
  struct Points {
    std::array<Real, 24> x;  ///< in the order of Query::x
    const Real& operator()(std::size_t time, std::size_t vertex, std::size_t k) const {
      return x[12 * time + 3 * vertex + k];
    }
  };
  [[nodiscard]] Points points(const std::uint8_t* rows) const {
    Points points;
    for (std::size_t i = 0; i < 24; i += n) {
      Real* const columns = &points.x[i];
      for (std::size_t l = 0; l < n; ++l) columns[l] = Real::load(&queries_[rows[l]].x[i]);
      Real::transpose(columns);
    }
    return points;
  }

  /// Into the nearest cache, line by line.
  static void fetch(const Query& query) {
    const auto* const bytes = reinterpret_cast<const char*>(&query);
    for (std::size_t line = 0; line < sizeof(Query); line += 64) __builtin_prefetch(bytes + line);
    __builtin_prefetch(bytes + sizeof(Query) - 1);
  }

  Rows cull_by_planes(const Rows& rows, FilterStage* stages) const {
    Rows left;
    for (std::size_t i = 0; i < rows.size(); i += n) {
      for (std::size_t l = 0; l < n; ++l) fetch(ahead_[rows[i + l]]);
      const Points x = points(rows.pack(i));
      const Mask apart = nearmiss::detail::separated_across_axis<kind>(x) |
                         nearmiss::detail::separated_across_diagonal<kind>(x);
      std::array<Real, 4> sums{x.x[0], x.x[1], x.x[2],
                               x.x[3]};  // four at a time, for they wait for each other
      for (std::size_t c = 4; c < 24; c += 4)
        for (std::size_t k = 0; k < 4; ++k) sums[k] += x.x[c + k];
      // Finite only where all are.
      const Mask finite = abs((sums[0] + sums[1]) + (sums[2] + sums[3])) < HUGE_VAL;
      constexpr int separated = 1;
      constexpr int unsure = 2;
      for_lanes((finite & apart).as(separated) | (finite & (!apart)).as(unsure), rows.size() - i,
                [&](std::size_t l, std::int64_t code) {
                  const std::size_t row = rows[i + l];
                  stages[row] = code == separated ? FilterStage::planes : FilterStage::undecided;
                  left.add_if(code == unsure, row);
                });
    }
    return left;
  }

  /// x_i - x_j for all that F and the weights need.
  Patch<Real> patch(const std::uint8_t* rows) const {
    const Points x = points(rows);
    const auto difference = [&](std::size_t i, std::size_t j) {
      Motion<Real> motion;
      for (std::size_t k = 0; k < 3; ++k) {
        motion.start[k] = x(0, i, k) - x(0, j, k);
        motion.end[k] = x(1, i, k) - x(1, j, k);
      }
      motion.magnitude = larger_magnitude(motion.start, motion.end);
      motion.rounded_once = true;
      return motion;
    };
    return {0, 1, difference(1, 0), difference(2, 0), difference(3, 0), difference(2, 1), difference(3, 1)};
  }

  Rows cull_by_sign(const Rows& rows, FilterStage* stages) {
    Rows left;
    for (std::size_t i = 0; i < rows.size(); i += n) {
      const Patch<Real> p = patch(rows.pack(i));
      auto F = coplanarity(p.a, p.b, p.c);
      F.error = caution_ * F.error;
      const auto [positive, negative] = certain_signs(F.b, F.error);
      const Mask ends_known = (abs(F.b[0]) > F.error) & (abs(F.b[3]) > F.error);
      constexpr int one_sign = 1;
      constexpr int known = 2;
      std::array<std::array<double, n>, 5> f;
      for (std::size_t c = 0; c < 4; ++c) F.b[c].store(f[c].data());
      F.error.store(f[4].data());
      for_lanes((positive | negative).as(one_sign) | ends_known.as(known), rows.size() - i,
                [&](std::size_t l, std::int64_t code) {
                  const std::size_t row = rows[i + l];
                  stages[row] = (code & one_sign) != 0 ? FilterStage::one_sign : FilterStage::undecided;
                  if (code != known) return;
                  for (std::size_t c = 0; c < 5; ++c) F_[c][left.size()] = f[c][l];
                  left.add(row);
                });
    }
    return left;
  }

  struct Signs {
    Mask positive, negative;
  };
  /// Where all numbers certainly have the sign.
  template <std::size_t count>
  static Signs certain_signs(const std::array<Real, count>& numbers, const Real& error) {
    Signs signs{numbers[0] > error, numbers[0] < -error};
    for (std::size_t i = 1; i < count; ++i) {
      signs.positive = signs.positive & (numbers[i] > error);
      signs.negative = signs.negative & (numbers[i] < -error);
    }
    return signs;
  }

  /// Keeps the weights in the component in which the normal is largest at t = 1/2.
  void prepare_weights(const Rows& rows) {
    for (std::size_t i = 0; i < rows.size(); i += n) {
      const Patch<Real> whole = patch(rows.pack(i));
      const auto twice_middle = [](const Motion<Real>& m) {
        return Vec<Real>{m.start[0] + m.end[0], m.start[1] + m.end[1], m.start[2] + m.end[2]};
      };
      const Vec<Real> x21 = twice_middle(whole.x21);
      const Vec<Real> x31 = twice_middle(whole.x31);
      const Vec<Real> a = twice_middle(whole.a);
      const Vec<Real> x32{x31[0] - x21[0], x31[1] - x21[1], x31[2] - x21[2]};
      Vec<Real> normal;
      for (std::size_t k = 0; k < 3; ++k)
        normal[k] =
            abs(kind == Kind::vertex_triangle ? cross_component(x21, x31, k) : cross_component(a, x32, k));
      const Mask first = !(normal[0] < max(normal[1], normal[2]));
      const Mask second = !(normal[1] < normal[2]);
      // Component k is brought to the place of component 0, the other two behind it: only they are needed.
      const auto choose = [&](const Vec<Real>& v) {
        return Vec<Real>{Real(0), select(first, v[1], select(second, v[2], v[0])),
                         select(first, v[2], select(second, v[0], v[1]))};
      };
      const auto turn = [&](const Motion<Real>& m) {
        return Motion<Real>{choose(m.start), choose(m.end), choose(m.magnitude), true, {}};
      };
      const Weights<Real> weights(
          kind, {0, 1, turn(whole.a), turn(whole.b), turn(whole.c), turn(whole.x21), turn(whole.x31)}, 0);
      for (std::size_t w = 0; w < weight_count; ++w) {
        for (std::size_t c = 0; c < 3; ++c) weights.w[w].b[c].store(&W_[4 * w + c][i]);
        (caution_ * weights.w[w].error).store(&W_[4 * w + 3][i]);
      }
    }
  }

  struct Agreement {
    Mask agree, opposed;
  };
  /// Of the weights, given what tells the signs of one of them.
  template <class SignsOf>
  static Agreement agreement(const std::array<Bernstein<Real, 3>, weight_count>& weights,
                             const SignsOf& signs_of) {
    Signs some = signs_of(weights[0]);
    Mask all = some.positive | some.negative;
    for (std::size_t w = 1; w < weight_count; ++w) {
      const Signs own = signs_of(weights[w]);
      some = {some.positive | own.positive, some.negative | own.negative};
      all = all & (own.positive | own.negative);
    }
    const Mask opposed = some.positive & some.negative;
    return {all & (!opposed), opposed};
  }

  using Cubic = Bernstein<Real, 4>;
  using Quadratics = std::array<Bernstein<Real, 3>, weight_count>;

  /// F and the weights of some queries, given how to take n numbers from a column.
  template <class Take>
  std::pair<Cubic, Quadratics> polynomials(const Take& take) const {
    const Cubic F{{take(F_[0]), take(F_[1]), take(F_[2]), take(F_[3])}, take(F_[4])};
    Quadratics weights;
    for (std::size_t w = 0; w < weight_count; ++w)
      weights[w] = {{take(W_[4 * w]), take(W_[4 * w + 1]), take(W_[4 * w + 2])}, take(W_[4 * w + 3])};
    return {F, weights};
  }

  /// What was seen in a part of the step, and which parts of it have to be looked at: [lo, left], [left,
  /// right] and [right, hi].
  struct Look {
    enum : std::int64_t { collision = 1, unknown = 2, before = 4, middle = 8, behind = 16 };
    typename Real::Bits outcome;
    Real left, right;
  };

  static Look look(const Cubic& F, const Quadratics& weights, const Real& lo, const Real& hi) {
    const auto f = F.on(lo, hi);
    const Signs whole = certain_signs(f, F.error);
    const auto in_all =
        agreement(weights, [&](const auto& w) { return certain_signs(w.on(lo, hi), w.error); });
    const Mask dropped = whole.positive | whole.negative | in_all.opposed;
    const Signs at_lo = certain_signs(std::array{f[0]}, F.error);
    const Signs at_hi = certain_signs(std::array{f[3]}, F.error);
    const Mask rises = at_lo.negative & at_hi.positive;
    const Mask changes = rises | (at_lo.positive & at_hi.negative);
    const Mask known = (at_lo.positive | at_lo.negative) & (at_hi.positive | at_hi.negative);

    // F's root where it changes its sign, by Newton's method from the secant's: a guess.
    const Real p3 = F.b[3] - F.b[0] + 3 * (F.b[1] - F.b[2]);
    const Real p2 = 3 * (F.b[0] + F.b[2] - 2 * F.b[1]);
    const Real p1 = 3 * (F.b[1] - F.b[0]);
    Real t = lo + (hi - lo) * (f[0] / (f[0] - f[3]));
    Real step = 0;
    Real slope = 0;
    for (int i = 0; i < 4; ++i) {
      slope = (3 * p3 * t + 2 * p2) * t + p1;
      step = (((p3 * t + p2) * t + p1) * t + F.b[0]) / slope;
      t = min(max(t - step, lo), hi);
    }
    const Real h = 2 * abs(step) + 4 * F.error / abs(slope) + 0x1p-50;
    const Real before_root = max(lo, t - h);
    const Real behind_root = min(hi, t + h);
    const Real rise = select(rises, Real(1), Real(-1));
    const Mask bracketed = changes & (h < 0.0625 * (hi - lo)) & (rise * F.at(before_root) < -F.error) &
                           (rise * F.at(behind_root) > F.error);
    const auto near = agreement(
        weights, [&](const auto& w) { return certain_signs(std::array{w.at(t)}, w.error_near(h)); });

    // Else the part is divided where F has an extremum, about.
    const Real d0 = f[1] - f[0];
    const Real d1 = f[2] - f[1];
    const Real d2 = f[3] - f[2];
    const Real root = sqrt(max(d1 * d1 - d0 * d2, Real(0)));
    const Real extremum = d0 / (d0 - d1 + select(d0 < 0, -root, root));
    const Mask usable = (!changes) & (extremum > 0x1p-6) & (extremum < 1 - 0x1p-6);
    const Real division = lo + (hi - lo) * select(usable, extremum, Real(0.5));

    Look result;
    result.left = select(bracketed, before_root, division);
    result.right = select(bracketed, behind_root, division);
    const Signs before = certain_signs(F.on(lo, result.left), F.error);
    const Signs behind = certain_signs(F.on(result.right, hi), F.error);
    const Mask found = changes & (in_all.agree | (bracketed & near.agree)) & (!dropped);
    const Mask go_on = known & (!dropped) & (!found);
    result.outcome = found.as(Look::collision) | ((!known) & (!dropped)).as(Look::unknown) |
                     (go_on & (!(before.positive | before.negative))).as(Look::before) |
                     (go_on & bracketed & (!near.opposed)).as(Look::middle) |
                     (go_on & (!(behind.positive | behind.negative))).as(Look::behind);
    return result;
  }

  /// A part of the step of a query in the list of those that are searched.
  struct Part {
    double lo, hi;
    std::uint8_t place;
    std::uint8_t depth;
  };

  /// Looks at the whole step of every query, then at the parts that are left, until none are.
  void search(const Rows& rows, FilterStage* stages) const {
    constexpr std::uint8_t deepest = 8;
    constexpr std::size_t room = 4 * batch_size;
    std::array<Part, room + n> parts;
    std::array<Part, room + n> next;
    std::size_t count = 0;
    std::size_t next_count = 0;
    const auto take_over = [&](const Look& seen, std::size_t lanes, const auto& part_of_lane) {
      std::array<double, n> left;
      std::array<double, n> right;
      seen.left.store(left.data());
      seen.right.store(right.data());
      for_lanes(seen.outcome, lanes, [&](std::size_t l, std::int64_t outcome) {
        if (outcome == 0) return;
        const Part part = part_of_lane(l);
        FilterStage& stage = stages[rows[part.place]];
        if ((outcome & Look::collision) != 0) stage = FilterStage::sign_change;
        if (stage == FilterStage::sign_change) return;
        const auto push = [&](double lo, double hi) {
          if (part.depth == deepest || next_count == room)
            stage = FilterStage::undecided;
          else if (lo < hi)
            next[next_count++] = {lo, hi, part.place, static_cast<std::uint8_t>(part.depth + 1)};
        };
        if ((outcome & Look::unknown) != 0) stage = FilterStage::undecided;
        if ((outcome & Look::before) != 0) push(part.lo, left[l]);
        if ((outcome & Look::middle) != 0) push(left[l], right[l]);
        if ((outcome & Look::behind) != 0) push(right[l], part.hi);
      });
    };
    for (std::size_t i = 0; i < rows.size(); ++i) stages[rows[i]] = FilterStage::weights;
    for (std::size_t i = 0; i < rows.size(); i += n) {
      const auto [F, weights] = polynomials([&](const Column& c) { return Real::load(&c[i]); });
      take_over(look(F, weights, 0, 1), rows.size() - i, [&](std::size_t l) {
        return Part{0, 1, static_cast<std::uint8_t>(i + l), 0};
      });
    }
    while (next_count > 0) {
      std::copy_n(next.begin(), next_count, parts.begin());
      count = std::exchange(next_count, 0);
      std::fill_n(parts.begin() + count, n, Part{0, 1, 0, 0});
      for (std::size_t i = 0; i < count; i += n) {
        const Part* const pack = &parts[i];
        const auto [F, weights] = polynomials(
            [&](const Column& c) { return Real::gather([&](std::size_t l) { return c[pack[l].place]; }); });
        const Real lo = Real::gather([&](std::size_t l) { return pack[l].lo; });
        const Real hi = Real::gather([&](std::size_t l) { return pack[l].hi; });
        take_over(look(F, weights, lo, hi), count - i, [&](std::size_t l) { return pack[l]; });
      }
    }
  }

  double caution_;  ///< at least 1, the factor of all bounds
  const Query* queries_ = nullptr;
  const Query* ahead_ = nullptr;
  // By place in the list of the queries that are searched; a pack of lanes may reach beyond its end.
  std::array<Column, 5> F_;                 ///< Bernstein coefficients and error
  std::array<Column, 4 * weight_count> W_;  ///< likewise, weight by weight
};

template <int n>
void filter_batch(const Query* queries, std::size_t count, double caution, FilterStage* stages,
                  const Query* ahead) {
  std::fill_n(stages, count, FilterStage::undecided);
  BatchFilter<n, Kind::vertex_triangle> vertex_triangle(caution);
  vertex_triangle.run(queries, count, stages, ahead);
  BatchFilter<n, Kind::edge_edge> edge_edge(caution);
  edge_edge.run(queries, count, stages, ahead);
}

}  // namespace nearmiss::certified

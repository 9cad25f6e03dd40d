// `wang` for many queries at once, one query in each lane, with the same arithmetic as wang.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "ccd/query/lanes.hpp"
#include "ccd/wang/cubic.hpp"
#include "ccd/wang/cubic_lanes.hpp"
#include "ccd/wang/motion.hpp"
#include "ccd/wang/plane_culling.hpp"
#include "ccd/wang/proximity.hpp"
#include "ccd/wang/tolerances.hpp"
#include "ccd/wang/ve_culling.hpp"
#include "ccd/wang/verdict.hpp"
#include "ccd/wang/wang.hpp"
#include "ccd/wang/wang_batch.hpp"

namespace nearmiss {

/// Decides queries of one kind in four steps: plane culling; the rejection of queries for which the
/// coplanarity cubic F stays away from 0; the search for roots of F; and the tests at the roots. Each step
/// processes, n at a time, the queries that the previous steps have left undecided. Queries that need
/// vertex-edge tests, another frame or another order of end points stay undecided. A lane computes exactly
/// what the templates of wang.hpp compute for its query, so n changes no verdict.
template <int n, Kind kind>
class WangLanes {
 public:
  WangLanes(const QueryRows& queries, Verdict* verdicts, const std::optional<double>& given)
      : queries_(queries), verdicts_(verdicts), given_(given) {}

  /// Decides the queries of the kind `kind`. Returns the number of queries of this kind, both decided and
  /// undecided. The batch has at most `wang_batch_size` queries.
  std::size_t run() {
    Rows of_kind;
    for (std::size_t row = 0; row < queries_.size(); ++row) of_kind.add_if(queries_.kind(row) == kind, row);
    reject_clear(reject_separated(of_kind));
    find_roots();
    refine_roots();
    test_candidates();
    conclude();
    return of_kind.size();
  }

 private:
  using Real = Lanes<n>;
  using Mask = typename Real::Mask;

  /// A list of at most `most` numbers. Its array has room for n more numbers after the last number of the
  /// list.
  template <class Number, std::size_t most>
  using Column = std::array<Number, most + n>;

  /// A list of rows: indices of queries in the batch.
  class Rows {
   public:
    /// Adds a row if `wanted` is true. The code has no branch.
    void add_if(bool wanted, std::size_t row) {
      rows_[size_] = static_cast<std::uint8_t>(row);
      size_ += wanted ? 1 : 0;
    }
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] std::size_t operator[](std::size_t i) const { return rows_[i]; }

   private:
    Column<std::uint8_t, wang_batch_size> rows_{};
    std::size_t size_ = 0;
  };

  /// The coordinates of n queries, one query in each lane.
  struct Points {
    std::array<Real, 24> x;  ///< in the order of Query::x
    const Real& operator()(std::size_t time, std::size_t vertex, std::size_t k) const {
      return x[12 * time + 3 * vertex + k];
    }
  };
  template <class RowOfLane>
  Points points(const RowOfLane& row) const {
    Points points;
    for (std::size_t i = 0; i < 24; i += n) {
      for (std::size_t lane = 0; lane < n; ++lane) points.x[i + lane] = Real::load(queries_.x(row(lane)) + i);
      Real::transpose(&points.x[i]);
    }
    return points;
  }

  /// Calls visit(lane) for each lane that holds an element of a list with `size` elements. Lane k holds
  /// element first + k if the list has such an element.
  template <class Visit>
  static void for_lanes(std::size_t first, std::size_t size, const Visit& visit) {
    const std::size_t count = std::min<std::size_t>(n, size - first);
    for (std::size_t lane = 0; lane < count; ++lane) visit(lane);
  }

  /// The values of the lanes, as an array.
  static std::array<double, n> each(const Real& lanes) {
    std::array<double, n> numbers;
    lanes.store(numbers.data());
    return numbers;
  }
  static std::array<bool, n> each(const Mask& mask) {
    std::array<bool, n> truths;
    for (std::size_t lane = 0; lane < n; ++lane) truths[lane] = mask[lane];
    return truths;
  }

  /// Writes n zeros after the end of a list. Lanes that have no element load these zeros.
  template <class Numbers>
  static void pad(Numbers& numbers, std::size_t size) {
    std::fill_n(numbers.begin() + static_cast<std::ptrdiff_t>(size), n, 0);
  }

  /// Rejects the queries that a plane separates, and returns the other queries. A query with a coordinate
  /// that is not finite is neither rejected nor returned, and stays undecided.
  Rows reject_separated(const Rows& rows) {
    Rows left;
    for (std::size_t i = 0; i < rows.size(); i += n) {
      const Points x = points([&](std::size_t lane) { return rows[i + lane]; });
      const auto separated =
          each(Mask(detail::separated_across_axis<kind>(x) | detail::separated_across_diagonal<kind>(x)));
      // Four sums are faster than one, because each addition must wait for the previous addition to the same
      // sum.
      std::array<Real, 4> sums{x.x[0], x.x[1], x.x[2], x.x[3]};
      for (std::size_t c = 4; c < 24; ++c) sums[c % 4] += x.x[c];
      const auto finite = each(Mask(abs((sums[0] + sums[1]) + (sums[2] + sums[3])) < Real(HUGE_VAL)));
      for_lanes(i, rows.size(), [&](std::size_t lane) {
        const std::size_t row = rows[i + lane];
        verdicts_[row] =
            finite[lane] && separated[lane] ? Verdict::rejected(Rejection::planes) : undecided_verdict;
        left.add_if(finite[lane] && !separated[lane], row);
      });
    }
    return left;
  }

  /// Rejects the pairs whose |F| stays above μ, as keeps_clear() and solve_cubic() do. For the other pairs,
  /// stores F and the bounds W and B (see Pair), except for pairs that need another frame or another order of
  /// end points.
  void reject_clear(const Rows& rows) {
    for (std::size_t i = 0; i < rows.size(); i += n) {
      Pair<kind, Real> pair;
      form_vectors(points([&](std::size_t lane) { return rows[i + lane]; }), pair);
      const Cubic<Real> F = coplanarity(pair);
      // If the sum of the squares of all components is in range, all vectors of the pair are finite.
      const Mask plain = in_range(detail::sum_of_squares(pair)) & detail::take_bound(pair, given_);
      Mask clear = plain & (clearance(F) > paper_tolerances(pair.B).mu);
      if (!given_) clear = clear | detail::keeps_clear(pair, F, PaperTolerances{});
      const auto is_plain = each(plain);
      const auto is_clear = each(clear);
      const std::array columns{each(F.a), each(F.b), each(F.c), each(F.d), each(pair.W), each(pair.B)};
      for_lanes(i, rows.size(), [&](std::size_t lane) {
        const std::size_t row = rows[i + lane];
        if (is_clear[lane]) verdicts_[row] = Verdict::rejected(Rejection::no_root);
        for (std::size_t c = 0; c < columns.size(); ++c) columns_[c][left_.size()] = columns[c][lane];
        left_.add_if(!is_clear[lane] && is_plain[lane], row);
      });
    }
  }

  /// The coplanarity cubic F and the bounds W and B (see Pair) of n queries, one query in each lane.
  struct Polynomial {
    Cubic<Real> F;
    Real W, B;
  };
  /// The Polynomial of n queries. The caller chooses the n queries: take(column) returns the numbers of these
  /// queries from a column.
  template <class Take>
  Polynomial polynomial(const Take& take) const {
    return {{take(columns_[0]), take(columns_[1]), take(columns_[2]), take(columns_[3])},
            take(columns_[4]),
            take(columns_[5])};
  }
  /// The Polynomial of n queries; lane k has the query with row left_[place(k)].
  template <class PlaceOfLane>
  Polynomial polynomial_at(const PlaceOfLane& place) const {
    return polynomial([&](const auto& column) {
      return Real::gather([&](std::size_t lane) { return column[place(lane)]; });
    });
  }

  /// Finds the roots as solve_cubic() does, but does not refine them. The candidates of a query are its roots
  /// in ascending order, then t = 1 if |F| <= μ at t = 1.
  void find_roots() {
    for (auto& column : columns_) pad(column, left_.size());
    for (std::size_t i = 0; i < left_.size(); i += n) {
      const auto [F, W, B] = polynomial([i](const auto& column) { return Real::load(&column[i]); });
      const Real mu = paper_tolerances(B).mu;
      const auto critical = detail::critical_times(F);
      const std::array<Real, 4> time{Real(0), critical.first, critical.second, Real(1)};
      const std::array<Real, 4> value{F.d, F(time[1]), F(time[2]), F(time[3])};
      const std::array<Mask, 3> exists{Mask(true), critical.any, critical.two};
      std::array<std::array<double, n>, 3> contributions;
      for (std::size_t k = 0; k < 3; ++k)
        contributions[k] =
            each(detail::contribution<Real>({time[k], time[k + 1], value[k], value[k + 1]}, exists[k], mu));
      const auto at_end = each(Mask(abs(value[3]) <= mu));
      const std::array times{each(time[0]), each(time[1]), each(time[2]), each(time[3])};
      const std::array values{each(value[0]), each(value[1]), each(value[2]), each(value[3])};
      for_lanes(i, left_.size(), [&](std::size_t lane) {
        const std::size_t place = i + lane;
        for (std::size_t k = 0; k < 3; ++k) {
          const auto found = static_cast<detail::Contribution>(contributions[k][lane]);
          if (found == detail::nothing) continue;
          if (found == detail::root_between)
            add_bracket({times[k][lane], times[k + 1][lane], values[k][lane], values[k + 1][lane]}, place);
          add_candidate(place, times[found == detail::left_node ? k : k + 1][lane], true);
        }
        if (at_end[lane]) add_candidate(place, 1, false);
      });
    }
  }

  void add_bracket(const detail::Bracket<double>& bracket, std::size_t place) {
    brackets_[0][bracket_count_] = bracket.lo;
    brackets_[1][bracket_count_] = bracket.hi;
    brackets_[2][bracket_count_] = bracket.f_lo;
    brackets_[3][bracket_count_] = bracket.f_hi;
    bracket_place_[bracket_count_] = static_cast<std::uint8_t>(place);
    bracket_candidate_[bracket_count_++] = static_cast<std::uint16_t>(candidate_count_);
  }
  void add_candidate(std::size_t place, double time, bool is_root) {
    candidate_place_[candidate_count_] = static_cast<std::uint8_t>(place);
    candidate_is_root_[candidate_count_] = is_root;
    candidate_time_[candidate_count_++] = time;
  }

  /// Refines the roots in all brackets, as detail::refine_root() does.
  void refine_roots() {
    for (auto& column : brackets_) pad(column, bracket_count_);
    pad(bracket_place_, bracket_count_);
    for (std::size_t i = 0; i < bracket_count_; i += n) {
      const Polynomial known = polynomial_at([&](std::size_t lane) { return bracket_place_[i + lane]; });
      const detail::Bracket<Real> bracket{Real::load(&brackets_[0][i]), Real::load(&brackets_[1][i]),
                                          Real::load(&brackets_[2][i]), Real::load(&brackets_[3][i])};
      const auto roots = each(detail::refined(known.F, bracket, paper_tolerances(known.B).mu,
                                              Real::gather([](std::size_t lane) {
                                                return static_cast<double>(lane);
                                              }) < Real(static_cast<double>(bracket_count_ - i))));
      for_lanes(i, bracket_count_,
                [&](std::size_t lane) { candidate_time_[bracket_candidate_[i + lane]] = roots[lane]; });
    }
  }

  /// Applies the area, height and barycentric tests to all candidates. For a candidate that does not pass
  /// these tests, finds out whether the candidate needs vertex-edge tests.
  void test_candidates() {
    pad(candidate_place_, candidate_count_);
    pad(candidate_time_, candidate_count_);
    for (std::size_t i = 0; i < candidate_count_; i += n) {
      const auto place = [&](std::size_t lane) { return candidate_place_[i + lane]; };
      Pair<kind, Real> pair;
      form_vectors(points([&](std::size_t lane) { return left_[place(lane)]; }), pair);
      const Polynomial known = polynomial_at(place);
      pair.W = known.W;
      pair.B = known.B;
      const Real t = Real::load(&candidate_time_[i]);
      const auto tol = paper_tolerances(known.B);
      const Configuration<kind, Real> configuration(pair, t);
      const Mask well_shaped = configuration.well_shaped(tol);
      const Mask passes = well_shaped & configuration.inside();
      const auto accepted = each(passes);
      const auto excluded =
          each(Mask(well_shaped & !passes & excludes(pair, known.F, configuration, t, tol)));
      for_lanes(i, candidate_count_, [&](std::size_t lane) {
        candidate_passes_[i + lane] = accepted[lane];
        candidate_is_excluded_[i + lane] = excluded[lane];
      });
    }
  }

  /// In each lane, the result of excludes_collision() with VeCulling::per_root for the lane's query.
  static Mask excludes(const Pair<kind, Real>& pair, const Cubic<Real>& F,
                       const Configuration<kind, Real>& configuration, const Real& t,
                       const Tolerances<Real>& tol) {
    const auto eps = epsilon<Real>();
    const Real threshold = detail::culling_threshold(tol.mu, eps, pair.B);
    const Real slope = abs(F.slope(t));
    Real h = 4 * threshold;
    const Mask is_steep = h < slope;
    h = h / slope;
    Mask bracketed = detail::brackets_root(F, t, h, threshold);
    for (int i = 0; i < detail::culling_doublings && any_of(is_steep & !bracketed); ++i) {
      h = select(bracketed, h, Real(h * 2));
      bracketed = bracketed | detail::brackets_root(F, t, h, threshold);
    }
    const Real spread = detail::weight_spread(configuration, pair.W, h);
    return is_steep & bracketed & !(h > Real(1)) & detail::outside(configuration, spread, eps, pair.B);
  }

  /// Makes the verdict on each query from its candidates, as detail::wang_tests() does before the vertex-edge
  /// tests.
  void conclude() {
    std::size_t next = 0;
    for (std::size_t place = 0; place < left_.size(); ++place) {
      const std::size_t first = next;
      while (next < candidate_count_ && candidate_place_[next] == place) ++next;
      verdicts_[left_[place]] = verdict(first, next);
    }
  }

  /// The verdict on a query with the candidates from `first` to `end` - 1.
  [[nodiscard]] Verdict verdict(std::size_t first, std::size_t end) const {
    bool culled = true;
    for (std::size_t i = first; i < end; ++i) {
      if (candidate_passes_[i]) return Verdict::accepted(Stage::proximity, candidate_time_[i]);
      culled = culled && (!candidate_is_root_[i] || candidate_is_excluded_[i]);
    }
    if (!culled) return undecided_verdict;
    return Verdict::rejected(first == end || !candidate_is_root_[first] ? Rejection::no_root
                                                                        : Rejection::culled);
  }

  static constexpr std::size_t most_brackets = 3 * wang_batch_size;
  static constexpr std::size_t most_candidates = 4 * wang_batch_size;

  QueryRows queries_;
  Verdict* verdicts_;
  std::optional<double> given_;
  Rows left_;  ///< the rows of queries whose F may have a root; a "place" is an index in this list
  std::array<Column<double, wang_batch_size>, 6> columns_;  ///< by place: a, b, c, d of F, then W and B
  std::array<Column<double, most_brackets>, 4> brackets_;
  Column<std::uint8_t, most_brackets> bracket_place_;
  Column<std::uint16_t, most_brackets> bracket_candidate_;
  std::size_t bracket_count_ = 0;
  Column<std::uint8_t, most_candidates> candidate_place_;
  Column<bool, most_candidates> candidate_is_root_, candidate_passes_, candidate_is_excluded_;
  Column<double, most_candidates> candidate_time_;
  std::size_t candidate_count_ = 0;
};

template <int n>
void decide_batch(const QueryRows& queries, Verdict* verdicts, const std::optional<double>& given) {
  std::size_t looked_at = 0;
  for_each_kind_of_meshes(
      [&]<Kind kind>() { looked_at += WangLanes<n, kind>(queries, verdicts, given).run(); });
  if (looked_at == queries.size()) return;
  for (std::size_t i = 0; i < queries.size(); ++i)
    if (!is_of_meshes(queries.kind(i))) verdicts[i] = undecided_verdict;
}

}  // namespace nearmiss

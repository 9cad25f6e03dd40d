// The certified filter for many queries of one kind at once. It does the arithmetic of step_part.hpp in
// lanes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include "oracle/filter/batch_look.hpp"
#include "oracle/filter/filter.hpp"
#include "oracle/filter/instruction_sets.hpp"
#include "oracle/filter/neighbours.hpp"
#include "oracle/filter/planes.hpp"
#include "oracle/filter/step_part.hpp"
#include "oracle/filter/turn.hpp"

namespace nearmiss::certified {

/// Processes the queries in three stages: tests by boxes and moving planes; a test of the sign of F, the
/// coplanarity cubic; a search in parts of the step. Each stage processes the queries that are still
/// undecided, n of them side by side in n lanes. The last stage is a simpler version of ContactSearch, and
/// leaves difficult queries undecided. The results in a lane depend only on the query in this lane, so the
/// number n of lanes changes no answer.
template <int n, Kind kind>
class BatchFilter {
 public:
  BatchFilter(const QueryRows& queries, double caution, const QueryRows& ahead)
      : queries_(queries), ahead_(ahead), caution_(caution) {}

  /// Processes the queries of the kind `kind` among at most batch_size queries. Sets stages[i] if query i is
  /// decided, and leaves stages[i] `undecided` otherwise. If `times` is not null, also sets times[i] for each
  /// query i for which it finds two neighbouring doubles around the first contact.
  void run(FilterStage* stages, KnownTime* times) {
    const Rows all(queries_.size(), [&](std::size_t q) { return queries_.kind(q) == kind; });
    const Rows crossing = cull_by_planes(all, stages);
    const Rows unsure = cull_by_sign(crossing, stages);
    prepare_weights(unsure);
    asks_first_ = times != nullptr;
    search(unsure, stages);
    if (asks_first_) find_neighbours(unsure, times);
  }

 private:
  using Real = Lanes<n>;
  using Word = DoubleWordOf<Real>;
  using Mask = typename Real::Mask;
  using Turn = certified::Turn<n, kind>;
  using OfBatch = std::array<double, batch_size + n>;  ///< one number for each query
  static constexpr std::size_t weight_count = has_triangle(kind) ? 3 : 4;

  /// A list of the indices of some queries. Packs of n indices are processed together.
  class Rows {
   public:
    Rows() = default;
    /// Selects the indices below `count` for which `wanted` holds.
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
    /// Adds an index to the list if the index is wanted. The code has no branch, because the processor could
    /// not predict the branch.
    void add_if(bool wanted, std::size_t row) {
      rows_[size_] = static_cast<std::uint8_t>(row);
      size_ += wanted ? 1 : 0;
    }
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] std::size_t operator[](std::size_t i) const { return rows_[i]; }
    /// The n indices from position `first` of the list on. Indices beyond the end of the list are arbitrary,
    /// and their lanes are ignored.
    [[nodiscard]] const std::uint8_t* pack(std::size_t first) const { return rows_.data() + first; }

   private:
    std::array<std::uint8_t, batch_size + n> rows_{};
    std::size_t size_ = 0;
  };

  template <class Visit>
  static void for_lanes(const typename Real::Integers& bits, std::size_t count, const Visit& visit) {
    std::array<std::int64_t, n> numbers;
    std::memcpy(numbers.data(), &bits, sizeof(bits));
    for (std::size_t l = 0; l < std::min<std::size_t>(n, count); ++l) visit(l, numbers[l]);
  }

  /// The points of n queries, one query in each lane.
  struct PointLanes {
    std::array<Real, 24> x;  ///< in the order of Query::x
    const Real& operator()(std::size_t time, std::size_t vertex, std::size_t k) const {
      return x[12 * time + 3 * vertex + k];
    }
  };
  [[nodiscard]] PointLanes points(const std::uint8_t* rows) const {
    PointLanes points;
    for (std::size_t i = 0; i < 24; i += n) {
      Real* const columns = &points.x[i];
      for (std::size_t l = 0; l < n; ++l) columns[l] = Real::load(queries_.x(rows[l]) + i);
      Real::transpose(columns);
    }
    return points;
  }

  /// Prefetches a query into the nearest cache, line by line.
  static void fetch(const double* x) {
    for (std::size_t c = 0; c < 24; c += 8) __builtin_prefetch(x + c);
    __builtin_prefetch(x + 23);
  }

  /// The lanes in which the boxes that the primitives sweep do not meet. box.hpp says why this test is exact.
  static Mask boxes_apart(const PointLanes& x) {
    constexpr std::size_t middle = split(kind);
    Mask apart{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto range = [&](std::size_t first, std::size_t last) {
        Real lo = min(x(0, first, k), x(1, first, k));
        Real hi = max(x(0, first, k), x(1, first, k));
        for (std::size_t v = first + 1; v < last; ++v) {
          lo = min(lo, min(x(0, v, k), x(1, v, k)));
          hi = max(hi, max(x(0, v, k), x(1, v, k)));
        }
        return std::pair{lo, hi};
      };
      const auto [lo_a, hi_a] = range(0, middle);
      const auto [lo_b, hi_b] = range(middle, 4);
      apart = apart | (lo_a > hi_b) | (lo_b > hi_a);
    }
    return apart;
  }

  Rows cull_by_planes(const Rows& rows, FilterStage* stages) const {
    Rows left;
    for (std::size_t i = 0; i < rows.size(); i += n) {
      for (std::size_t l = 0; l < n; ++l) fetch(ahead_.x(rows[i + l]));
      const PointLanes x = points(rows.pack(i));
      const Mask apart = separated_across_axes<kind>(x) | separated_across_diagonals<kind>(x);
      // Four partial sums do not depend on each other, so the processor can compute them at the same time.
      // The total is finite only if all coordinates are finite.
      std::array<Real, 4> sums{x.x[0], x.x[1], x.x[2], x.x[3]};
      for (std::size_t c = 4; c < 24; c += 4)
        for (std::size_t k = 0; k < 4; ++k) sums[k] += x.x[c + k];
      const Mask finite = abs((sums[0] + sums[1]) + (sums[2] + sums[3])) < HUGE_VAL;
      // The stages for the codes 0 to 4. Code 0: a coordinate is not finite. Code 1: neither the test of the
      // planes nor the test of the boxes separates the primitives. Code 2: only the test of the planes
      // separates them. Code 3: only the test of the boxes separates them. Code 4: both tests separate them.
      constexpr std::array stage_of{FilterStage::undecided, FilterStage::undecided, FilterStage::planes,
                                    FilterStage::boxes, FilterStage::boxes};
      constexpr int unsure = 1;
      for_lanes(finite.as(unsure) + (finite & apart).as(1) + (finite & boxes_apart(x)).as(2), rows.size() - i,
                [&](std::size_t l, std::int64_t code) {
                  const std::size_t row = rows[i + l];
                  stages[row] = stage_of[static_cast<std::size_t>(code)];
                  left.add_if(code == unsure, row);
                });
    }
    return left;
  }

  Rows cull_by_sign(const Rows& rows, FilterStage* stages) {
    Rows left;
    for (std::size_t i = 0; i < rows.size(); i += n) {
      const StepPart<Real> p = whole_step<Real>(points(rows.pack(i)));
      auto F = coplanarity(p.a, p.b, p.c);
      F.error = caution_ * F.error;
      const auto [positive, negative] = certain_signs(F.b, F.error);
      constexpr int one_sign = 1;
      std::array<std::array<double, n>, 5> f;
      for (std::size_t c = 0; c < 4; ++c) F.b[c].store(f[c].data());
      F.error.store(f[4].data());
      for_lanes((positive | negative).as(one_sign), rows.size() - i, [&](std::size_t l, std::int64_t code) {
        const std::size_t row = rows[i + l];
        stages[row] = code == one_sign ? FilterStage::one_sign : FilterStage::undecided;
        if (code == one_sign) return;
        for (std::size_t c = 0; c < 5; ++c) F_[c][left.size()] = f[c][l];
        left.add(row);
      });
    }
    return left;
  }

  /// Computes and stores the weights in the component in which the normal is largest at t = 1/2.
  void prepare_weights(const Rows& rows) {
    for (std::size_t i = 0; i < rows.size(); i += n) {
      const StepPart<Real> whole = whole_step<Real>(points(rows.pack(i)));
      const auto twice_middle = [](const Motion<Real>& m) { return m.start + m.end; };
      const Turn turn(twice_middle(whole.x21), twice_middle(whole.x31), twice_middle(whole.a));
      const Weights<Real> weights = turn.weights(whole);
      for (std::size_t w = 0; w < weight_count; ++w) {
        for (std::size_t c = 0; c < 3; ++c) weights.w[w].b[c].store(&W_[4 * w + c][i]);
        (caution_ * weights.w[w].error).store(&W_[4 * w + 3][i]);
      }
    }
  }

  using Quadratics = std::array<Bernstein<Real, 3>, weight_count>;
  using Look = certified::Look<n>;

  /// F and the weights of n queries. `take` reads n numbers, one for each query, from one of the arrays in F_
  /// and W_.
  template <class Take>
  std::pair<Bernstein<Real, 4>, Quadratics> polynomials(const Take& take) const {
    const Bernstein<Real, 4> F{{take(F_[0]), take(F_[1]), take(F_[2]), take(F_[3])}, take(F_[4])};
    Quadratics weights;
    for (std::size_t w = 0; w < weight_count; ++w)
      weights[w] = {{take(W_[4 * w]), take(W_[4 * w + 1]), take(W_[4 * w + 2])}, take(W_[4 * w + 3])};
    return {F, weights};
  }

  /// A part of a query's step; `place` is the query's index in the list of searched queries.
  struct PendingPart {
    double lo, hi;
    std::uint8_t place;
    std::uint8_t depth;
  };
  struct PendingParts {
    static constexpr std::size_t room = 4 * batch_size;
    std::array<PendingPart, room + n> parts;
    std::size_t count = 0;

    /// Adds the part [lo, hi] of `whole` if that part is not empty. Returns false if the list of parts is
    /// full, or if `whole` has been divided too often.
    bool push(const PendingPart& whole, double lo, double hi) {
      constexpr std::uint8_t deepest = 6;
      if (whole.depth == deepest || count == room) return false;
      if (lo < hi) parts[count++] = {lo, hi, whole.place, static_cast<std::uint8_t>(whole.depth + 1)};
      return true;
    }
  };

  void search(const Rows& rows, FilterStage* stages) {
    PendingParts parts;
    PendingParts next;
    if (asks_first_)
      for (OfBatch* const column : {&first_lo_, &unclear_from_}) std::fill_n(column->begin(), rows.size(), 1);
    for (std::size_t i = 0; i < rows.size(); ++i) stages[rows[i]] = FilterStage::weights;
    look_at_steps(rows, stages, next);
    while (next.count > 0) {
      std::copy_n(next.parts.begin(), next.count, parts.parts.begin());
      parts.count = std::exchange(next.count, 0);
      std::fill_n(parts.parts.begin() + parts.count, n, PendingPart{0, 1, 0, 0});
      look_at_parts(parts, rows, stages, next);
    }
    std::fill_n(precise_.parts.begin() + precise_.count, n, PendingPart{0, 1, 0, 0});
    for (std::size_t i = 0; i < precise_.count; i += n) look_precisely(i, rows, stages, next);
  }

  void look_at_steps(const Rows& rows, FilterStage* stages, PendingParts& next) {
    for (std::size_t i = 0; i < rows.size(); i += n) {
      const auto [F, weights] = polynomials([&](const OfBatch& c) { return Real::load(&c[i]); });
      const auto whole = [&](std::size_t l) {
        return PendingPart{0, 1, static_cast<std::uint8_t>(i + l), 0};
      };
      take_over(look(F, weights, Real(0), Real(1), asks_first_), rows.size() - i, whole, rows, stages, next);
    }
  }

  void look_at_parts(const PendingParts& parts, const Rows& rows, FilterStage* stages, PendingParts& next) {
    for (std::size_t i = 0; i < parts.count; i += n) {
      const PendingPart* const pack = &parts.parts[i];
      const auto [F, weights] = polynomials(
          [&](const OfBatch& c) { return Real::gather([&](std::size_t l) { return c[pack[l].place]; }); });
      const Real lo = Real::gather([&](std::size_t l) { return pack[l].lo; });
      const Real hi = Real::gather([&](std::size_t l) { return pack[l].hi; });
      const auto part = [&](std::size_t l) { return pack[l]; };
      take_over(look(F, weights, lo, hi, asks_first_), parts.count - i, part, rows, stages, next);
    }
  }

  /// Near some roots of F, double precision is not enough to find the signs of the weights. Computes the
  /// weights near these roots in double words.
  void look_precisely(std::size_t i, const Rows& rows, FilterStage* stages, PendingParts& next) {
    const PendingPart* const pack = &precise_.parts[i];
    const auto take = [&](const OfBatch& c) {
      return Real::gather([&](std::size_t l) { return c[pack[l].place]; });
    };
    std::array<std::uint8_t, n> packed;
    for (std::size_t l = 0; l < n; ++l) packed[l] = static_cast<std::uint8_t>(rows[pack[l].place]);
    const StepPart<Word> whole = whole_step<Word>(points(packed.data()));
    const Bernstein<Real, 4> F{{take(F_[0]), take(F_[1]), take(F_[2]), take(F_[3])}, take(F_[4])};
    const Neighbours<Real> near =
        neighbours_of_root(whole, F, Real::gather([&](std::size_t l) { return pack[l].lo; }),
                           Real::gather([&](std::size_t l) { return pack[l].hi; }));
    const auto part = [&](const Motion<Word>& motion) { return part_of(motion, near.lo, near.hi); };
    const StepPart<Word> p{
        0, 1, part(whole.a), part(whole.b), part(whole.c), part(whole.x21), part(whole.x31)};
    const auto at = [&](const Motion<Word>& m) {
      return Vec<Real>{m.start[0].hi, m.start[1].hi, m.start[2].hi};
    };
    const Weights<Word> weights = Turn(at(p.x21), at(p.x31), at(p.a)).weights(p);
    Quadratics approximate_weights;
    for (std::size_t w = 0; w < weight_count; ++w)
      approximate_weights[w] = {{weights.w[w].b[0].hi, weights.w[w].b[1].hi, weights.w[w].b[2].hi},
                                weights.w[w].error};
    const auto signs =
        weight_signs(approximate_weights, [](const auto& w) { return certain_signs(w.b, w.error); });
    Look seen;
    seen.left = near.lo;
    seen.right = near.hi;
    const Mask agree = near.hold & signs.agree;
    seen.outcome = agree.as(Look::collision | Look::bracket) |
                   (!(agree | (near.hold & signs.opposed))).as(Look::unknown);
    take_over(
        seen, precise_.count - i, [&](std::size_t l) { return pack[l]; }, rows, stages, next);
  }

  /// Takes over the results for n parts: sets stages and first contacts, and adds to `next` the parts that
  /// must be examined next.
  template <class PartOfLane>
  void take_over(const Look& seen, std::size_t lanes, const PartOfLane& part_of_lane, const Rows& rows,
                 FilterStage* stages, PendingParts& next) {
    std::array<double, n> left;
    std::array<double, n> right;
    seen.left.store(left.data());
    seen.right.store(right.data());
    for_lanes(seen.outcome, lanes, [&](std::size_t l, std::int64_t outcome) {
      if (outcome == 0) return;
      const PendingPart part = part_of_lane(l);
      FilterStage& stage = stages[rows[part.place]];
      if ((outcome & Look::collision) != 0) stage = FilterStage::sign_change;
      if (asks_first_ && (outcome & Look::bracket) != 0 && left[l] < first_lo_[part.place]) {
        first_lo_[part.place] = left[l];
        first_hi_[part.place] = right[l];
      }
      if (stage == FilterStage::sign_change && !(asks_first_ && part.lo < first_lo_[part.place])) return;
      const auto leave_unclear = [&] {
        if (stage != FilterStage::sign_change) stage = FilterStage::undecided;
        if (asks_first_) unclear_from_[part.place] = std::min(unclear_from_[part.place], part.lo);
      };
      const auto push = [&](double lo, double hi) {
        if (!next.push(part, lo, hi)) leave_unclear();
      };
      if ((outcome & Look::unknown) != 0) leave_unclear();
      if ((outcome & Look::precise) != 0 && (caution_ > 1 || !precise_.push(part, left[l], right[l])))
        leave_unclear();
      if ((outcome & Look::before) != 0) push(part.lo, left[l]);
      if ((outcome & Look::middle) != 0) push(left[l], right[l]);
      if ((outcome & Look::behind) != 0) push(right[l], part.hi);
    });
  }

  /// For each query with a contact and no unclear part before it, finds the neighbouring doubles around the
  /// first contact.
  void find_neighbours(const Rows& rows, KnownTime* times) const {
    const Rows places(rows.size(),
                      [&](std::size_t place) { return first_lo_[place] < unclear_from_[place]; });
    for (std::size_t i = 0; i < places.size(); i += n) {
      const auto take = [&](const OfBatch& column) {
        return Real::gather([&](std::size_t l) { return column[places[i + l]]; });
      };
      std::array<std::uint8_t, n> packed;
      for (std::size_t l = 0; l < n; ++l) packed[l] = static_cast<std::uint8_t>(rows[places[i + l]]);
      const Bernstein<Real, 4> F{{take(F_[0]), take(F_[1]), take(F_[2]), take(F_[3])}, take(F_[4])};
      const Neighbours<Real> near = neighbours_of_root(whole_step<DoubleWordOf<Real>>(points(packed.data())),
                                                       F, take(first_lo_), take(first_hi_));
      std::array<double, n> lo;
      std::array<double, n> hi;
      near.lo.store(lo.data());
      near.hi.store(hi.data());
      for_lanes(near.hold.as(1), places.size() - i, [&](std::size_t l, std::int64_t holds) {
        if (holds != 0) times[rows[places[i + l]]] = {{lo[l], hi[l]}, true};
      });
    }
  }

  QueryRows queries_, ahead_;
  double caution_;  ///< all error bounds are multiplied by this factor, which is at least 1
  bool asks_first_ = false;
  // These arrays are indexed like the list of searched queries. They are longer than this list can be,
  // because the last n lanes may reach beyond its end.
  std::array<OfBatch, 5> F_;                 ///< Bernstein coefficients and error of F
  std::array<OfBatch, 4 * weight_count> W_;  ///< coefficients and error of each weight
  PendingParts precise_;                     ///< parts for look_precisely()
  // For each query, [first_lo_, first_hi_] is the bracket around the earliest contact found so far.
  // unclear_from_ is the beginning of the first unclear part, or 1 if no part is unclear.
  OfBatch first_lo_, first_hi_, unclear_from_;
};

template <int n>
void filter_batch(const QueryRows& queries, double caution, FilterStage* stages, KnownTime* times,
                  const QueryRows& ahead) {
  std::fill_n(stages, queries.size(), FilterStage::undecided);
  for_each_kind_of_meshes(
      [&]<Kind kind>() { BatchFilter<n, kind>(queries, caution, ahead).run(stages, times); });
}

}  // namespace nearmiss::certified

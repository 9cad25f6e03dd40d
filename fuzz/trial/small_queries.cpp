#include "fuzz/trial/small_queries.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

#include "ccd/query/error.hpp"
#include "fuzz/families/classify.hpp"
#include "fuzz/random.hpp"
#include "fuzz/subjects/isolation/plugin_file.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {

namespace {

constexpr std::size_t paths = 12;  // path i is coordinate i at t = 0 and coordinate i + 12 at t = 1
constexpr std::array values{0, 1, -1, 2};
constexpr int most_numbers = 3;  // the list has all queries with at most this many nonzero numbers
using Integers = std::array<int, 24>;

/// A symmetry of queries: coordinate i of the copy is sign[i] times coordinate from[i] of the original.
struct Symmetry {
  std::array<std::size_t, 24> from;
  Integers sign;
};

/// The permutations of the vertices that do not change the primitives.
std::vector<std::array<std::size_t, 4>> vertex_orders(Kind kind) {
  std::vector<std::array<std::size_t, 4>> orders;
  std::array<std::size_t, 4> order{0, 1, 2, 3};
  const bool edges = !has_triangle(kind);
  do {
    const bool same_pairs = order[0] / 2 == order[1] / 2;
    if (edges ? same_pairs : order[0] == 0) orders.push_back(order);
  } while (std::next_permutation(order.begin(), order.end()));
  return orders;
}

std::vector<Symmetry> symmetries(Kind kind) {
  std::vector<Symmetry> all;
  for (const auto& vertices : vertex_orders(kind)) {
    std::array<std::size_t, 3> axes{0, 1, 2};
    do {
      for (unsigned mirrored = 0; mirrored < 8; ++mirrored)
        for (const std::size_t reversed : {0U, 1U}) {
          Symmetry& made = all.emplace_back();
          for (std::size_t i = 0; i < 24; ++i) {
            const std::size_t k = axes[i % 3];
            made.from[i] = paths * (i / paths ^ reversed) + 3 * vertices[i % paths / 3] + k;
            made.sign[i] = (mirrored >> k & 1U) != 0 ? -1 : 1;
          }
        }
    } while (std::next_permutation(axes.begin(), axes.end()));
  }
  return all;
}

/// The place of an integer in the order that decides which symmetric copy comes first: 0, 1, -1, 2, -2.
constexpr int rank(int value) { return value > 0 ? 2 * value - 1 : -2 * value; }

/// Whether the copy of x under a symmetry has only numbers that the list uses. The list does not use -2.
bool is_listed(const Integers& x, const Symmetry& symmetry) {
  for (std::size_t i = 0; i < x.size(); ++i)
    if (symmetry.sign[i] * x[symmetry.from[i]] == -2) return false;
  return true;
}

/// Whether no symmetric copy comes before x. Copies with the number -2 do not count, because the list cannot
/// contain them.
bool is_first_copy(const Integers& x, const std::vector<Symmetry>& symmetries) {
  return std::none_of(symmetries.begin(), symmetries.end(), [&](const Symmetry& symmetry) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      const int difference = rank(symmetry.sign[i] * x[symmetry.from[i]]) - rank(x[i]);
      if (difference != 0) return difference < 0 && is_listed(x, symmetry);
    }
    return false;
  });
}

class Maker {
 public:
  explicit Maker(Kind kind) : kind_(kind), symmetries_(symmetries(kind)) {}

  std::vector<SmallQuery> run(bool apart) {
    extend(0, most_numbers);
    draw();
    if (apart) separate();
    std::sort(list_.begin(), list_.end(), [](const SmallQuery& a, const SmallQuery& b) {
      return std::tie(a.complexity, a.query.x, a.query.separation) <
             std::tie(b.complexity, b.query.x, b.query.separation);
    });
    decide_all();
    return std::move(list_);
  }

 private:
  void add() {
    Query query{.kind = kind_};
    std::copy(x_.begin(), x_.end(), query.x.begin());
    list_.push_back({query, complexity(query)});
  }

  /// Adds the queries whose paths before `path` are those in `x_`, and whose other paths together have at
  /// most `numbers` nonzero numbers (Complexity::numbers). A path is one coordinate of a vertex, at t = 0 and
  /// t = 1. Adds only the first of several symmetric copies.
  void extend(std::size_t path, int numbers) {
    if (path == paths) {
      if (is_first_copy(x_, symmetries_)) add();
      return;
    }
    for (const int start : values)
      for (const int end : values) {
        const int own = (start == 0 ? 0 : 1) + (end == 0 || end == start ? 0 : 1);
        if (own > numbers) continue;
        x_[path] = start;
        x_[paths + path] = end;
        extend(path + 1, numbers - own);
      }
    x_[path] = x_[paths + path] = 0;
  }

  /// Adds random queries: half of the coordinates are 0, and half of the paths are at rest.
  void draw() {
    constexpr std::uint64_t drawn = 4096;
    constexpr std::uint64_t stream = 0x5a11;  // a stream that no family uses
    for (std::uint64_t i = 0; i < drawn; ++i) {
      Random random(1, stream + static_cast<std::uint64_t>(kind_), i);
      const auto value = [&] {
        return random.one_in(2) ? 0 : values[static_cast<std::size_t>(random.integer(1, 3))];
      };
      for (std::size_t path = 0; path < paths; ++path) {
        x_[path] = value();
        x_[paths + path] = random.one_in(2) ? x_[path] : value();
      }
      add();
      if (list_.back().complexity.numbers <= most_numbers) list_.pop_back();  // the list has it already
    }
  }

  /// Replaces every query with four copies, which have the separations 1, 2, 1/2 and 1/4.
  void separate() {
    std::vector<SmallQuery> separated;
    for (const SmallQuery& each : list_)
      for (const double h : {1.0, 2.0, 0.5, 0.25}) {
        const Query query = with_separation(each.query, h);
        separated.push_back({query, complexity(query)});
      }
    list_ = std::move(separated);
  }

  /// Decides the queries, and removes those whose smallest distance is exactly h.
  void decide_all() {
    std::vector<Query> queries(list_.size());
    std::transform(list_.begin(), list_.end(), queries.begin(),
                   [](const SmallQuery& each) { return each.query; });
    std::vector<Decision> decisions(list_.size());
    decide(queries, decisions);
    std::vector<SmallQuery> decided;
    for (std::size_t i = 0; i < list_.size(); ++i) {
      list_[i].collision = decisions[i].collision;
      if (!decisions[i].is_tie) decided.push_back(list_[i]);
    }
    list_ = std::move(decided);
  }

  Kind kind_;
  std::vector<Symmetry> symmetries_;
  Integers x_{};
  std::vector<SmallQuery> list_;
};

template <Kind kind, bool apart>
const std::vector<SmallQuery>& list_of() {
  static const auto list = Maker(kind).run(apart);
  return list;
}

}  // namespace

const std::vector<SmallQuery>& small_queries(Kind kind, bool apart) {
  static const std::vector<SmallQuery> none;
  if (!is_of_meshes(kind)) return none;
  return with_kind(kind, [&]<Kind of>() -> const std::vector<SmallQuery>& {
    return apart ? list_of<of, true>() : list_of<of, false>();
  });
}

SmallFailures::SmallFailures(const Subject& subject, Kind kind, bool apart,
                             const std::function<void()>& check) {
  // The first batches are smaller, because each query may end the subject's process.
  constexpr std::size_t largest_batch = 64;
  const Judge judge(subject);
  const std::span list(small_queries(kind, apart));
  std::size_t first = 0;
  for (std::size_t batch = 1; first < list.size(); batch = std::min(2 * batch, largest_batch)) {
    check();
    const auto asked = list.subspan(first, std::min(batch, list.size() - first));
    first += asked.size();
    try {
      ask(subject, judge, asked);
    } catch (const isolation::TrialError&) {
      throw;
    } catch (const Error&) {  // the subject refuses these or any further queries
      return;
    }
  }
}

void SmallFailures::ask(const Subject& subject, const Judge& judge, std::span<const SmallQuery> asked) {
  std::vector<Query> queries;
  for (const SmallQuery& each : asked) queries.push_back(each.query);
  std::vector<Verdict> verdicts(asked.size());
  subject.decide(queries, verdicts);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const bool is_right = verdicts[i].fault == Fault::none && verdicts[i].hit == asked[i].collision &&
                          std::isnan(verdicts[i].time);
    if (is_right) continue;
    if (auto failure = judge.failure(asked[i].query, verdicts[i]))
      simplest_.try_emplace({std::move(*failure), exoticness(asked[i].query, classify(asked[i].query))},
                            asked[i]);
  }
}

std::optional<SmallQuery> SmallFailures::simplest(const Failure& failure,
                                                  const std::optional<NoMoreExotic>& among) const {
  std::optional<SmallQuery> best;
  for (auto each = simplest_.lower_bound({failure, 0});
       each != simplest_.end() && each->first.first == failure; ++each)
    if ((!among || (*among)(each->second.query)) && (!best || each->second.complexity < best->complexity))
      best = each->second;
  return best;
}

}  // namespace nearmiss

#include "fuzz/families/search.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <exception>
#include <functional>
#include <memory>
#include <nlopt.hpp>
#include <optional>
#include <vector>

#include "ccd/elementary.hpp"
#include "fuzz/families/contacts.hpp"
#include "oracle/distance.hpp"
#include "oracle/oracle.hpp"
#include "reports/statistics/family.hpp"

namespace nearmiss {

namespace {

using Vector = Vector3<double>;

constexpr double usually_smallest = 1e-5;  // lower end of the range of sizes and speeds

/// A point of the search space: a contact, in the frame in which `base` is at rest at the origin, and a gap
/// between the primitives.
struct SearchPoint {
  Path q, r;
  Vector w;      ///< velocity of the first primitive's point of contact
  Vector place;  ///< α, β, time
  Vector gap;

  /// Visits all vectors, without the gap if the primitives must touch.
  template <class Visit>
  void visit(bool touching, const Visit& visit_vector) {
    for (Vector* v : {&q.start, &q.end, &r.start, &r.end, &w, &place}) visit_vector(*v);
    if (!touching) visit_vector(gap);
  }
};

Contact contact_of(Kind kind, const SearchPoint& m) {
  const auto clamped = [](double x) { return std::clamp(x, 0.0, 1.0); };
  Contact contact{{Vector::Zero(), Vector::Zero()},
                  m.q,
                  m.r,
                  clamped(m.place[0]),
                  clamped(m.place[1]),
                  clamped(m.place[2])};
  if (kind == Kind::vertex_triangle) contact.beta = std::min(contact.beta, 1 - contact.alpha);
  return contact;
}

/// Rounds to a grid on which `meet` is exact: vectors within 2^3 to multiples of 2^-22, weights and times to
/// multiples of 2^-10. Then no sum of products has more than 3 + 3 + 22 + 20 = 48 bits.
SearchPoint on_grid(SearchPoint m) {
  const auto round_to = [](double x, double unit) { return std::nearbyint(x / unit) * unit; };
  m.visit(true, [&](Vector& v) {
    for (double& c : v) c = round_to(std::clamp(c, -8.0, 8.0), 0x1p-22);
  });
  for (double& c : m.place) c = round_to(c, 0x1p-10);
  return m;
}

Query query_of(Kind kind, const SearchPoint& m) {
  Query query = meet(kind, contact_of(kind, m), m.w);
  for (int i = 0; i < split(kind); ++i) {
    query.set_start(i, query.start(i) + m.gap);
    query.set_end(i, query.end(i) + m.gap);
  }
  return query;
}

/// A number from lo to hi, uniform on a logarithmic scale.
double log_uniform(Random& random, double lo, double hi) {
  return exp2_of(random.uniform(log2_of(lo), log2_of(hi)));
}

/// Draws primitives with sizes and speeds from `smallest` to 1. Some are thin, move in their plane, or stay
/// near one plane; contact may be on a border or at an end of the step.
SearchPoint draw(Random& random, double smallest) {
  const auto some = [&](double lo, double hi) { return random.one_in(3) ? log_uniform(random, lo, hi) : hi; };
  const auto path = [&](const Vector& start, double speed) {
    return Path{start, start + random.vector(speed)};
  };
  // The order in which arguments and operands are computed is the compiler's choice, so each is drawn by itself.
  const auto some_path = [&] {
    const Vector start = random.vector(some(smallest, 1));
    return path(start, random.one_in(3) ? 0 : some(smallest, 1));
  };
  SearchPoint m;
  m.q = some_path();
  m.r = some_path();
  if (random.one_in(3)) {
    const double along = random.uniform(-1.5, 1.5);
    const double across = some(0.1 * smallest, 1e-1);
    m.r = {along * m.q.start + random.vector(across), along * m.q.end + random.vector(across)};
  }
  for (double& c : m.place) c = random.one_in(3) ? random.integer(0, 1) : random.uniform();
  m.w = random.vector(some(smallest, 1));
  if (random.one_in(3)) {
    const Vector along_q = random.uniform(-1, 1) * m.q.at(m.place[2]);
    const Vector along_r = random.uniform(-1, 1) * m.r.at(m.place[2]);
    m.w = along_q + along_r + random.vector(some(0.1 * smallest, 1e-1));
  }
  if (random.one_in(4)) {
    const double out_of_plane = log_uniform(random, 1e-4 * smallest * smallest, 1e-2);
    for (Vector* v : {&m.q.start, &m.q.end, &m.r.start, &m.r.end, &m.w}) (*v)[2] *= out_of_plane;
  }
  m.gap.setZero();
  return m;
}

/// log2 of six ratios. A contact is harder if one of them is smaller.
std::array<double, 6> hardness(Kind kind, const Contact& contact, const Vector& w) {
  const Vector q = contact.q.at(contact.time);
  const Vector r = contact.r.at(contact.time);
  const Vector n = q.cross(r);
  const Vector relative = w - contact.velocity(kind);
  const auto ratio = [](double a, double b) { return b > 0 ? log2_of(std::max(a / b, 0x1p-40)) : -40; };
  const double third = kind == Kind::vertex_triangle ? 1 - contact.alpha - contact.beta : 1;
  return {ratio(std::abs(n.dot(relative)), n.norm() * relative.norm()),
          ratio(n.norm(), q.norm() * r.norm()),
          ratio(std::min({contact.alpha, contact.beta, 1 - contact.alpha, 1 - contact.beta, third}), 1),
          ratio(std::min(q.norm(), r.norm()), std::max(q.norm(), r.norm())),
          ratio(std::min(contact.time, 1 - contact.time), 1),
          ratio(std::max(q.norm(), r.norm()), relative.norm())};
}

constexpr double nothing = -1e3;  ///< the objective of an unwanted query, far below all others

/// Maximises an objective from random starting points.
class Maximiser {
 public:
  using Objective = std::function<double(const SearchPoint&)>;  ///< infinity ends the search
  using Draw = std::function<SearchPoint()>;

  /// Step sizes are drawn between `finest_step` and 0.5.
  Maximiser(Random& random, bool touching, double finest_step, Objective objective)
      : random_(random), touching_(touching), finest_step_(finest_step), objective_(std::move(objective)) {}

  SearchPoint run(const Draw& draw_start) {
    constexpr int starts = 50;
    for (int i = 0; i < starts && !over(); ++i) show(draw_start());
    for (bool again = false; !over(); again = true) optimise(again);
    return best_;
  }

 private:
  [[nodiscard]] bool over() const {
    return shown_ >= search_evaluations || best_value_ == HUGE_VAL || error_ != nullptr;
  }

  double show(const SearchPoint& point) {
    ++shown_;
    const double value = objective_(point);
    if (value > best_value_) {
      best_value_ = value;
      best_ = point;
    }
    return value;
  }

  /// Starts at the best point so far, or near it, with steps of a random size.
  void optimise(bool beside) {
    constexpr std::array algorithms{nlopt::LN_SBPLX, nlopt::LN_NELDERMEAD, nlopt::LN_BOBYQA};
    constexpr int evaluations = 300;
    const double step = log_uniform(random_, finest_step_, 0.5);
    SearchPoint start = best_;
    if (beside) start.visit(touching_, [&](Vector& v) { v += random_.vector(step); });
    std::vector<double> point;
    start.visit(touching_, [&](const Vector& v) { point.insert(point.end(), v.begin(), v.end()); });

    nlopt::opt optimiser(algorithms[static_cast<std::size_t>(random_.integer(0, 2))],
                         static_cast<unsigned>(point.size()));
    optimiser.set_max_objective(
        [](const std::vector<double>& x, std::vector<double>& /*gradient*/, void* self) {
          auto& maximiser = *static_cast<Maximiser*>(self);
          double value = nothing;
          try {
            value = maximiser.show(maximiser.point_at(x));
          } catch (...) {
            maximiser.error_ = std::current_exception();  // the optimiser would mistake it for its own
          }
          if (maximiser.over()) maximiser.optimiser_->force_stop();
          return std::min(value, 1e3);  // finite, because optimisers compute with it
        },
        this);
    optimiser_ = &optimiser;
    optimiser.set_initial_step(step);
    optimiser.set_maxeval(evaluations);
    optimiser.set_xtol_rel(1e-9);
    double value = 0;
    try {
      optimiser.optimize(point, value);
    } catch (const nlopt::forced_stop&) {       // the search is over
    } catch (const nlopt::roundoff_limited&) {  // steps became too small to change the value
    } catch (const std::runtime_error&) {       // the model of BOBYQA broke down
    }
    if (error_) std::rethrow_exception(error_);
  }

  [[nodiscard]] SearchPoint point_at(const std::vector<double>& x) const {
    SearchPoint point;
    point.gap.setZero();
    const double* from = x.data();
    point.visit(touching_, [&](Vector& v) {
      v = Vector(from[0], from[1], from[2]);
      from += 3;
    });
    return point;
  }

  Random& random_;
  bool touching_;
  double finest_step_;
  Objective objective_;
  nlopt::opt* optimiser_ = nullptr;
  int shown_ = 0;
  double best_value_ = -HUGE_VAL;
  SearchPoint best_;
  std::exception_ptr error_;  ///< thrown by the objective
};

/// The subject of a search, which is no longer asked when it has exceeded its time limit a few times.
class Searched {
 public:
  Searched(const Subject& subject, const Stop& stop) : subject_(subject), stop_(stop) {}

  [[nodiscard]] const Subject& operator*() const { return subject_; }
  [[nodiscard]] const Subject* operator->() const { return &subject_; }

  /// The answer to a query; nothing if the subject is not asked. Throws Stopped.
  std::optional<Verdict> ask(const Query& query) const {
    constexpr int most_late = 3;
    stop_.check();
    if (late_ >= most_late) return std::nullopt;
    const Verdict verdict = subject_.decide(query);
    if (verdict.fault == Fault::time) ++late_;
    return verdict;
  }

 private:
  const Subject& subject_;
  const Stop& stop_;
  mutable std::atomic<int> late_ = 0;
};

/// The largest distance of a subject's false positives: the bound that the subject claims, or wang's if it
/// claims none.
double reach(const Subject& subject, const Query& query) {
  const double claimed = subject.distance_bound(query);
  return std::isfinite(claimed) && claimed > 0 ? claimed : make_subject("wang")->distance_bound(query);
}

/// The smallest size of primitives; it is smaller than usual for a subject with a small reach.
double smallest_for(const Subject& subject, Random random, Kind kind) {
  const SearchPoint typical = draw(random, usually_smallest);
  return std::min(usually_smallest, 1e-3 * reach(subject, query_of(kind, typical)));
}

Query search_miss(const Searched& subject, Random& random, Kind kind) {
  std::array<double, 6> mixture{};
  for (double& weight : mixture) weight = random.one_in(2) ? random.uniform() : 0;
  const bool exactly = random.one_in(2);
  const auto placed = [&](const SearchPoint& m) { return exactly ? on_grid(m) : m; };
  const auto objective = [&](const SearchPoint& anywhere) {
    const SearchPoint m = placed(anywhere);
    const Query query = query_of(kind, m);
    if (!is_finite(query)) return nothing;
    const auto answer = subject.ask(query);
    if (!answer) return nothing;
    if (answer->fault == Fault::time) return HUGE_VAL;
    const bool hit = answer->hit;
    if (!(hit && exactly) && !collides(query)) return nothing;
    if (!hit) return HUGE_VAL;
    const double needed = subject->needed_tolerance(query);
    if (!std::isnan(needed)) return log2_of(needed);
    double sum = 0;
    const auto hard = hardness(kind, contact_of(kind, m), m.w);
    for (std::size_t i = 0; i < hard.size(); ++i) sum -= mixture[i] * hard[i];
    return sum;
  };
  const double smallest = exactly ? usually_smallest : smallest_for(*subject, random, kind);
  return query_of(
      kind, placed(Maximiser(random, true, smallest, objective).run([&] { return draw(random, smallest); })));
}

Query search_far(const Searched& subject, Random& random, Kind kind) {
  const auto objective = [&](const SearchPoint& m) {
    const Query query = query_of(kind, m);
    if (!is_finite(query)) return nothing;
    const auto answer = subject.ask(query);
    if (!answer) return nothing;
    if (answer->fault == Fault::time) return HUGE_VAL;
    if (!answer->hit) {
      const double needed = subject->needed_tolerance(query);
      return std::isnan(needed) ? -1 : -log2_of(needed);
    }
    if (collides(query)) return 0.0;
    const double bound = subject->claims_bound() ? subject->distance_bound(query) : reach(*subject, query);
    const double ratio = closest_ratio(query, bound);
    if (!subject->claims_bound()) return ratio;
    return ratio >= 1 && distance_exceeds(query, bound) ? HUGE_VAL : std::min(ratio, 1.0);
  };
  const double smallest = smallest_for(*subject, random, kind);
  return query_of(kind, Maximiser(random, false, smallest, objective).run([&] {
    SearchPoint m = draw(random, smallest);
    m.gap = random.vector(log_uniform(random, 1e-4, 2) * reach(*subject, query_of(kind, m)));
    return m;
  }));
}

/// A query of directed search takes as long as some thousand others. The subjects' times do not count,
/// because batches are small, and the search leaves the caches warm only for the subject that it searches.
Family search(std::string name, std::string about, std::function<Query(Random&, Kind)> make) {
  return {.name = std::move(name),
          .about = std::move(about),
          .make = std::move(make),
          .block_cases = 1,
          .timed = false};
}

}  // namespace

Family miss_search(const Subject& subject, const Stop& stop) {
  return search(std::string(miss_search_family) + subject.name(),
                "collisions that are nearly missed, by directed search",
                [searched = std::make_shared<Searched>(subject, stop)](Random& random, Kind kind) {
                  return search_miss(*searched, random, kind);
                });
}

Family far_search(const Subject& subject, const Stop& stop) {
  return search(std::string(far_search_family) + subject.name(), "far false positives, by directed search",
                [searched = std::make_shared<Searched>(subject, stop)](Random& random, Kind kind) {
                  return search_far(*searched, random, kind);
                });
}

}  // namespace nearmiss

#include "fuzz/scenes/plan.hpp"

#include <chrono>

#include "oracle/translation.hpp"

namespace nearmiss {

namespace {

using Clock = std::chrono::steady_clock;

std::uint64_t since(Clock::time_point start) {
  return static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - start).count());
}

/// The number of all pairs of a kind, with or without a common vertex.
std::uint64_t all_pairs(const MovingMesh& mesh, Kind kind) {
  const std::uint64_t edges = mesh.edges.size();
  if (has_triangle(kind)) return std::uint64_t{mesh.start.size()} * mesh.triangles.size();
  return edges == 0 ? 0 : edges * (edges - 1) / 2;
}

/// Receives the pairs of one part of a plan, and decides in batches what to do with each pair (PairFate).
class FateTeller {
 public:
  FateTeller(const MovingMesh& mesh, Kind kind, LeaveOut leave_out, const AskSink& ask,
             const DecidedSink& decided)
      : mesh_(mesh), leave_out_(leave_out), ask_(ask), decided_(decided) {
    asked_.kind = kind;
  }

  void take(const Candidate& candidate) {
    found_.push_back(candidate);
    if (found_.size() == batch_pairs) tell_fates();
  }

  /// The total time that this object has taken to decide what to do with the pairs, and to pass them on.
  [[nodiscard]] std::uint64_t nanoseconds() const { return nanoseconds_; }
  [[nodiscard]] Funnel finish() {
    tell_fates();
    return funnel_;
  }

 private:
  static constexpr std::size_t batch_pairs = 1000;

  void tell_fates() {
    const auto start = Clock::now();
    for (const Candidate& candidate : found_) {
      const Query query = make_query(mesh_, candidate);
      const auto [what, collides] =
          leave_out_ == LeaveOut::all ? fate(query) : std::pair(PairFate::asked, false);
      ++funnel_[what];
      funnel_.touching += collides ? 1 : 0;
      if (what == PairFate::asked) {
        asked_.candidates.push_back(candidate);
        asked_.queries.push_back(query);
      } else if (decided_) {
        decided_(candidate, query, what, collides);
      }
    }
    funnel_.deciding_ns += since(start);
    if (!asked_.candidates.empty()) ask_(asked_);
    found_.clear();
    asked_.candidates.clear();
    asked_.queries.clear();
    nanoseconds_ += since(start);
  }

  const MovingMesh& mesh_;
  LeaveOut leave_out_;
  const AskSink& ask_;
  const DecidedSink& decided_;
  std::vector<Candidate> found_;
  AskedPairs asked_;
  Funnel funnel_;
  std::uint64_t nanoseconds_ = 0;
};

}  // namespace

std::pair<PairFate, bool> fate(const Query& query) {
  // Subjects are asked about every pair with a separation, since meets_by_translation() can only decide
  // whether primitives touch.
  const RelativeMotion motion = query.separation > 0 ? RelativeMotion::other : relative_motion(query);
  if (motion == RelativeMotion::other) return {PairFate::asked, false};
  const auto meets = meets_by_translation(query);
  if (!meets) return {PairFate::asked, false};
  return {motion == RelativeMotion::rest ? PairFate::at_rest : PairFate::in_translation, *meets};
}

Plan::Plan(const MovingMesh& mesh, LeaveOut leave_out, int jobs, const IsOver& is_over)
    : mesh_(&mesh), leave_out_(leave_out) {
  for (const Kind kind : kinds_of_meshes) {
    const auto start = Clock::now();
    if (leave_out != LeaveOut::nothing) finders_.emplace(kind, CandidateFinder(mesh, kind, jobs, is_over));
    making_ns_[kind] = since(start);
    const std::size_t count =
        leave_out == LeaveOut::nothing ? pair_rows(mesh, kind) : finders_.at(kind).parts();
    for (std::size_t i = 0; i < count; ++i) parts_.emplace_back(kind, i);
  }
}

void Plan::move(const MovingMesh& mesh, int jobs, const IsOver& is_over) {
  mesh_ = &mesh;
  for (auto& [kind, finder] : finders_) {
    const auto start = Clock::now();
    finder.move(mesh, jobs, is_over);
    making_ns_[kind] = since(start);
  }
}

Funnels Plan::follow(std::size_t part, const AskSink& ask, const DecidedSink& decided,
                     const IsOver& is_over) const {
  const auto [kind, number] = parts_[part];
  FateTeller teller(*mesh_, kind, leave_out_, ask, decided);
  const CandidateSink take = [&](const Candidate& candidate) { teller.take(candidate); };
  const auto start = Clock::now();
  const std::uint64_t sharing = leave_out_ == LeaveOut::nothing
                                    ? for_pairs_of_row(*mesh_, kind, number, take, is_over)
                                    : finders_.at(kind).find(number, take, is_over);
  const std::uint64_t finding_ns = since(start) - teller.nanoseconds();
  Funnel funnel = teller.finish();
  funnel[PairFate::share_vertex] = sharing;
  funnel.finding_ns = finding_ns;
  return {{kind, funnel}};
}

Funnels Plan::rest(const Funnels& parts) const {
  Funnels rest;
  for (const Kind kind : kinds_of_meshes) {
    const auto found = parts.find(kind);
    rest[kind][PairFate::boxes_apart] =
        all_pairs(*mesh_, kind) - (found == parts.end() ? 0 : found->second.all());
    rest[kind].finding_ns = making_ns_.at(kind);
  }
  return rest;
}

Funnels follow_plan(const Plan& plan, const AskSink& ask, const DecidedSink& decided, const IsOver& is_over) {
  Funnels sum;
  const auto add = [&](const Funnels& funnels) {
    for (const auto& [kind, funnel] : funnels) sum[kind].merge(funnel);
  };
  for (std::size_t part = 0; part < plan.parts() && !is_over(); ++part)
    add(plan.follow(part, ask, decided, is_over));
  if (!is_over()) add(plan.rest(sum));
  return sum;
}

}  // namespace nearmiss

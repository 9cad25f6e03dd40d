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

/// All pairs of a kind, with a common vertex or not.
std::uint64_t all_pairs(const MovingMesh& mesh, Kind kind) {
  const std::uint64_t edges = mesh.edges.size();
  if (kind == Kind::vertex_triangle) return std::uint64_t{mesh.start.size()} * mesh.triangles.size();
  return edges == 0 ? 0 : edges * (edges - 1) / 2;
}

}  // namespace

Funnels follow_plan(const MovingMesh& mesh, LeaveOut leave_out,
                    const std::function<void(const Candidate&, const Query&)>& ask,
                    const DecidedSink& decided, const std::function<bool()>& stop) {
  Funnels funnels;
  for (const Kind kind : kinds) {
    Funnel& funnel = funnels[kind];
    std::uint64_t asking_ns = 0;  // of others, and not of finding
    const auto take = [&](const Candidate& candidate) {
      const auto start = Clock::now();
      const Query query = make_query(mesh, candidate);
      const auto fate_and_answer = [&]() -> std::pair<PairFate, bool> {
        if (leave_out != LeaveOut::all) return {PairFate::asked, false};
        const RelativeMotion motion = relative_motion(query);
        if (motion == RelativeMotion::other) return {PairFate::asked, false};
        const auto meets = meets_by_translation(query);
        if (!meets) return {PairFate::asked, false};
        return {motion == RelativeMotion::rest ? PairFate::at_rest : PairFate::in_translation, *meets};
      };
      const auto [fate, collides] = fate_and_answer();
      ++funnel[fate];
      funnel.touching += collides ? 1 : 0;
      funnel.deciding_ns += since(start);
      if (fate == PairFate::asked)
        ask(candidate, query);
      else if (decided)
        decided(candidate, query, fate, collides);
      asking_ns += since(start);
    };
    const auto start = Clock::now();
    const std::uint64_t all = all_pairs(mesh, kind);
    if (leave_out == LeaveOut::nothing)
      for (std::size_t row = 0; row < pair_rows(mesh, kind) && !stop(); ++row)
        funnel[PairFate::share_vertex] += for_pairs_of_row(mesh, kind, row, take);
    else
      funnel[PairFate::share_vertex] = find_candidates(mesh, kind, take, stop);
    funnel.finding_ns = since(start) - asking_ns;
    funnel[PairFate::boxes_apart] = stop() ? 0 : all - funnel.all();
  }
  return funnels;
}

}  // namespace nearmiss

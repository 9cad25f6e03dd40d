#include "fuzz/simulation/simulation_family.hpp"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "fuzz/scenes/pair_sample.hpp"
#include "fuzz/simulation/simulation_name.hpp"
#include "fuzz/subjects/exact.hpp"
#include "reports/statistics/family_name.hpp"

namespace nearmiss {

namespace {

constexpr std::size_t most_pairs = 1 << 17;  ///< of each kind in the sample

/// The sample of all pairs that the simulation asks its CCD about.
PairSample simulate(Simulation simulation, const Stop& stop) {
  const auto oracle = try_make_exact("exact");
  PairSample sample(most_pairs);
  std::uint64_t round = 0;
  const auto ask = [&](const MovingMesh& motion, const auto& is_asked) {
    std::vector<ReportedPair> reported;
    const auto ask_about = [&](const Candidate& pair) {
      if (!is_asked(pair)) return;
      sample.add(motion, pair, round);
      if (const Verdict verdict = oracle->decide(make_query(motion, pair)); verdict.hit)
        reported.push_back({pair, verdict.time});
    };
    find_candidates(motion, ask_about, [&] { return stop.is_due(); });
    stop.check();
    ++round;
    return reported;
  };
  for (std::size_t step = 0; step < simulation.steps(); ++step) simulation.advance(ask, stop);
  return sample;
}

/// The family of a simulation, by its name without a separation.
Family simulation_family(std::string_view name, const Stop& stop) {
  const auto pairs =
      std::make_shared<PairsByKind>(simulate(parse_simulation_name(name).simulation(), stop).pairs());
  Family family{.name = std::string(name),
                .about = "pairs that a simulation asks its CCD about",
                .make = [pairs](Random& random, Kind kind) { return drawn(random, *pairs, kind); }};
  if (!pairs->contains(Kind::vertex_triangle)) {  // as in a simulation of lines
    family.kinds.fill(Kind::edge_edge);
    family.only = Kind::edge_edge;
  }
  return family;
}

}  // namespace

Family find_any_family(std::string_view name, const Stop& stop, std::span<const Family> known) {
  if (!name.starts_with(simulation_prefix)) return find_family(name, known);
  const auto separation = FamilyName(name).separation;
  try {
    const Family family = simulation_family(name.substr(0, name.find('~')), stop);
    return separation ? with_separation(family, *separation) : family;
  } catch (const Error& error) {
    throw Error(fmt::format("family '{}': {}", excerpt(name), error.what()));
  }
}

}  // namespace nearmiss

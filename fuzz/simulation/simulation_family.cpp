#include "fuzz/simulation/simulation_family.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "fuzz/scenes/near_families.hpp"
#include "fuzz/subjects/exact.hpp"
#include "reports/statistics/family_name.hpp"
#include "reports/text/values.hpp"

namespace nearmiss {

namespace {

using Options = SimulationOptions;

constexpr std::array<std::pair<std::string_view, std::string Options::*>, 4> keys{
    {{"stiffness", &Options::stiffness},
     {"edge", &Options::edge},
     {"step", &Options::step},
     {"steps-per-frame", &Options::steps_per_frame}}};

}  // namespace

std::string SimulationOptions::name() const {
  const Options usual;
  std::string all = std::string(simulation_prefix) + scene;
  for (const auto& [key, member] : keys)
    if (this->*member != usual.*member) all += fmt::format(":{}={}", key, this->*member);
  return all;
}

Simulation SimulationOptions::simulation() const {
  constexpr int most_steps_per_frame = 1000;
  Material material;
  material.stiffness = parse_positive(stiffness, "--stiffness");
  material.edge = parse_positive(edge, "--edge");
  return {simulated_scene(scene), material, parse_duration(step, "--step-time").count(),
          static_cast<int>(parse_count(steps_per_frame, "--steps-per-frame", 1, most_steps_per_frame))};
}

SimulationOptions parse_simulation_name(std::string_view name) {
  std::string_view rest = name.substr(simulation_prefix.size());
  const auto next = [&rest] {
    const std::string_view part = rest.substr(0, rest.find(':'));
    rest.remove_prefix(std::min(rest.size(), part.size() + 1));
    return part;
  };
  Options options{.scene = std::string(next())};
  while (!rest.empty()) {
    const std::string_view part = next();
    const std::string_view key = part.substr(0, part.find('='));
    for (const auto& [known, member] : keys)
      if (key == known) options.*member = part.substr(std::min(part.size(), key.size() + 1));
  }
  if (options.name() != name)
    throw Error(
        fmt::format("found the simulation '{}', expected '{}', or sim:SCENE with some of :stiffness=, "
                    ":edge=, :step= and :steps-per-frame=, in this order and with unusual values",
                    excerpt(name), excerpt(options.name())));
  return options;
}

namespace {

constexpr std::size_t most_pairs = 1 << 17;  ///< the largest number of pairs of each kind in the sample

/// Runs a simulation with the oracle as its CCD. Returns a sample of the pairs about which the CCD is asked.
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

/// The family of the simulation `name`. The name must not end with a separation.
Family simulation_family(std::string_view name, const Stop& stop) {
  const auto pairs =
      std::make_shared<QueriesByKind>(simulate(parse_simulation_name(name).simulation(), stop).pairs());
  Family family{.name = std::string(name),
                .about = "pairs that a simulation asks its CCD about",
                .make = [pairs](Random& random, Kind kind) { return drawn(random, *pairs, kind); }};
  if (!pairs->contains(Kind::vertex_triangle)) {  // lines have no triangles
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

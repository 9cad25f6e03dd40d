#include "fuzz/simulation/simulation_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
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

}  // namespace nearmiss

#include "tools/paper/claims.hpp"

#include <algorithm>
#include <array>

#include "tools/paper/measures.hpp"

namespace nearmiss::tools::paper {

namespace {

/// In the order of Judgement.
constexpr std::array<std::string_view, 5> names{"holds", "holds with a condition", "does not hold",
                                                "a question, answered", "cannot be measured here"};

constexpr std::string_view all_families =
    "fuzz --subject wang,wang-eps,wang-plain,wang:float,basic --cases 100000 --no-shrink";

constexpr std::string_view with_tolerances =
    "tightness --family planar,sliver --cases 10000 --subject wang,bridson:thickness=* --values "
    "1e-9,1e-6,1e-3,1e-1";

constexpr std::string_view audit = "audit";
constexpr std::string_view larger_bounds =
    "fuzz --family uniform --subject wang,wang@4,wang@16,wang@64 --cases 100000 --no-shrink";

constexpr std::string_view hair_simulation = "simulate hair --subject exact,wang,basic --no-shrink";
const std::vector<std::string_view> all_simulations{"simulate knot --subject exact,wang,basic --no-shrink",
                                                    "simulate cloths --subject exact,wang,basic --no-shrink",
                                                    "simulate spikes --subject exact,wang,basic --no-shrink",
                                                    hair_simulation};

/// All simulations, and that of cloths in which basic fails (fuzz/simulation/README.md).
std::vector<std::string_view> with_soft_cloths() {
  auto commands = all_simulations;
  commands.push_back(
      "simulate cloths@64 --stiffness 0.01 --step-time 10ms --subject exact,wang,basic --no-shrink");
  return commands;
}

const std::array all_claims{
    Claim{"safe", "§1", "unconditionally failure-proof", {all_families}, safe},
    Claim{"order", "§1", "vertex-edge test with O(ε^⅓) relative error", {audit}, order},
    Claim{"candidates", "§3.2", "about seven valid candidates on average", {}, candidates},
    Claim{"constants",
          "§4",
          "bounds of rounding errors: 22 B²ε, 311 B²ε, 565 B⁴ε and others",
          {audit},
          constants},
    Claim{"bound",
          "§4.4.1, §4.5.1",
          "a false positive is at most about 41 B ε^¼ apart",
          {"tightness --tolerance proximity,vertex-edge,vertex-vertex --time 8s"},
          bound},
    Claim{"tolerances",
          "§4.4.1, §5",
          "the proposed tolerances satisfy the constraints of (2) and (3), and are not the tightest",
          {audit},
          closed_forms},
    Claim{"percent",
          "§4.4.1, §4.5.1",
          "in double, 0.5 percent of the maximum edge length",
          {},
          percent_of_edge},
    Claim{"culling",
          "§5",
          "culling with ε^½ eliminates more than 99.9 percent of vertex-edge tests",
          {"fuzz --family uniform --subject wang-scalar,wang-eps,wang-eps:h=0.001,wang-eps:h=1e-300 --cases "
           "200000 --no-shrink"},
          vertex_edge_culling},
    Claim{"larger-B",
          "§5, §6",
          "a larger B, as after larger time steps, increases false positives",
          {larger_bounds},
          larger_B},
    Claim{"next-step",
          "§5",
          "collisions may be detected at the starting time of the next step, if B is larger there",
          {larger_bounds, "simulate cloths --subject wang-time --no-shrink"},
          next_step},
    Claim{"animations",
          "§5",
          "1.4 percent slower than basic tests in animations (355 ns, 350 ns)",
          {"simulate knot --subject basic,wang-scalar --no-shrink"},
          animation_time},
    Claim{"no-planes",
          "§5",
          "1.7 percent slower without plane culling (416 ns, 409 ns)",
          {"bench --subject basic-plain,wang-no-planes --runs 11"},
          planeless_time},
    Claim{"random-time",
          "§5",
          "1.4 percent slower for random pairs in a unit cube (369 ns, 364 ns)",
          {"bench --subject basic,wang-scalar,wang --runs 11"},
          random_time},
    Claim{"random-cases",
          "§5",
          "10 billion random cases tested",
          {"fuzz --family uniform --subject wang,basic --cases 1000000 --no-shrink"},
          random_cases},
    Claim{"exact-time",
          "§5",
          "20 to 40 times faster than exact tests after culling (4,962 ns after the box test)",
          {"bench --subject wang-scalar,exact,parity --queries 2000 --runs 3"},
          exact_time},
    Claim{"boxes", "§5", "nearly half of the random pairs pass the box test", {}, boxes},
    Claim{"planes", "§5", "nearly one third pass plane culling", {}, planes},
    Claim{"peak",
          "§5",
          "up to 20 percent faster than the exact approach at the collision peaking time",
          {},
          peak},
    Claim{"positives", "§5", "up to 10 percent more positives in animations than with exact tests",
          all_simulations, more_positives},
    Claim{"case-numbers", "§5", "total case numbers are about the same as with exact tests", all_simulations,
          case_numbers},
    Claim{"micrometres",
          "§5",
          "a false positive is at most about 20 μm apart in the simulations",
          {},
          micrometres},
    Claim{"basic-fails", "§5", "basic tests fail in one of four animations; failures are extremely rare",
          with_soft_cloths(), basic_fails},
    Claim{"user-tolerances",
          "§5",
          "no tolerance saves basic tests, and larger ones cause more false positives",
          {with_tolerances},
          tolerances_do_not_save},
    Claim{"fewer-positives",
          "§5",
          "reduces false positives, in comparison with tolerances that the user chooses",
          {"tightness --family uniform,kilometres --cases 20000 --subject wang,bridson:thickness=* --values "
           "1e-9,1e-6,1e-3"},
          fewer_positives},
    Claim{"hair",
          "§5",
          "asks whether basic tests are more likely to fail in hair animation",
          {hair_simulation},
          hair},
    Claim{"float",
          "§6",
          "in float, as far apart as half of the maximum edge length",
          {audit, "fuzz --search --family uniform --kind ee --subject wang:float --time 40s --no-shrink"},
          half_an_edge},
    Claim{"precisions", "§6", "future work: how errors depend on ε", {audit}, precisions},
    Claim{"exact-normals",
          "§6",
          "asks whether it is worthwhile to compute normals by exact arithmetic",
          {"fuzz --subject wang-scalar,wang:dd-normals --kind vt,ee --cases 100000 --no-shrink"},
          exact_normals},
    Claim{"fast-math", "§6", "future work: floating-point optimisations", {}, fast_math},
    Claim{"gpu", "§6", "future work: GPU", {}, gpu},
};

}  // namespace

std::string_view name(Judgement judgement) { return names[static_cast<std::size_t>(judgement)]; }

std::optional<Judgement> judgement_named(std::string_view name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return static_cast<Judgement>(found - names.begin());
}

std::span<const Claim> claims() { return all_claims; }

}  // namespace nearmiss::tools::paper

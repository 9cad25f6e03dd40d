// The quantitative claims of the paper, and how nearmiss measures each of them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/stop.hpp"

namespace nearmiss::tools::paper {

/// Whether our measurements confirm a claim of the paper.
enum class Judgement {
  holds,
  holds_with_condition,
  does_not_hold,
  answered,  ///< the paper only asks a question, and nearmiss answers it
  not_measured
};

/// The name of a judgement in tables, such as "holds with a condition".
std::string_view name(Judgement judgement);

std::optional<Judgement> judgement_named(std::string_view name);

struct Measured {
  /// Says what was measured, with all figures. For holds_with_condition, also states the condition under which
  /// the claim holds.
  std::string text;
  Judgement judgement = Judgement::not_measured;
};

/// The JSON that a claim's commands write, in the order of the commands.
using Results = std::vector<nlohmann::ordered_json>;

/// Subcommands of nearmiss with their options, without --json.
struct Commands : std::vector<std::string_view> {
  using vector::vector;
  Commands(std::string_view one) : vector{one} {}
  Commands(const char* one) : vector{one} {}
};

struct Claim {
  std::string_view name;     ///< the claim's name on the command line, which no other claim has
  std::string_view section;  ///< the section of the paper that makes the claim
  std::string_view says;
  Commands commands = {};  ///< the commands that give `measure` its results, if it needs any
  Measured (*measure)(const Results& results, const Stop& stop) = nullptr;
  std::string_view why_not = {};  ///< if `measure` is null, why the claim cannot be measured here

  [[nodiscard]] Measured measured(const Results& results, const Stop& stop) const {
    return measure == nullptr ? Measured{.text = std::string(why_not)} : measure(results, stop);
  }
};

/// All claims, in the order of the paper's sections.
std::span<const Claim> claims();

}  // namespace nearmiss::tools::paper

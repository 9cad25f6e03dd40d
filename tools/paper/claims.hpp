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

/// Whether a claim holds.
enum class Judgement {
  holds,
  holds_with_condition,
  does_not_hold,
  answered,  ///< the paper asks, and claims nothing
  not_measured
};

/// As the table shows it, such as "holds with a condition".
std::string_view name(Judgement judgement);

/// The judgement with this name; nothing if there is none.
std::optional<Judgement> judgement_named(std::string_view name);

struct Measured {
  std::string text;  ///< with all figures, and the condition if there is one
  Judgement judgement = Judgement::not_measured;
};

/// The JSON of each of a claim's commands, in their order.
using Results = std::vector<nlohmann::ordered_json>;

struct Claim {
  std::string_view name;     ///< unique, a word on the command line
  std::string_view section;  ///< of the paper
  std::string_view says;
  /// The subcommands of nearmiss that measure it, without --json. If there is none, `measure` does it itself.
  std::vector<std::string_view> commands = {};
  Measured (*measure)(const Results& results, const Stop& stop) = nullptr;
  std::string_view why_not = {};  ///< why it cannot be measured here, if `measure` is null

  [[nodiscard]] Measured measured(const Results& results, const Stop& stop) const {
    return measure == nullptr ? Measured{.text = std::string(why_not)} : measure(results, stop);
  }
};

/// All claims, in the order of the paper's sections.
std::span<const Claim> claims();

}  // namespace nearmiss::tools::paper

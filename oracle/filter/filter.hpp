// The certified filter: floating-point arithmetic that never gives a wrong answer. Exact arithmetic decides
// the queries that the filter leaves undecided.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "ccd/query/instructions.hpp"
#include "ccd/query/query.hpp"
#include "ccd/query/query_rows.hpp"
#include "oracle/arithmetic/enclosure.hpp"

namespace nearmiss {

/// The stage that decided a query.
enum class FilterStage : std::uint8_t {
  boxes,        ///< no: the swept boxes do not meet
  planes,       ///< no: a moving plane (planes.hpp) separates the primitives, by more than h
  one_sign,     ///< no: F, the coplanarity cubic, keeps one sign
  weights,      ///< no: two weights (step_part.hpp) have opposite signs whenever F may vanish
  sign_change,  ///< yes: F changes its sign while all weights have one sign
  at_an_end,    ///< yes: F or a weight is exactly 0 at the contact, as at t = 0 or 1 (sure_contact.hpp)
  apart,        ///< no: the distance is always above the separation h > 0
  within,       ///< yes: the distance falls below the separation h > 0
  undecided,    ///< exact arithmetic must decide
};

inline constexpr std::size_t filter_stage_count = 9;

/// The names of the stages, as files and reports write them, in the order of the enumeration.
inline constexpr std::array<std::string_view, filter_stage_count> filter_stage_names{
    "boxes", "planes", "one-sign", "weights", "sign-change", "at-an-end", "apart", "within", "undecided"};

/// Whether a stage means a collision; the stage must not be `undecided`.
constexpr bool is_collision(FilterStage stage) {
  return stage == FilterStage::sign_change || stage == FilterStage::at_an_end || stage == FilterStage::within;
}

/// Decides a query in double and double words with certified error bounds, or leaves it undecided. This
/// function does not include the box test. A query with a coordinate that is not finite is left undecided.
FilterStage filter(const Query& query);

/// The width to which most times can be enclosed without double words.
inline constexpr double rough_time = 0x1p-30;

/// An interval that contains the time of the first contact, if there is one; nothing if there certainly is
/// none. Uses the arithmetic of filter(). Most intervals are at most `width` wide, or as narrow as doubles
/// allow. This function does not include the box test.
std::optional<KnownTime> time_of_contact(const Query& query, double width = rough_time);

/// Decides many queries of any kinds. This function includes the box test. The instruction set does not
/// affect the answers.
void filter(const QueryRows& queries, std::span<FilterStage> stages,
            Instructions instructions = chosen_instructions());
inline void filter(std::span<const Query> queries, std::span<FilterStage> stages,
                   Instructions instructions = chosen_instructions()) {
  filter(QueryRows(queries), stages, instructions);
}

/// Decides as filter() does. For a collision, `time` is set to the neighbouring doubles between which the
/// first contact lies, or to the exact time of this contact. If neither is known, `time` is set to [0, 1]. If
/// there is no collision, `time` means nothing.
FilterStage filter_for_time(const Query& query, KnownTime& time);
void filter_for_times(const QueryRows& queries, std::span<FilterStage> stages, std::span<KnownTime> times,
                      Instructions instructions = chosen_instructions());

/// Decides in double arithmetic only, with every error bound multiplied by `caution` >= 1. If this decides a
/// query, the values that decide it exceed their true error bounds by this factor.
void filter_with_caution(std::span<const Query> queries, double caution, std::span<FilterStage> stages);

}  // namespace nearmiss

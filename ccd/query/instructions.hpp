// The vector instructions with which many queries are decided at once.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace nearmiss {

/// The x86-64 instruction sets whose registers hold 2, 4 and 8 doubles. On other processors, `sse2` means the
/// compiler's own vectors of two doubles, such as NEON's. The choice changes no answer.
enum class Instructions : std::uint8_t { sse2, avx2, avx512 };

inline constexpr std::array all_instructions{Instructions::sse2, Instructions::avx2, Instructions::avx512};

/// The number of doubles in a register.
constexpr int lanes(Instructions instructions) { return 2 << static_cast<int>(instructions); }

/// Whether this machine has the instruction set.
bool has(Instructions instructions);
/// The widest instruction set that this machine has.
Instructions widest_instructions();

/// The instruction set that is used: the widest one, unless the program has chosen another.
Instructions chosen_instructions();
/// Chooses the instruction set with the given number of lanes, "2", "4" or "8", for the whole process. Throws
/// Error for any other number, or if this machine does not have the instructions. No other thread may run
/// meanwhile.
void choose_instructions(std::string_view given);

}  // namespace nearmiss

// The sets of vector instructions with which code in lanes (lanes.hpp) decides many queries at once.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace nearmiss {

/// The x86-64 instruction sets whose registers hold 2, 4 and 8 doubles. On other processors, `sse2` means
/// vectors of two doubles as the compiler implements them, with NEON for example. The choice of the
/// instruction set changes no answer.
enum class Instructions : std::uint8_t { sse2, avx2, avx512 };

inline constexpr std::array all_instructions{Instructions::sse2, Instructions::avx2, Instructions::avx512};

/// The number of doubles in a register of an instruction set.
constexpr int lanes(Instructions instructions) { return 2 << static_cast<int>(instructions); }

bool has(Instructions instructions);
Instructions widest_instructions();

/// The instruction set that this process uses: widest_instructions(), unless choose_instructions() chose
/// another set.
Instructions chosen_instructions();
/// Chooses the instruction set with the given number of lanes, "2", "4" or "8", for the whole process. Throws
/// Error for any other number, or if this machine lacks the instruction set. No other thread may run during
/// the call.
void choose_instructions(std::string_view given);

}  // namespace nearmiss

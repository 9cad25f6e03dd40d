// The table of methods that decide a query. README.md repeats the table, and says how to add a method.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string_view>

#include "ccd/query/query.hpp"
#include "oracle/oracle.hpp"

namespace nearmiss {

/// A method's answers to questions about a query. A member has no value if the method leaves its question
/// open.
struct Answer {
  std::optional<bool>
      collision{};  ///< whether the primitives meet; for h > 0, whether the distance falls below h
  std::optional<bool> at_most{};      ///< for h > 0: whether the distance is at most h at some time
  std::optional<bool> on_boundary{};  ///< whether the primitives meet at t = 0, at t = 1 or at a border
  std::optional<bool> odd{};  ///< whether the number of roots (RootParity) is odd; no value if `on_boundary`
  /// Whether the method answers at least one of these questions about the query.
  [[nodiscard]] bool is_answer() const { return collision || at_most || on_boundary || odd; }

  std::size_t detail = 0;  ///< for a fuzzer: the number of bits of a certificate's length, below 32
};

/// Which of these questions a method promises to answer.
enum class Claim {
  complete,  ///< whether there is a collision, unless the smallest distance is exactly h > 0
  parity,    ///< the questions of `on_boundary` and `odd`; only for h = 0 and kinds with four vertices
};

Answer to_answer(const Query& query, const Decision& decision);
/// The filter's answer, taken from a decision; an empty answer if exact arithmetic decided.
Answer filter_answer(const Query& query, const Decision& decision);

/// The answer that the certificate of the oracle's decision proves. The answer is empty if there is no
/// certificate, or if the checker of tools/certificates/ refuses it.
Answer proved_answer(const Query& query);

/// "complete" or "parity".
std::string_view name(Claim claim);

/// A method that decides every finite query exactly, within its claim.
struct Method {
  std::string_view name;
  std::string_view about;  ///< how the method decides, in one line
  Claim claim;
  std::function<Answer(const Query&)> ask;
};

/// All methods. The first one is complete, and decides the queries that the filter leaves undecided.
std::span<const Method> methods();

}  // namespace nearmiss

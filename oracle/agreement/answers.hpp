// Compares the answers of several exact methods.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ccd/query/query.hpp"
#include "oracle/agreement/methods.hpp"

namespace nearmiss {

/// The answers of some methods to a query. The methods must outlive this object.
class Answers {
 public:
  Answers(std::span<const Method> methods, std::vector<Answer> answers);

  [[nodiscard]] std::span<const Answer> all() const { return answers_; }

  /// Whether there is a collision, according to the first method whose claim is `complete`.
  [[nodiscard]] bool collision() const;

  /// Whether no two methods contradict each other, and every complete method says whether there is a
  /// collision. A complete method need not say whether there is a collision if another method says that the
  /// smallest distance is exactly h > 0.
  [[nodiscard]] bool agree() const { return disagreement().empty(); }
  /// The contradictions and the missing answers, such as "collision (no: exact; yes: certificate)"; "" if
  /// there are none. The answers of the methods are also compared with `by_filter`, the answer of the filter.
  [[nodiscard]] std::string disagreement(const Answer& by_filter = {}) const;

  /// Whether there is a collision that root parity cannot detect, because the number of roots is even.
  [[nodiscard]] bool missed_by_parity() const;

 private:
  std::span<const Method> methods_;
  std::vector<Answer> answers_;
};

Answers ask_all(const Query& query, std::span<const Method> asked = methods());

/// Asks all methods in `asked` except the first one, whose answer `first` is already known.
Answers ask_others(const Query& query, const Answer& first, std::span<const Method> asked = methods());

}  // namespace nearmiss

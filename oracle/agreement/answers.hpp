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

  /// The answer of the first complete method.
  [[nodiscard]] bool collision() const;

  /// Whether no two methods contradict each other about the collision, the boundary or the number of roots,
  /// and every complete method says whether there is a collision. A complete method may leave the collision
  /// open if another one says that the smallest distance is exactly h > 0.
  [[nodiscard]] bool agree() const { return disagreement().empty(); }
  /// The contradictions, such as "collision (no: exact; yes: certificate)"; "" if the answers agree. If
  /// `by_filter` is given, it is compared, too.
  [[nodiscard]] std::string disagreement(const Answer& by_filter = {}) const;

  /// Whether there is a collision that root parity cannot detect, because the number of roots is even.
  [[nodiscard]] bool missed_by_parity() const;

 private:
  std::span<const Method> methods_;
  std::vector<Answer> answers_;
};

/// Asks all methods.
Answers ask_all(const Query& query, std::span<const Method> asked = methods());

/// Asks all methods except the first one, whose answer `first` is already known. The first method is
/// complete.
Answers ask_others(const Query& query, const Answer& first, std::span<const Method> asked = methods());

}  // namespace nearmiss

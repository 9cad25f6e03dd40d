// Pieces of Gappa scripts: products of factors 1 + δ, and rational numbers.
#pragma once

#include <fmt/format.h>

#include <string>

#include "tests/proofs/numbers.hpp"

namespace nearmiss::proofs {

inline std::string script_text(const Rational& x) {
  return fmt::format("({} / {})", numerator(x).str(), denominator(x).str());
}
inline std::string script_text(double x) { return fmt::format("{:a}", x); }

/// The factors of one script, each with its own variable δ.
class Factors {
 public:
  /// The product of `count` factors 1 + δ; each |δ| is at most `size`.
  std::string product(int count, double size) {
    std::string text = "1";
    for (int i = 0; i < count; ++i) {
      const std::string name = fmt::format("d{}", count_++);
      text += fmt::format(" * (1 + {})", name);
      ranges_ += fmt::format("{}{} in [{:a}, {:a}]", ranges_.empty() ? "" : " /\\ ", name, -size, size);
    }
    return fmt::format("({})", text);
  }

  [[nodiscard]] std::string script(const std::string& goal) const {
    return fmt::format("{{ {}{}{} }}\n", ranges_, ranges_.empty() ? "" : " -> ", goal);
  }

 private:
  int count_ = 0;
  std::string ranges_;
};

}  // namespace nearmiss::proofs

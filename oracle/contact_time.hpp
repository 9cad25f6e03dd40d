// When two primitives first share a point.
#pragma once

#include <memory>
#include <string>

#include "ccd/query.hpp"
#include "oracle/arithmetic/enclosure.hpp"

namespace nearmiss {

namespace exact {
class Root;
}

/// The time t* in [0, 1] at which the primitives of a query first share a point. Arithmetic with certified bounds encloses it
/// first; exact arithmetic is only used for a question that the enclosure does not answer.
class ContactTime {
 public:
  /// The primitives must share a point in [0, 1].
  explicit ContactTime(const Query& query);
  ~ContactTime();
  ContactTime(ContactTime&&) noexcept;
  ContactTime& operator=(ContactTime&&) noexcept;
  ContactTime(const ContactTime&) = delete;
  ContactTime& operator=(const ContactTime&) = delete;

  /// What is known about t*.
  [[nodiscard]] const Enclosure& known() const { return known_; }

  /// Whether t* < time. The answer is exact.
  [[nodiscard]] bool is_before(double time);

  /// An enclosure that is at most `width` wide, or as narrow as doubles allow; one number if t* is a double and `width`
  /// is 0.
  const Enclosure& enclosure(double width = 0);

  /// t* as a rational number, "p/q" or "p" in lowest terms; "" if it is irrational.
  [[nodiscard]] std::string rational();

 private:
  exact::Root& root();

  Query query_;
  Enclosure known_;
  std::unique_ptr<exact::Root> root_;  ///< made when it is needed
};

}  // namespace nearmiss

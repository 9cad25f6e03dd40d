#include "oracle/agreement/answers.hpp"

#include <algorithm>
#include <stdexcept>

namespace nearmiss {

namespace {

/// The methods that answer no and those that answer yes.
class Votes {
 public:
  void add(std::string_view name, std::optional<bool> said) {
    if (!said) return;
    std::string& names = *said ? yes_ : no_;
    names.append(names.empty() ? "" : ", ").append(name);
  }

  /// Appends the question if the answers differ.
  void complain(std::string& text, std::string_view question) const {
    if (yes_.empty() || no_.empty()) return;
    text.append(text.empty() ? "" : ", ").append(question);
    text.append(" (no: ").append(no_).append("; yes: ").append(yes_).append(")");
  }

 private:
  std::string no_, yes_;
};

}  // namespace

Answers::Answers(std::span<const Method> methods, std::vector<Answer> answers)
    : methods_(methods), answers_(std::move(answers)) {
  if (answers_.size() != methods_.size()) throw std::invalid_argument("expected an answer of every method");
}

bool Answers::collision() const {
  for (std::size_t i = 0; i < answers_.size(); ++i)
    if (methods_[i].claim == Claim::complete) return answers_[i].collision.value_or(false);
  throw std::invalid_argument("expected a method that is complete");
}

std::string Answers::disagreement(const Answer& by_filter) const {
  Votes collision;
  Votes at_most;
  Votes boundary;
  Votes odd;
  std::string text;
  const bool is_tie = std::any_of(answers_.begin(), answers_.end(), [](const Answer& answer) {
    return answer.collision == false && answer.at_most == true;
  });
  for (std::size_t i = 0; i < answers_.size(); ++i) {
    const Method& method = methods_[i];
    const Answer& answer = answers_[i];
    if (method.claim == Claim::complete && !answer.collision && !is_tie)
      text.append(text.empty() ? "" : ", ").append("no answer of ").append(method.name);
    collision.add(method.name, answer.collision);
    at_most.add(method.name, answer.at_most);
    boundary.add(method.name, answer.on_boundary);
    odd.add(method.name, answer.odd);
  }
  collision.add("filter", by_filter.collision);
  at_most.add("filter", by_filter.at_most);
  collision.complain(text, "collision");
  at_most.complain(text, "at most h");
  boundary.complain(text, "boundary");
  odd.complain(text, "odd");
  return text;
}

bool Answers::missed_by_parity() const {
  const auto misses = [&](const Answer& answer) {
    const Method& method = methods_[static_cast<std::size_t>(&answer - answers_.data())];
    return method.claim == Claim::parity && answer.is_answer() && !answer.collision.value_or(false);
  };
  return collision() && std::any_of(answers_.begin(), answers_.end(), misses);
}

Answers ask_all(const Query& query, std::span<const Method> asked) {
  std::vector<Answer> answers;
  for (const Method& method : asked) answers.push_back(method.ask(query));
  return {asked, std::move(answers)};
}

Answers ask_others(const Query& query, const Answer& first, std::span<const Method> asked) {
  std::vector<Answer> answers{first};
  for (const Method& method : asked.subspan(1)) answers.push_back(method.ask(query));
  return {asked, std::move(answers)};
}

}  // namespace nearmiss

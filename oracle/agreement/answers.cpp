#include "oracle/agreement/answers.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace nearmiss {

namespace {

/// The names of the methods that answer no to a question, and of those that answer yes.
class Votes {
 public:
  void add(std::string_view name, std::optional<bool> said) {
    if (!said) return;
    std::string& names = *said ? yes_ : no_;
    names.append(names.empty() ? "" : ", ").append(name);
  }

  /// If the methods' answers to a question differ, appends `question` and the names of the methods to `text`.
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
  std::string text;
  const bool is_tie = std::any_of(answers_.begin(), answers_.end(), [](const Answer& answer) {
    return answer.collision == false && answer.at_most == true;
  });
  for (std::size_t i = 0; i < answers_.size(); ++i)
    if (methods_[i].claim == Claim::complete && !answers_[i].collision && !is_tie)
      text.append(text.empty() ? "" : ", ").append("no answer of ").append(methods_[i].name);
  for (const auto& [question, said] :
       {std::pair{"collision", &Answer::collision}, std::pair{"at most h", &Answer::at_most},
        std::pair{"boundary", &Answer::on_boundary}, std::pair{"odd", &Answer::odd}}) {
    Votes votes;
    for (std::size_t i = 0; i < answers_.size(); ++i) votes.add(methods_[i].name, answers_[i].*said);
    votes.add("filter", by_filter.*said);
    votes.complain(text, question);
  }
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

#include "fuzz/subjects/named.hpp"

#include <algorithm>
#include <utility>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "fuzz/subjects/forwarding_subject.hpp"

namespace nearmiss {

namespace {

constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";

class Named final : public ForwardingSubject {
 public:
  Named(std::unique_ptr<Subject> subject, const std::string& given, std::string_view rest)
      : ForwardingSubject(given + std::string(rest), *subject), subject_(std::move(subject)), given_(given) {}

  [[nodiscard]] const std::string& given() const { return given_; }

 private:
  std::unique_ptr<Subject> subject_;
  std::string given_;
};

}  // namespace

bool is_given_name(std::string_view text) {
  const auto is_letter = [](char c) { return letters.find(c) != std::string_view::npos; };
  return !text.empty() && is_letter(text.front()) && std::all_of(text.begin(), text.end(), [&](char c) {
    return is_letter(c) || std::string_view("0123456789_.-").find(c) != std::string_view::npos;
  });
}

SubjectText SubjectText::parse(std::string_view text) {
  const std::size_t at = text.find_first_of(":/=");
  if (at == std::string_view::npos || text[at] != '=') return {"", std::string(text)};
  if (!is_given_name(text.substr(0, at)))
    throw Error(
        "found the name '" + excerpt(text.substr(0, at)) + "' in '" + excerpt(text) +
        "', expected NAME=SUBJECT with a name of letters, digits, '_', '.' and '-' that begins with a "
        "letter");
  return {std::string(text.substr(0, at)), std::string(text.substr(at + 1))};
}

std::unique_ptr<Subject> named(std::unique_ptr<Subject> subject, const std::string& name, bool is_plugin) {
  if (name.empty()) return subject;
  const std::string own = subject->name();
  const bool has_options = is_plugin || own.find('=') != std::string::npos;
  const std::size_t rest = has_options ? own.find(':') : own.rfind('@');
  return std::make_unique<Named>(std::move(subject), name, rest == std::string::npos ? "" : own.substr(rest));
}

std::string given_name(const Subject& subject) {
  if (const auto* const own = dynamic_cast<const Named*>(&subject)) return own->given();
  const auto* const forwarding = dynamic_cast<const ForwardingSubject*>(&subject);
  return forwarding == nullptr ? "" : given_name(forwarding->to());
}

}  // namespace nearmiss

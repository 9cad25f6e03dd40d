#include "fuzz/trial/versions.hpp"

#include <algorithm>
#include <map>

#include "fuzz/subjects/contracted.hpp"
#include "fuzz/subjects/forwarding_subject.hpp"
#include "reports/statistics/failure.hpp"

namespace nearmiss {

namespace {

/// A text that all versions of a CCD share: the name that their plug-ins export, and whether these subjects
/// are asked beyond their contract.
std::string ccd_of(const Subject& subject) {
  return innermost(subject).name() +
         std::string(subject.name().ends_with(beyond_contract) ? beyond_contract : "");
}

}  // namespace

std::vector<std::optional<std::size_t>> predecessors(const Subjects& subjects,
                                                     const std::vector<std::string>& chosen) {
  std::vector<std::optional<std::size_t>> before(subjects.size());
  std::map<std::string, std::size_t> first;
  for (std::size_t s = 0; s < subjects.size(); ++s)
    if (const auto [known, is_first] = first.try_emplace(ccd_of(*subjects[s]), s); !is_first)
      before[s] = known->second;
  const auto index_of = [&](const std::string& name) {
    const auto same = [&](const auto& each) { return each->name() == name; };
    return static_cast<std::size_t>(std::find_if(subjects.begin(), subjects.end(), same) - subjects.begin());
  };
  if (chosen.empty()) return before;
  const std::size_t own = index_of(chosen.back());
  const std::size_t other = index_of(chosen.front());
  if (own < subjects.size() && other < subjects.size() && own != other) before[own] = other;
  return before;
}

VersionComparison::VersionComparison(const Subjects& subjects, const Comparison& comparison)
    : subjects_(subjects),
      before_(predecessors(subjects, comparison.versions)),
      has_versions_(std::ranges::any_of(before_, [](const auto& each) { return each.has_value(); })),
      answers_(subjects.size()),
      counts_(subjects.size()) {}

void VersionComparison::finish_query(std::vector<Finding>& findings) {
  if (!has_versions_) return;
  for (std::size_t s = 0; s < subjects_.size(); ++s) {
    if (!before_[s] || !answers_[s].is_asked || !answers_[*before_[s]].is_asked) continue;
    const bool failed = answers_[*before_[s]].finding.has_value();
    const bool fails = answers_[s].finding.has_value();
    VersionCounts& counts = counts_[s];
    ++(failed ? (fails ? counts.both : counts.fixed) : (fails ? counts.broken : counts.neither));
    if (fails && !failed) findings[*answers_[s].finding].broken_since = subjects_[*before_[s]]->name();
  }
  std::fill(answers_.begin(), answers_.end(), Answer{});
}

void VersionComparison::add_to(VersionTable& table, Kind kind, const std::string& family) const {
  for (std::size_t s = 0; s < subjects_.size(); ++s)
    if (before_[s])
      table[{subjects_[*before_[s]]->name(), subjects_[s]->name(), kind, family}].merge(counts_[s]);
}

bool AnswersRightly::operator()(const Query& query) const {
  const Verdict verdict = subject_.decide(query);
  return verdict.fault == Fault::none && !judge_.failure(query, verdict);
}

}  // namespace nearmiss

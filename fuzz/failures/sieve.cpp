#include "fuzz/failures/sieve.hpp"

#include <algorithm>

#include "fuzz/failures/failure.hpp"
#include "fuzz/parallel.hpp"

namespace nearmiss {

const Subject* Sieve::subject_of(const Finding& finding) const {
  const auto same = [&](const auto& subject) { return subject->name() == finding.subject; };
  const auto subject = std::find_if(subjects_.begin(), subjects_.end(), same);
  return subject == subjects_.end() ? nullptr : subject->get();  // the oracle's own findings have none
}

void Sieve::sift(std::vector<Finding>& findings) {
  std::vector<Finding> first;
  for (Finding& finding : findings)
    if (Kept& kept = kept_[signature_of(finding)]; kept.count < kept_of_each) {
      ++kept.count;
      first.push_back(std::move(finding));
    }
  in_parallel(jobs_, first.size(), [&](std::size_t i) {
    if (!stop_) first[i].shrunk = shrunk_query(first[i], subject_of(first[i]));
  });
  findings.clear();
  for (Finding& finding : first) {
    auto& shrunk = kept_[signature_of(finding)].shrunk;
    if (std::find(shrunk.begin(), shrunk.end(), finding.shrunk) != shrunk.end()) continue;
    shrunk.push_back(finding.shrunk);
    findings.push_back(std::move(finding));
  }
}

}  // namespace nearmiss

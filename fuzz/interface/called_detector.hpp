// A detector of the caller's program as a subject.
#pragma once

#include <cstdint>
#include <mutex>
#include <span>
#include <string>

#include "ccd/subjects/described_subject.hpp"
#include "fuzz/subjects/isolation/fault_texts.hpp"

namespace nearmiss {

/// Calls a detector in this process. A C++ exception is a fault of the query that throws it.
class CalledDetector final : public DescribedSubject {
 public:
  /// The detector's functions get `state`. One thread at a time calls them, unless `at_once`.
  CalledDetector(const nearmiss_subject& detector, void* state, bool at_once);

  using DescribedSubject::decide;
  void decide(std::span<const Query> queries, std::span<Verdict> verdicts) const override;
  [[nodiscard]] BoundAnswer ask_bound(const Query& query) const override;
  [[nodiscard]] std::string fault_text(const Verdict& verdict) const override;

 private:
  void ask(std::span<const Query> queries, std::span<Verdict> verdicts) const;
  [[nodiscard]] std::int32_t number_of_exception() const;

  Detector detector_;
  bool at_once_;
  mutable std::mutex mutex_;
  mutable FaultTexts texts_;
};

}  // namespace nearmiss

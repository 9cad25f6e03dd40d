// A subject that calls a detector of the caller's program.
#pragma once

#include <cstdint>
#include <mutex>
#include <span>
#include <string>

#include "ccd/subjects/described_subject.hpp"
#include "fuzz/subjects/isolation/fault_texts.hpp"

namespace nearmiss {

/// Calls a detector in this process. If the detector throws a C++ exception on a query, the verdict on this
/// query is a fault.
class CalledDetector final : public DescribedSubject {
 public:
  /// The detector's functions get `state` as their first argument. If `at_once` is true, several threads may
  /// call these functions at once.
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

// Subjects that decide queries in batches.
#pragma once

#include <span>
#include <string>
#include <utility>

#include "ccd/subjects/subject.hpp"

namespace nearmiss {

/// A subject whose derived class implements decide() for batches. A single query is decided as a batch of one
/// query.
class BatchSubject : public Subject {
 public:
  explicit BatchSubject(std::string name) : name_(std::move(name)) {}

  [[nodiscard]] const std::string& name() const override { return name_; }

  [[nodiscard]] Verdict decide(const Query& query) const override {
    Verdict verdict;
    decide(std::span(&query, 1), std::span(&verdict, 1));
    return verdict;
  }
  void decide(std::span<const Query> queries, std::span<Verdict> verdicts) const override = 0;

 private:
  std::string name_;
};

}  // namespace nearmiss

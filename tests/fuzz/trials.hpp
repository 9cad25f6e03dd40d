// Makes the lists of subjects and the batches of queries that trials take.
#pragma once

#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fuzz/subjects/subjects.hpp"
#include "fuzz/trial/trial.hpp"

namespace nearmiss::testing {

inline Subjects one(std::unique_ptr<Subject> subject) {
  Subjects subjects;
  subjects.push_back(std::move(subject));
  return subjects;
}

inline Subjects subjects_named(std::initializer_list<const char*> names) {
  Subjects subjects;
  for (const char* name : names) subjects.push_back(make_any_subject(name));
  return subjects;
}

/// A batch of queries of one kind. The provenance of a query is its number.
inline Batch batch_of(std::string family, std::vector<Query> queries) {
  const Kind kind = queries.front().kind;
  return {.kind = kind,
          .family = std::move(family),
          .queries = std::move(queries),
          .provenance = [](std::size_t i) { return std::to_string(i); }};
}

}  // namespace nearmiss::testing

// The answers of a recorded CCD, as a subject.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "ccd/subjects/subject.hpp"
#include "corpus/recording.hpp"

namespace nearmiss {

inline constexpr std::string_view recorded_name = "recorded";

/// A query and its recorded answer, in the form in which they are judged.
struct RecordedAnswer {
  std::filesystem::path file;
  std::uint64_t number;  ///< the number of the record
  Query query;
  int answer;     ///< as in nearmiss_subject.h
  double time;    ///< in the query's own step; NaN if none
  bool in_float;  ///< whether the program takes the step to that time in float
};

/// Counts of records that are left out.
struct LeftOut {
  UnusedRecords unused;
  std::uint64_t rounded = 0;  ///< tmax is not 1, and no query in doubles represents the recorded question
};

/// Passes on the records that can be judged, in order. If tmax is 1, or if tmax < 1 and the answer is a
/// collision with a time, the answer is judged on the recorded query: a time is late in the whole step
/// exactly if it is late in the part up to tmax (but a collision after tmax counts as found). Any other
/// answer is judged on the query that ends at tmax. If doubles cannot represent this query, the answer is
/// judged on the rounded query, provided that tmax < 1 and that rounding does not change the decision. Throws
/// Error as the reader of recordings does.
LeftOut read_judgeable(const std::filesystem::path& file, const std::function<void(RecordedAnswer&&)>& sink);

/// Some answers, with at most one answer per query, and a subject that gives these answers under the name
/// recorded_name. The subject promises lower bounds if any answer has a time.
struct RecordedPass {
  std::unique_ptr<Subject> subject;
  std::vector<RecordedAnswer> answers;
};

/// Divides all answers into as few passes as possible. Several passes are needed if a simulation asked about
/// the same query twice and got different answers.
std::vector<RecordedPass> in_passes(std::vector<RecordedAnswer> answers);

}  // namespace nearmiss

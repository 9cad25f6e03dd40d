// A subject that repeats the recorded answers of a CCD.
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
  int answer;  ///< as in nearmiss_subject.h
  /// The time of impact, in which 1 is the end of the query's step. NaN if the answer has no time.
  double time;
  bool in_float;  ///< whether the recorded program computes the positions at `time` in float
};

/// The numbers of records that are left out because they cannot be judged.
struct LeftOut {
  UnusedRecords unused;
  std::uint64_t rounded = 0;  ///< records with tmax != 1 for which rounding the positions at tmax to doubles
                              ///< may change the decision
};

/// Passes to `sink`, in order, those records of a file that can be judged. The CCD was asked about the times
/// up to the record's tmax. If tmax is 1, or if tmax < 1 and the answer is a collision with a time, the
/// answer is judged on the recorded query. This is right, because a time is too late for the whole step if
/// and only if it is too late for the part up to tmax. (If the primitives collide only after tmax, a
/// collision with a time counts as a right answer.) Any other answer is judged on the query that ends at
/// tmax. If doubles cannot represent this query, the answer is judged on the rounded query, provided that
/// tmax < 1 and that rounding does not change the decision; otherwise, the record is left out. Throws Error
/// as read_recording() does.
LeftOut read_judgeable(const std::filesystem::path& file, const std::function<void(RecordedAnswer&&)>& sink);

/// Some recorded answers, no two of which contradict each other, and a subject that gives these answers under
/// the name recorded_name. If any recorded answer has a time, the subject promises that times are lower
/// bounds.
struct RecordedPass {
  std::unique_ptr<Subject> subject;
  std::vector<RecordedAnswer> answers;
};

/// Divides all answers into passes. Different answers to the same query are in different passes, and so are
/// answers that have `in_float` set and answers that do not.
std::vector<RecordedPass> in_passes(std::vector<RecordedAnswer> answers);

}  // namespace nearmiss

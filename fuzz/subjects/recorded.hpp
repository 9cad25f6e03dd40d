// What the CCD of a recording answered, as a subject.
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

/// A query and its recorded answer, as they are judged.
struct RecordedAnswer {
  std::filesystem::path file;
  std::uint64_t number;  ///< of the record
  Query query;
  int answer;     ///< as in nearmiss_subject.h
  double time;    ///< in the query's own step; NaN if none
  bool in_float;  ///< whether the program takes the step to that time in float
};

/// Records that are left out.
struct LeftOut {
  UnusedRecords unused;
  std::uint64_t rounded = 0;  ///< tmax is not 1, and no query of doubles stands for what was asked
};

/// Passes on what can be judged of a recording, in order. If tmax is not 1, that is the query that ends at
/// tmax. But below 1, a reported collision with a time is judged in the whole step, where the same times are
/// late (and a collision after tmax counts as found), and any other answer on the rounded query if doubles do
/// not hold the exact one, and it is decided in the same way. Throws Error.
LeftOut read_judgeable(const std::filesystem::path& file, const std::function<void(RecordedAnswer&&)>& sink);

/// Some answers, no two different ones to the same query, and a subject that gives them under the name
/// recorded_name. It promises lower bounds if any answer has a time.
struct RecordedPass {
  std::unique_ptr<Subject> subject;
  std::vector<RecordedAnswer> answers;
};

/// All answers, in as few passes as possible: a simulation may ask the same query twice, and get different
/// answers.
std::vector<RecordedPass> in_passes(std::vector<RecordedAnswer> answers);

}  // namespace nearmiss

// What the CCD of a recording answered, as a subject.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string_view>

#include "ccd/subjects/subject.hpp"
#include "corpus/recording.hpp"

namespace nearmiss {

inline constexpr std::string_view recorded_name = "recorded";

/// A query and its recorded answer, as they are judged.
struct RecordedAnswer {
  std::uint64_t number;  ///< of the record
  Query query;
  int answer;   ///< as in nearmiss_subject.h
  double time;  ///< in the query's own step; NaN if none
};

/// Records that are left out.
struct LeftOut {
  UnusedRecords unused;
  std::uint64_t rounded = 0;  ///< tmax is not 1, and no query of doubles stands for what was asked
};

/// Passes on what can be judged of a recording, in order. If tmax is not 1, that is the query whose end is at tmax, if doubles hold
/// it. If they do not, and tmax is below 1, a reported collision is judged in the whole step, where the same times are late,
/// and another answer on the rounded query, if that is decided as the exact one. Throws Error.
LeftOut read_judgeable(const std::filesystem::path& file, const std::function<void(RecordedAnswer&&)>& sink);

/// A subject that gives the recorded answers, under the name recorded_name. It promises lower bounds if every collision
/// has a time. A query that was answered in two ways is a fault (inconsistent); one that was never recorded is not asked.
std::unique_ptr<Subject> recorded_answers(std::span<const RecordedAnswer> all);

}  // namespace nearmiss

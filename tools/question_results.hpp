// The results of nearmiss distance and nearmiss step, as text and JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "fuzz/questions/distance.hpp"
#include "fuzz/questions/question_trial.hpp"
#include "fuzz/questions/step.hpp"

namespace nearmiss::tools {

/// The text begins with a table, which has a row for each subject and kind. Lines follow about subjects that
/// are right in one range of a property of the queries, such as an angle, and fail elsewhere. At the end, the
/// text has the simplest findings.
std::string text_of(const QuestionResults<DistanceQuestion>& results);
std::string text_of(const QuestionResults<StepQuestion>& results);

/// The content of text_of as JSON, with exact queries.
nlohmann::ordered_json json_of(const QuestionResults<DistanceQuestion>& results);
nlohmann::ordered_json json_of(const QuestionResults<StepQuestion>& results);

/// The section `distances` of a report: those parts of `results`, the JSON of nearmiss distance, that the
/// report shows. Throws an exception of nlohmann if `results` is other JSON.
nlohmann::ordered_json distances_section(const nlohmann::ordered_json& results);

}  // namespace nearmiss::tools

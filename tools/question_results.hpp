// The results of nearmiss distance and nearmiss step, as text and JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "fuzz/questions/distance.hpp"
#include "fuzz/questions/question_trial.hpp"
#include "fuzz/questions/step.hpp"

namespace nearmiss::tools {

/// A table of subjects and kinds, the sizes and angles at which each is right, and the findings.
std::string text_of(const QuestionResults<DistanceQuestion>& results);
std::string text_of(const QuestionResults<StepQuestion>& results);

/// The same, with the queries exactly.
nlohmann::ordered_json json_of(const QuestionResults<DistanceQuestion>& results);
nlohmann::ordered_json json_of(const QuestionResults<StepQuestion>& results);

/// What a report shows of the JSON of distances: its section `distances`. Throws an exception of nlohmann if it
/// is no such JSON.
nlohmann::ordered_json distances_section(const nlohmann::ordered_json& results);

}  // namespace nearmiss::tools

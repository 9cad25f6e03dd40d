#include "reports/sections/headline.hpp"

#include <fmt/format.h>

#include <vector>

#include "reports/sections/summary.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

/// "a", "a and b", "a, b and c"
std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

/// The names of subjects, or their number if there are many.
std::string subjects(const std::vector<std::string>& names) {
  return names.size() <= 4 ? listed(names) : fmt::format("{} subjects", names.size());
}

/// @param asked number of subjects of the campaign
std::string since_text(const Changes& since, std::size_t asked) {
  if (asked != 0 && since.absent_subjects.size() == asked) return "no subject is in the baseline";
  std::vector<std::string> news;
  if (const std::size_t ways = since.new_signatures.size(); ways != 0)
    news.push_back(counted(ways, "new way to fail", "new ways to fail"));
  std::size_t worse = 0;
  for (const ChangedRate& rate : since.rates) worse += rate.worse() ? 1 : 0;
  if (worse != 0) news.push_back(counted(worse, "worse rate", "worse rates"));
  std::size_t subjects = 0;
  std::size_t families = 0;
  for (const ChangedTime& time : since.times.changed)
    if (time.slower()) ++(time.is_of_subject() ? subjects : families);
  if (subjects != 0) news.push_back(counted(subjects, "subject slower", "subjects slower"));
  if (families != 0) news.push_back(counted(families, "family slower", "families slower"));
  const std::size_t lasting = since.lasting_signatures.size();
  const std::size_t gone = since.gone_signatures.size();
  return (lasting == 0 ? "" : counted(lasting, "way to fail", "ways to fail") + " as before, ") +
         (news.empty() ? "nothing worse" : listed(news)) + " since the baseline" +
         (gone == 0 ? "" : ", and " + counted(gone, "way to fail is gone", "ways to fail are gone"));
}

}  // namespace

Headline headline(const Statistics& statistics, const std::optional<Changes>& since) {
  std::vector<std::string> clean;
  std::vector<std::string> failed;
  for (const SubjectVerdict& each : subject_verdicts(statistics))
    (each.clean ? clean : failed).push_back(each.subject);
  const std::string complaint = oracle_complaint(statistics);
  std::string text;
  if (!complaint.empty()) text = "The oracle cannot be trusted: " + complaint + ". ";
  if (!failed.empty()) text += subjects(failed) + " failed";
  if (!clean.empty()) text += fmt::format("{}{} did not fail", failed.empty() ? "" : "; ", subjects(clean));
  if (const auto queries = statistics.oracle_total().queries; queries != 0)
    text += fmt::format(", in {}", counted(queries, "query", "queries"));
  if (since)
    text += fmt::format("{}{}", text.empty() ? "" : "; ", since_text(*since, clean.size() + failed.size()));
  if (text.empty()) text = "No subject was asked";
  const bool fine = since ? !since->fails(failed) : failed.empty();
  return {fine && complaint.empty(), text + "."};
}

}  // namespace nearmiss

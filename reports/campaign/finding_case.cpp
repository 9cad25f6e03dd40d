#include "reports/campaign/finding_case.hpp"

#include <fmt/format.h>

#include <cctype>
#include <functional>
#include <sstream>

#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

std::string subject_of(const Finding& finding) {
  return finding.subject.empty() ? "oracle" : finding.subject;
}

}  // namespace

Finding of_shrunk(const Finding& finding) {
  Finding shrunk = finding;
  shrunk.query = finding.shrunk;
  shrunk.ratio = 0;
  if (finding.is_shrunk) shrunk.provenance = "shrunk from " + finding.provenance;
  return shrunk;
}

Case to_case(const Finding& finding) {
  std::string why = fmt::format("{} of {}", name(finding.what), subject_of(finding));
  if (finding.ratio > 0)
    why += finding.what == Finding::What::late ? fmt::format(", by {:.3g} of the step", finding.ratio)
                                               : fmt::format(", {}", times_the_bound(finding.ratio));
  Case result{.name = {}, .query = finding.query, .truth = {}, .why = why, .provenance = finding.provenance};
  if (finding.what == Finding::What::false_negative || has_time(finding.what)) result.truth = true;
  if (finding.what == Finding::What::refuted_bound) result.truth = false;
  return result;
}

std::string case_file_name(const Finding& finding, std::string_view id) {
  return fmt::format("{}-{}-{}.case", name(finding.what), file_name(subject_of(finding)), id);
}

std::string file_name(std::string text) {
  constexpr std::size_t most = 60;
  constexpr std::size_t kept = 43;
  if (text.size() > most)
    text = fmt::format("{}-{:016x}", text.substr(0, kept), std::hash<std::string>()(text));
  for (char& c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '.') c = '_';
  return text;
}

std::vector<std::string> error_lines(const Finding& finding) {
  std::vector<std::string> lines;
  std::istringstream text(finding.errors);
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

}  // namespace nearmiss

#include "reports/sections/shown.hpp"
#include "reports/statistics/failure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <set>

#include "corpus/query_text.hpp"
#include "reports/campaign/finding_case.hpp"
#include "reports/text/shell.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

std::string without_case(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

/// Gives each file a name of its own, even on a file system that does not distinguish upper and lower case.
class OwnNames {
 public:
  /// NAME.case, or NAME-2.case, NAME-3.case ... if NAME.case is taken.
  std::string take(const std::string& name) {
    std::string own = name;
    for (int i = 2; !taken_.insert(without_case(own)).second; ++i) own = fmt::format("{}-{}", name, i);
    return own + ".case";
  }

 private:
  std::set<std::string> taken_;
};

ShownFinding shown(const Finding& finding, std::uint64_t seen, std::size_t number) {
  const auto exported = [&](const Finding& what, std::string_view suffix) {
    Exported result{case_file_name(what, fmt::format("{:03}{}", number, suffix)), to_case(what)};
    result.content.why += fmt::format(": {}; times seen: {}", finding.signature, with_separators(seen));
    return result;
  };
  ShownFinding result{finding, seen, exported(of_shrunk(finding), ""), exported(finding, "-original")};
  if (finding.is_shrunk) result.original.content.why += "; before it was shrunk";
  return result;
}

}  // namespace

std::vector<ShownFinding> shown_findings(const Campaign& campaign) {
  FirstFindings first;
  // for each name of a file without its number, in lower case: the number of findings with this name so far
  std::map<std::string, std::size_t> number;
  std::vector<ShownFinding> result;
  for (Finding& finding : campaign.findings())
    if (first.take(finding))
      result.push_back(shown(finding, campaign.statistics.times_seen(signature_of(finding)),
                             ++number[without_case(case_file_name(finding, ""))]));
  return result;
}

std::vector<ShownFarthest> farthest_cases(const Statistics& statistics) {
  OwnNames names;
  std::vector<ShownFarthest> cases;
  for (const auto& [key, counts] : statistics.counts) {
    if (counts.farthest.empty()) continue;
    const FarCase& far = counts.farthest.front();
    const std::string name =
        fmt::format("{}-{}-{}", file_name(key.subject), short_name(key.kind), file_name(key.family));
    cases.push_back({key,
                     far,
                     counts.distance_unit(),
                     {names.take(name),
                      {.name = {},
                       .query = far.query,
                       .truth = false,
                       .why = fmt::format("false positive of {}, {}", key.subject,
                                          times_the_bound(far.ratio, counts.distance_unit())),
                       .provenance = far.provenance}}});
  }
  return cases;
}

namespace {

const Run* run_of(const Campaign& campaign, const Finding& finding) {
  for (const Run& run : campaign.runs)
    if (std::find(run.findings.begin(), run.findings.end(), finding) != run.findings.end()) return &run;
  return nullptr;
}

/// The argument of --subject that names a subject's plug-in, with its path on the machine that ran the
/// subject; nothing for a built-in subject.
std::optional<std::string> plugin_text(const Run& run, const std::string& subject) {
  for (const Shard& shard : run.shards)
    if (const auto text = shard.environment.find(std::string(about_plugin) + subject);
        text != shard.environment.end())
      return text->second;
  return std::nullopt;
}

/// The argument of --subject that names a subject of a run. It includes the scene's bound if the subject was
/// asked with that bound.
std::string text_of(const Run& run, std::string subject) {
  if (is_beyond_contract(subject)) subject.resize(subject.size() - beyond_contract.size());
  const auto renamed = run.info.find(std::string(about_subject) + subject);
  std::string text = renamed == run.info.end() ? subject : renamed->second;
  if (text.ends_with(of_scene))
    text.replace(text.rfind('@') + 1, std::string::npos, fact(run.info, "scene's bound"));
  return plugin_text(run, subject).value_or(text);
}

}  // namespace

std::string replay_command(const Campaign& campaign, const ShownFinding& shown) {
  std::string command = fmt::format("nearmiss replay cases/{}", shown.shrunk.file);
  const std::string& subject = shown.finding.subject;
  if (subject.empty()) return command + " --compare 1";
  const std::string& before = shown.finding.broken_since;
  const Run* const run = run_of(campaign, shown.finding);
  if (run == nullptr) return command + fmt::format(" --subject {}", shell_quoted(subject));
  const std::string texts = (before.empty() ? "" : text_of(*run, before) + ",") + text_of(*run, subject);
  command += fmt::format(" --subject {}", shell_quoted(texts));
  if (!before.empty() && run->info.contains("versions"))
    command += fmt::format(" --versions {}", shell_quoted(before + "," + subject));
  if (is_beyond_contract(subject)) command += " --beyond-contract";
  if (shown.finding.what == Finding::What::committed) command += " --fail-on committed";
  const bool has_plugin = plugin_text(*run, subject) || plugin_text(*run, before);
  for (const char* option : {"bound", "query-time", "query-memory"})
    if (const auto given = run->info.find(option);
        given != run->info.end() && (has_plugin || given->first == "bound"))
      command += fmt::format(" --{} {}", option, shell_quoted(given->second));
  return command;
}

}  // namespace nearmiss

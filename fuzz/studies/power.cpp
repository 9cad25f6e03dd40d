#include "fuzz/studies/power.hpp"

#include <algorithm>
#include <charconv>

#include "fuzz/trial/case_order.hpp"
#include "reports/statistics/failure.hpp"

namespace nearmiss {

namespace {

/// The index of the finding's query, read from the finding's provenance "family:seed:index".
std::uint64_t index_of(const Finding& finding) {
  const std::string& text = finding.provenance;
  std::uint64_t index = 0;
  std::from_chars(text.data() + text.rfind(':') + 1, text.data() + text.size(), index);
  return index;
}

}  // namespace

std::vector<Family> families_for(const Subject& subject, std::span<const Family> of_contact,
                                 std::span<const Family> of_vertices) {
  std::vector<Family> chosen(of_contact.begin(), of_contact.end());
  if (subject.takes_separation(Kind::vertex_triangle))
    for (const Family& family : of_contact) chosen.push_back(with_separation(family, drawn_separation));
  if (subject.takes_separation(Kind::vertex_vertex) || subject.takes_separation(Kind::vertex_edge))
    for (const Family& family : of_vertices) chosen.push_back(as_asked(family));
  return chosen;
}

std::optional<FirstFailure> find_first_failure(const CampaignPlan& plan, const Subjects& subjects,
                                               const Stop& stop) {
  std::optional<FirstFailure> first;
  CampaignProgress before;
  run_campaign(
      plan, subjects,
      [&](TrialResult&& result, const CampaignProgress& now) {
        for (Finding& each : result.findings) {
          if (each.subject.empty() || !breaks_promise(failure_of(signature_of(each)))) continue;
          const std::uint64_t cases = cases_up_to(plan, each.family, index_of(each));
          if (first && first->cases <= cases) continue;
          const double part =
              static_cast<double>(cases - before.cases) / static_cast<double>(now.cases - before.cases);
          const auto time = before.elapsed + part * (now.elapsed - before.elapsed);
          first = {std::move(each), time.count(), cases};
        }
        before = now;
        return !first;
      },
      stop);
  return first;
}

}  // namespace nearmiss

#include "reports/report.hpp"

#include <fmt/format.h>

#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "ccd/query/printable.hpp"
#include "corpus/query_text.hpp"
#include "reports/sections/verdicts.hpp"
#include "reports/statistics/family.hpp"
#include "reports/text/text.hpp"

namespace nearmiss {

namespace {

/// The text, escaped for an element or an attribute of XML. Control characters other than line ends become
/// "?", because XML does not allow most of them.
std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += static_cast<unsigned char>(c) < ' ' && c != '\n' ? '?' : c;
    }
  }
  return safe;
}

/// A test; it fails if `message` is not empty.
struct Test {
  std::string name, message, text;
};

std::string suite_xml(const std::string& name, const std::vector<Test>& tests) {
  std::size_t failed = 0;
  std::string rows;
  for (const Test& each : tests) {
    rows +=
        fmt::format(R"(    <testcase classname="nearmiss.{}" name="{}")", escaped(name), escaped(each.name));
    if (each.message.empty()) {
      rows += "/>\n";
      continue;
    }
    ++failed;
    rows += fmt::format(">\n      <failure message=\"{}\" type=\"nearmiss\">{}</failure>\n    </testcase>\n",
                        escaped(each.message), escaped(each.text));
  }
  return fmt::format(
      "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"0\">\n{}  </testsuite>\n",
      escaped(name), tests.size(), failed, rows);
}

/// "missed 3 of 50 collisions". For a failure without a count, the message is only the verb: "was asked
/// nothing".
std::string message_of(const FailureInfo& failure, const Counts& counts) {
  if (failure.one.empty()) return std::string(failure.verb);
  return fmt::format("{} {} of {}", failure.verb, with_separators(failure.count(counts)),
                     counted(failure.total(counts), failure.one, failure.many));
}

/// "missed 3 of 50 collisions; exceeded its bound in 1 of 7 false positives"
std::string message_of(const ClassKey& key, const Counts& counts, const Failures& failing) {
  std::string message;
  for (const FailureKind kind : in_common(failures_of(key.subject, counts), failing)) {
    if (!message.empty()) message += "; ";
    message += message_of(failure_info(kind), counts);
  }
  return message;
}

std::string commands(const Campaign& campaign) {
  std::string lines;
  for (const Run& run : campaign.runs)
    if (const std::string again = fact(run.info, "again"); !again.empty())
      lines += fmt::format("again: {}\n", printable(again));
  return lines;
}

/// The shrunk queries of some findings, in the form that nearmiss replay reads. Takes only findings that
/// `chosen` accepts, and leaves out findings that reports only show (is_only_shown). Takes the first finding
/// of each signature, for at most three signatures.
template <class Chosen>
std::string queries(const std::vector<Finding>& findings, const Chosen& chosen) {
  constexpr std::size_t most = 3;
  std::string lines;
  std::set<Signature> shown;
  for (const Finding& each : findings)
    if (shown.size() < most && chosen(each) && !is_only_shown(each.what) &&
        shown.insert(signature_of(each)).second)
      lines += fmt::format("{}, {}; {} query:\n{}\n", name(each.what), printable(each.signature),
                           short_name(each.shrunk.kind), to_readable(each.shrunk));
  return lines;
}

/// Example queries for a test that failed. They come from findings whose query has the test's class or, if
/// there is no such finding, from findings in families of that class.
std::string queries_of(const ClassKey& key, const std::vector<Finding>& findings) {
  const auto is_own = [&](const Finding& each) {
    return each.subject == key.subject && each.query.kind == key.kind;
  };
  std::string own =
      queries(findings, [&](const Finding& each) { return is_own(each) && each.query_class == key.of; });
  if (!own.empty()) return own;
  return queries(findings,
                 [&](const Finding& each) { return is_own(each) && class_of(each.family) == key.of; });
}

/// The text with each of `characters` replaced by % and its hexadecimal code.
std::string percent_encoded(std::string_view text, std::string_view characters) {
  std::string safe;
  for (const char c : text)
    safe += characters.find(c) == std::string_view::npos ? std::string(1, c) : fmt::format("%{:02X}", c);
  return safe;
}

}  // namespace

std::string junit_xml(const Campaign& campaign, const Failures& failing) {
  const std::vector<Finding> findings = campaign.findings();
  const std::string again = commands(campaign);
  std::map<std::string, std::vector<Test>> suites;
  for (const auto& [key, sum] : by_class(campaign.statistics)) {
    const std::string message = is_beyond_contract(key.subject) ? "" : message_of(key, sum.counts, failing);
    suites[key.subject].push_back(
        {fmt::format("{}, {} families", short_name(key.kind), name(key.of)), message,
         message.empty() ? "" : message + "\n" + queries_of(key, findings) + again});
  }
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"nearmiss\">\n";
  if (const std::string complaint = oracle_complaint(campaign.statistics); !complaint.empty())
    xml += suite_xml("oracle", {{"agrees with itself", complaint, queries(findings, [](const Finding& each) {
                                                                    return each.subject.empty();
                                                                  }) + again}});
  for (const auto& [subject, tests] : suites) xml += suite_xml(subject, tests);
  return xml + "</testsuites>\n";
}

std::string github_annotations(const Campaign& campaign, const Failures& failing) {
  const auto line = [](std::string_view title, std::string_view message) {
    // A colon or a comma would end the title, and a line end would end the annotation. A % would begin an
    // escaped character.
    return fmt::format("::error title={}::{}\n", percent_encoded(title, "%:,"),
                       percent_encoded(message, "%\n"));
  };
  const std::vector<Finding> findings = campaign.findings();
  std::string lines;
  if (const std::string complaint = oracle_complaint(campaign.statistics); !complaint.empty())
    lines += line("nearmiss: the oracle", complaint);
  for (const SubjectVerdict& verdict : subject_verdicts(campaign.statistics, failing))
    for (const auto& [kind, said] : verdict.said) {
      const auto what = finding_of(kind);
      std::string text = said;
      for (const Finding& each : findings) {
        if (each.subject != verdict.subject || each.what != what) continue;
        text += fmt::format("\n{} query: {}", short_name(each.shrunk.kind), to_line(each.shrunk));
        break;
      }
      lines += line("nearmiss: " + printable(verdict.subject), text);
    }
  return lines;
}

}  // namespace nearmiss

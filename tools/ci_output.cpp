#include "tools/ci_output.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "ccd/query/error.hpp"
#include "corpus/file.hpp"
#include "reports/junit.hpp"

namespace nearmiss::tools {

void CiOutput::add_to(CLI::App& command) {
  command
      .add_option("--junit", junit_,
                  "Write the results as JUnit's XML: a test for each subject, kind and class of families")
      ->type_name("FILE");
  command.add_flag("--github", github_, "Print each failure as an annotation of GitHub's workflows, too");
}

void CiOutput::expect_writable(std::span<const OptionFile> others) const {
  if (junit_.empty()) return;
  // Unlike --json, --junit does not take - for standard output.
  if (junit_ == "-") throw Error("--junit: found '-', expected a file");
  tools::expect_writable(junit_, "--junit");
  for (const OptionFile& other : others) expect_different({junit_, "--junit"}, other);
}

void CiOutput::write(const Campaign& campaign, const Failures& failing, std::FILE* text) const {
  if (!junit_.empty()) replace_file(junit_, junit_xml(campaign, failing));
  if (github_) fmt::print(text, "{}", github_annotations(campaign, failing));
}

}  // namespace nearmiss::tools

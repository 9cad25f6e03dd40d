// The oracle judges the CCDs, so it uses no code of ccd/ except the queries. The test reads the includes of
// each folder from the sources.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace nearmiss {
namespace {

namespace fs = std::filesystem;

const fs::path source = NEARMISS_SOURCE;

/// The headers that a file includes in quotes or angle brackets, as "folder/file.hpp".
std::set<std::string> includes(const fs::path& file) {
  static const std::regex line("^\\s*#\\s*include\\s*[\"<]([^\">]+)[\">].*");
  std::set<std::string> found;
  std::ifstream in(file);
  for (std::string text; std::getline(in, text);)
    if (std::smatch match; std::regex_match(text, match, line) && fs::exists(source / match[1].str()))
      found.insert(match[1]);
  return found;
}

/// All files below a folder except npm's packages.
std::vector<fs::path> code(const std::string& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(source / folder))
    if (entry.is_regular_file() && entry.path().string().find("/node_modules/") == std::string::npos)
      files.push_back(entry);
  return files;
}

/// For each file of a folder, the project's headers that it includes from other folders.
std::map<std::string, std::set<std::string>> borrowed(const std::string& folder) {
  std::map<std::string, std::set<std::string>> by_file;
  for (const fs::path& file : code(folder))
    for (const std::string& header : includes(file))
      if (!header.starts_with(folder + "/")) by_file[fs::relative(file, source)].insert(header);
  return by_file;
}

/// The folder of the checker of certificates. The comparison of the oracle's methods uses this checker.
constexpr const char* checker = "tools/certificates";

/// The folder of the library that offers the oracle and wang to other programs. No other part of the oracle
/// uses it.
constexpr const char* library = "oracle/interface/";

/// The sub-folder of oracle/ that contains a header; "" for oracle/ itself and for other folders.
std::string part_of(const std::string& header) {
  const fs::path path(header);
  return *path.begin() == "oracle" && path.parent_path() != "oracle" ? path.parent_path().filename() : "";
}

TEST(Independence, TheOracleUsesQueriesAloneOfCcd) {
  for (const fs::path& file : code("oracle"))
    for (const std::string& header : includes(file)) {
      if (fs::relative(file, source).string().starts_with(library)) continue;
      EXPECT_FALSE(header.starts_with(library)) << file << " includes " << header;
      const bool is_check = part_of(fs::relative(file, source)) == "agreement" && header.starts_with(checker);
      if (!header.starts_with("oracle/") && !is_check) {
        EXPECT_TRUE(header.starts_with("ccd/query/")) << file << " includes " << header;
      }
    }
}

TEST(Independence, ARoomOfCcdIncludesFromThoseBelowItAlone) {
  EXPECT_THAT(borrowed("ccd/query"), ::testing::IsEmpty());
  for (const auto& [file, headers] : borrowed("ccd/wang"))
    for (const std::string& header : headers)
      EXPECT_TRUE(header.starts_with("ccd/query/")) << file << ": " << header;
}

TEST(Independence, APartOfTheOracleIncludesFromItselfAndTheseAlone) {
  const std::map<std::string, std::set<std::string>> parts{
      {"arithmetic", {}},
      {"filter", {"arithmetic"}},
      {"exact", {"arithmetic"}},
      {"parity", {}},
      {"distance", {"arithmetic", "exact"}},
      {"certificates", {"", "arithmetic", "distance", "exact"}},
      {"agreement", {"", "certificates", "parity"}}};
  std::set<std::string> found;
  for (const fs::path& file : code("oracle")) {
    const std::string part = part_of(fs::relative(file, source));
    if (part.empty() || part == "interface") continue;
    ASSERT_TRUE(parts.contains(part)) << file;
    found.insert(part);
    for (const std::string& header : includes(file))
      if (header.starts_with("oracle/") && part_of(header) != part) {
        EXPECT_TRUE(parts.at(part).contains(part_of(header))) << file << " includes " << header;
      }
  }
  EXPECT_EQ(found.size(), parts.size());
}

TEST(Independence, TheCheckerOfCertificatesUsesNothingElse) {
  ASSERT_FALSE(code(checker).empty());
  EXPECT_THAT(borrowed(checker), ::testing::IsEmpty());
}

TEST(Independence, AFolderIncludesFromThoseBeforeItAlone) {
  const std::vector<std::string> floors{"ccd", "oracle", "corpus", "reports", "fuzz", "tools"};
  for (std::size_t floor = 0; floor < floors.size(); ++floor) {
    const auto files = code(floors[floor]);
    ASSERT_FALSE(files.empty()) << floors[floor];
    for (const fs::path& file : files)
      for (const std::string& header : includes(file)) {
        if (header.starts_with(checker)) continue;
        const std::string folder = header.substr(0, header.find('/'));
        const auto from = std::find(floors.begin(), floors.end(), folder);
        EXPECT_LE(from - floors.begin(), static_cast<std::ptrdiff_t>(floor))
            << file << " includes " << header;
      }
  }
}

}  // namespace
}  // namespace nearmiss

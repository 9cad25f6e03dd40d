// The plug-ins of tests/plugin/, and the queries that they are asked.
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "ccd/subjects/subject.hpp"
#include "tests/queries.hpp"

namespace nearmiss::testing {

inline std::string plugin(const std::string& name) { return NEARMISS_PLUGINS "/" + name + ".so"; }

/// The index in queries() of one query. At this query, a plug-in does what its name says: the plug-in `crash`
/// crashes, for example.
inline constexpr std::size_t chosen = 40;
inline std::vector<Query> queries() {
  std::vector<Query> some(100, falling_vertex(0.25, 0.25, 1, -1));
  some[chosen].x[0] = 0.95;
  return some;
}

inline std::vector<Verdict> answers_of(const Subject& subject, const std::vector<Query>& asked) {
  std::vector<Verdict> verdicts(asked.size());
  subject.decide(asked, verdicts);
  return verdicts;
}

/// A copy of a plug-in. The path of the copy identifies the processes that load the copy.
class CopiedPlugin {
 public:
  explicit CopiedPlugin(const std::string& name) {
    std::string folder = std::filesystem::temp_directory_path() / "nearmiss-XXXXXX";
    path_ = std::filesystem::path(mkdtemp(folder.data())) / (name + ".so");
    std::filesystem::copy(plugin(name), path_);
  }
  CopiedPlugin(const CopiedPlugin&) = delete;
  CopiedPlugin& operator=(const CopiedPlugin&) = delete;
  ~CopiedPlugin() { std::filesystem::remove_all(path_.parent_path()); }

  [[nodiscard]] std::string path() const { return path_; }

  /// The number of processes that have path() among their arguments.
  [[nodiscard]] int processes() const {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
      std::ifstream file(entry.path() / "cmdline", std::ios::binary);
      std::string arguments;
      std::getline(file, arguments, '\n');  // `arguments` is empty if the process has just ended
      count += arguments.find(path_) != std::string::npos ? 1 : 0;
    }
    return count;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace nearmiss::testing

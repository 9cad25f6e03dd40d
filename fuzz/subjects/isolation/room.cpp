#include "fuzz/subjects/isolation/room.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>

#include "fuzz/subjects/isolation/trial_error.hpp"

namespace nearmiss::isolation {

namespace {

constexpr std::uint64_t unknown = std::numeric_limits<std::uint64_t>::max();

/// The number after a name in a file; if the name is "", the number at the start of the file.
std::optional<std::uint64_t> number_in(const std::filesystem::path& file, const std::string& name = "") {
  std::ifstream in(file);
  std::uint64_t number = 0;
  for (std::string word; !name.empty() && in >> word && word != name;) {
  }
  return in >> number ? std::optional(number) : std::nullopt;
}

/// The memory that a control group has left. Inactive pages of files in the system's cache count as free
/// memory.
std::uint64_t left_in(const std::filesystem::path& group) {
  const auto most = number_in(group / "memory.max");
  const auto used = number_in(group / "memory.current");
  if (!most || !used) return unknown;  // "max" means no limit
  const std::uint64_t of_files = number_in(group / "memory.stat", "inactive_file").value_or(0);
  return *most - std::min(*most, *used - std::min(*used, of_files));
}

}  // namespace

std::uint64_t memory_left(const std::filesystem::path& root) {
  constexpr std::uint64_t unit = 1024;
  const auto kibibytes = number_in(root / "proc/meminfo", "MemAvailable:");
  std::uint64_t left = kibibytes ? unit * *kibibytes : unknown;
  std::ifstream groups(root / "proc/self/cgroup");
  const std::string version_2 = "0::/";
  for (std::string line; std::getline(groups, line);) {
    if (!line.starts_with(version_2)) continue;
    // A control group may have a limit of its own. In addition, the limits of all groups that contain this
    // group apply to it.
    std::filesystem::path within = line.substr(version_2.size());
    for (left = std::min(left, left_in(root / "sys/fs/cgroup")); !within.empty();
         within = within.parent_path())
      left = std::min(left, left_in(root / "sys/fs/cgroup" / within));
  }
  return left;
}

void expect_memory(const std::string& what, std::uint64_t bytes) {
  constexpr std::uint64_t mebibyte = 1 << 20;
  if (const std::uint64_t left = memory_left(); bytes > left)
    throw TrialError(fmt::format("{} needs {} MiB of memory, found {} MiB left, expected fewer queries", what,
                                 (bytes + mebibyte - 1) / mebibyte, left / mebibyte));
}

}  // namespace nearmiss::isolation

#include "fuzz/subjects/isolation/worker/namespaces.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

#include <string>

namespace nearmiss::isolation {

namespace {

void write_to(const char* path, const std::string& text) {
  const int file = open(path, O_WRONLY | O_CLOEXEC);
  if (file < 0) return;
  static_cast<void>(!write(file, text.data(), text.size()));
  close(file);
}

/// Root keeps its rights to files only in its own user namespace, so a new one is the second choice.
bool enter(int namespaces) {
  if (unshare(namespaces) == 0) return true;
  const auto same = [](unsigned id) { return std::to_string(id) + ' ' + std::to_string(id) + " 1"; };
  const std::string user = same(geteuid());
  const std::string group = same(getegid());
  if (unshare(CLONE_NEWUSER | namespaces) != 0) return false;
  write_to("/proc/self/setgroups", "deny");  // otherwise the group cannot be kept
  write_to("/proc/self/uid_map", user);
  write_to("/proc/self/gid_map", group);
  return true;
}

}  // namespace

bool enter_namespaces() { return enter(CLONE_NEWPID | CLONE_NEWNS | CLONE_NEWNET | CLONE_NEWIPC); }

void leave_network() { enter(CLONE_NEWNET); }

void mount_own_folders(std::uint64_t bytes) {
  if (mount(nullptr, "/", nullptr, MS_REC | MS_SLAVE, nullptr) != 0) return;
  mount("proc", "/proc", "proc", MS_NOSUID | MS_NODEV | MS_NOEXEC | MS_RDONLY, nullptr);
  const std::string options = "mode=1777" + (bytes == 0 ? "" : ",size=" + std::to_string(bytes));
  mount("tmpfs", "/dev/shm", "tmpfs", MS_NOSUID | MS_NODEV, options.c_str());
  mount("devpts", "/dev/pts", "devpts", MS_NOSUID | MS_NOEXEC, "newinstance,ptmxmode=0666");
}

}  // namespace nearmiss::isolation

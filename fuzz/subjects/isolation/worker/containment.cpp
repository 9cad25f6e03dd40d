#include "fuzz/subjects/isolation/worker/containment.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "fuzz/subjects/isolation/shared.hpp"

namespace nearmiss::isolation {

namespace {

/// The number of threads of all processes of this user. The number of links of the folder /proc/PID/task is
/// the number of threads plus 2.
unsigned long threads_of_user() {
  DIR* const processes = opendir("/proc");
  if (processes == nullptr) return 0;
  unsigned long count = 0;
  while (const dirent* entry = readdir(processes)) {
    if (entry->d_name[0] < '0' || entry->d_name[0] > '9') continue;
    const std::string threads = std::string("/proc/") + entry->d_name + "/task";
    struct stat about {};
    if (stat(threads.c_str(), &about) == 0 && about.st_uid == getuid() && about.st_nlink > 2)
      count += about.st_nlink - 2;  // the links . and .. of the folder do not count
  }
  closedir(processes);
  return count;
}

void write_to(const char* path, const std::string& text) {
  const int file = open(path, O_WRONLY | O_CLOEXEC);
  if (file < 0) return;
  static_cast<void>(!write(file, text.data(), text.size()));
  close(file);
}

/// Enters new namespaces. This function first tries to enter them without a new user namespace, because root
/// keeps its rights to files only in its original user namespace.
bool enter(int namespaces) {
  if (unshare(namespaces) == 0) return true;
  const auto same = [](unsigned id) { return std::to_string(id) + ' ' + std::to_string(id) + " 1"; };
  const std::string user = same(geteuid());
  const std::string group = same(getegid());
  if (unshare(CLONE_NEWUSER | namespaces) != 0) return false;
  write_to("/proc/self/setgroups", "deny");  // the system requires this before it accepts gid_map
  write_to("/proc/self/uid_map", user);
  write_to("/proc/self/gid_map", group);
  return true;
}

}  // namespace

void close_files() {
  const int nothing = open("/dev/null", O_RDWR);
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nothing, standard);
  constexpr int first_other = std::max({reply_socket, status_socket, answers_memory}) + 1;
  closefrom(first_other);
}

void forbid_core_dumps() {
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
}

void be_ended_first_for_want_of_memory() {
  std::FILE* const file = std::fopen("/proc/self/oom_score_adj", "w");
  if (file == nullptr) return;
  std::fputs("1000", file);  // the largest value
  std::fclose(file);
}

void limit_processes(unsigned long more) {
  rlimit limit{};
  getrlimit(RLIMIT_NPROC, &limit);
  limit.rlim_cur = limit.rlim_max = std::min<rlim_t>(limit.rlim_max, threads_of_user() + more);
  setrlimit(RLIMIT_NPROC, &limit);
}

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

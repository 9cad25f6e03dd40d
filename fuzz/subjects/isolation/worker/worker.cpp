// nearmiss-worker CODE PLUGIN BYTES NAMESPACE: runs a plug-in in a process of its own, under a supervisor
// that never runs the plug-in's code. CODE is a digest of the code that the worker shares with nearmiss; a
// worker with another digest refuses to work. BYTES limits the plug-in's memory; 0 means no limit. The
// supervisor reads what the plug-in's process writes to standard error. When that process has ended, the
// supervisor tells nearmiss how the process ended and what the process wrote last. When the plug-in's process
// or nearmiss ends, the supervisor ends all processes that the plug-in has started, and itself.
//
// If NAMESPACE is 1 and the system allows it, the supervisor is process 1 of a PID namespace, in which no
// other process can stop, kill or trace it. A guard outside the namespace, which has no process id inside it,
// also waits until nearmiss ends, and then kills the supervisor. The system then ends all processes of the
// namespace.
#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>

#include "fuzz/subjects/isolation/shared.hpp"
#include "fuzz/subjects/isolation/worker/answering.hpp"
#include "fuzz/subjects/isolation/worker/containment.hpp"
#include "fuzz/subjects/isolation/worker/privileges.hpp"

namespace {

using namespace nearmiss::isolation;

constexpr unsigned long most_processes = 256;

struct Assignment {
  const char* plugin;
  std::uint64_t bytes;
  bool own_namespace;
};

void tell(const Status& status) {
  static_cast<void>(send(status_socket, &status, sizeof status, MSG_NOSIGNAL | MSG_DONTWAIT));
}

void close_channel() {
  for (const int each : {reply_socket, answers_memory}) close(each);
}

sigset_t end_of_child() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGCHLD);
  return signals;
}

/// Reaps all children that have ended, including adopted orphans. If `process` is one of these children,
/// returns how it ended, and also ends its process group.
std::optional<siginfo_t> end_of(pid_t process) {
  std::optional<siginfo_t> end;
  siginfo_t how{};
  while (waitid(P_ALL, 0, &how, WEXITED | WNOHANG | WNOWAIT) == 0 && how.si_pid != 0) {
    if (how.si_pid == process) {
      end = how;
      // The signal is sent before the process is reaped, because the group's number may belong to another
      // group afterwards.
      kill(-process, SIGKILL);
    }
    waitpid(how.si_pid, nullptr, 0);
    how.si_pid = 0;
  }
  return end;
}

/// Ends all descendants, including those that have left their session: when a child of this process ends, the
/// children of that child become children of this process, because this process is a subreaper (prctl(2)).
void end_descendants() {
  const auto any_is_left = [] {
    pid_t ended = 1;
    while (ended > 0) ended = waitpid(-1, nullptr, WNOHANG);
    return ended == 0;
  };
  while (any_is_left()) {
    std::ifstream children("/proc/thread-self/children");
    for (pid_t child = 0; children >> child;) kill(child, SIGKILL);
    waitpid(-1, nullptr, 0);
  }
}

/// Reads a pipe, and keeps the last bytes that were written to it.
class LastOutput {
 public:
  /// `pipe` is the descriptor from which the pipe is read; -1 if there is no pipe.
  explicit LastOutput(int pipe) : pipe_(pipe) {
    if (pipe_ >= 0) fcntl(pipe_, F_SETFL, O_NONBLOCK);
  }

  /// The event for poll(2) that the pipe can be read. After the last writer has closed the pipe, the event
  /// has the descriptor -1, which poll(2) ignores.
  [[nodiscard]] pollfd event() const { return {pipe_, POLLIN, 0}; }

  /// Reads the bytes that are in the pipe, but at most 128 KiB, because a process that writes to the pipe may
  /// never stop.
  void read_some() {
    std::array<char, 4096> block{};
    ssize_t size = 1;
    for (int i = 0; i < 32 && pipe_ >= 0 && size > 0; ++i) {
      size = read(pipe_, block.data(), block.size());
      // A zero byte would end the text in Status::errors.
      std::replace(block.begin(), block.end(), '\0', '?');
      if (size > 0) text_.append(block.data(), static_cast<std::size_t>(size));
      if (text_.size() > most) text_.erase(0, text_.size() - most);
    }
    if (size != 0) return;
    close(pipe_);
    pipe_ = -1;
  }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  static constexpr std::size_t most = sizeof(Status::errors);

  int pipe_;
  std::string text_;
};

/// Waits until a child has ended or nearmiss has closed the status socket, and meanwhile reads what the child
/// writes to `errors`. Returns how the child ended; nothing if the child still runs.
std::optional<siginfo_t> watch(pid_t child, LastOutput& errors) {
  const sigset_t wanted = end_of_child();
  const int signals = signalfd(-1, &wanted, SFD_CLOEXEC);
  while (signals >= 0) {
    pollfd events[3]{{status_socket, 0, 0}, {signals, POLLIN, 0}, errors.event()};
    if (poll(events, 3, -1) < 0 && errno != EINTR) break;
    if ((events[0].revents & (POLLHUP | POLLERR)) != 0) break;
    if (events[2].revents != 0) errors.read_some();
    if ((events[1].revents & POLLIN) == 0) continue;
    signalfd_siginfo signal{};
    static_cast<void>(!read(signals, &signal, sizeof signal));
    if (const auto end = end_of(child)) {
      errors.read_some();
      return end;
    }
  }
  return std::nullopt;
}

/// Makes this process the plug-in's process, with `errors` as its standard error. Returns its exit code.
int run_plugin(const Assignment& work, int errors) {
  dup2(errors, STDERR_FILENO);
  close(errors);
  setsid();  // the process gets its own group, so that a signal to this group reaches no process of nearmiss
  const sigset_t blocked = end_of_child();
  sigprocmask(SIG_UNBLOCK, &blocked, nullptr);
  tell({.is_in_namespace = work.own_namespace ? 1 : 0});
  close(status_socket);
  drop_privileges();
  keep_out_of_other_processes();
  keep_out_of_keyrings_and_terminals();
  if (!work.own_namespace) confine_to_itself();
  prctl(PR_SET_DUMPABLE, 1);
  return answer_requests(work.plugin, work.bytes);
}

/// Runs the supervisor, and forks the plug-in's process. Returns only in the plug-in's process.
int supervise(const Assignment& work) {
  // Only a process with more privileges may trace the supervisor, or take its descriptors.
  prctl(PR_SET_DUMPABLE, 0);
  const pid_t supervisor = getpid();
  std::array<int, 2> errors{};
  if (pipe2(errors.data(), O_CLOEXEC) != 0) _exit(1);
  const pid_t process = fork();
  if (process == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != supervisor) _exit(1);  // the supervisor ended before prctl(2) was called
    close(errors[0]);
    return run_plugin(work, errors[1]);
  }
  close_channel();
  close(errors[1]);
  if (process < 0) _exit(1);
  LastOutput last(errors[0]);
  const auto end = watch(process, last);
  if (end) {
    Status ended{.code = end->si_code, .status = end->si_status};
    last.text().copy(ended.errors.data(), ended.errors.size());
    tell(ended);
  }
  if (!work.own_namespace) {
    // If the process has no group of its own yet, the first kill(2) fails, and the second one ends the
    // process.
    if (!end && kill(-process, SIGKILL) != 0) kill(process, SIGKILL);
    end_descendants();
  }
  _exit(0);
}

/// Runs the guard, and forks the supervisor.
int guard(const Assignment& work) {
  const pid_t supervisor = fork();
  if (supervisor == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    setsid();
    mount_own_folders(work.bytes);
    return supervise(work);
  }
  close_channel();
  if (supervisor < 0) _exit(1);
  LastOutput none(-1);
  if (!watch(supervisor, none)) {
    kill(supervisor, SIGKILL);
    waitpid(supervisor, nullptr, 0);  // returns when the namespace is empty
  }
  _exit(0);
}

int run(Assignment work) {
  close_files();
  for (const int signal : {SIGHUP, SIGINT, SIGTERM, SIGPIPE}) std::signal(signal, SIG_IGN);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  forbid_core_dumps();
  be_ended_first_for_want_of_memory();
  limit_processes(most_processes);
  const sigset_t blocked = end_of_child();
  sigprocmask(SIG_BLOCK, &blocked, nullptr);
  work.own_namespace = work.own_namespace && enter_namespaces();
  if (work.own_namespace) return guard(work);
  leave_network();
  return supervise(work);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5 || std::strcmp(argv[1], NEARMISS_WORKER_CODE) != 0) return 2;
  return run({argv[2], std::strtoull(argv[3], nullptr, 10), std::strcmp(argv[4], "1") == 0});
}

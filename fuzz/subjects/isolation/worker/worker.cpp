// nearmiss-worker PLUGIN BYTES: runs a plug-in in a process of its own, under a supervisor that never runs the
// plug-in's code. The supervisor tells nearmiss of the process and how it ended. When the process or nearmiss ends,
// it ends all that the plug-in has started, and itself.
#include <poll.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>

#include "fuzz/subjects/isolation/shared.hpp"
#include "fuzz/subjects/isolation/worker/answering.hpp"
#include "fuzz/subjects/isolation/worker/containment.hpp"
#include "fuzz/subjects/isolation/worker/process_tree.hpp"

namespace {

using namespace nearmiss::isolation;

constexpr unsigned long most_processes = 256;

void tell(const Status& status) {
  static_cast<void>(send(status_socket, &status, sizeof status, MSG_NOSIGNAL | MSG_DONTWAIT));
}

/// How the process ended, once it has.
bool has_ended(pid_t process, siginfo_t& how) {
  how.si_pid = 0;
  return waitid(P_PID, static_cast<id_t>(process), &how, WEXITED | WNOHANG) == 0 && how.si_pid == process;
}

/// Waits until the process has ended, or nearmiss has closed the status socket.
void supervise(pid_t process, int signals) {
  while (true) {
    pollfd events[2]{{status_socket, 0, 0}, {signals, POLLIN, 0}};
    if (poll(events, 2, -1) < 0 && errno != EINTR) return;
    if ((events[0].revents & (POLLHUP | POLLERR)) != 0) return;
    if ((events[1].revents & POLLIN) == 0) continue;
    signalfd_siginfo signal{};
    static_cast<void>(read(signals, &signal, sizeof signal));
    if (siginfo_t how{}; has_ended(process, how)) return tell({process, how.si_code, how.si_status});
  }
}

int run(const char* plugin, std::uint64_t bytes) {
  close_files();
  for (const int signal : {SIGHUP, SIGINT, SIGTERM, SIGPIPE}) std::signal(signal, SIG_IGN);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  leave_network();
  limit_processes(most_processes);
  sigset_t child;
  sigemptyset(&child);
  sigaddset(&child, SIGCHLD);
  sigprocmask(SIG_BLOCK, &child, nullptr);
  const int signals = signalfd(-1, &child, SFD_CLOEXEC);
  const pid_t supervisor = getpid();
  const pid_t process = fork();
  if (process == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != supervisor) return 1;  // it ended before that call
    close(signals);
    close(status_socket);
    sigprocmask(SIG_UNBLOCK, &child, nullptr);
    return answer_requests(plugin, bytes);
  }
  for (const int other : {reply_socket, questions_memory, answers_memory}) close(other);
  if (process < 0 || signals < 0) return 1;
  tell({process, 0, 0});
  supervise(process, signals);
  kill(process, SIGKILL);
  end_descendants();
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return argc == 3 ? run(argv[1], std::strtoull(argv[2], nullptr, 10)) : 2; }

#include "fuzz/subjects/isolation/supervisor.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>

#include "fuzz/subjects/beside.hpp"
#include "fuzz/subjects/isolation/shared.hpp"

namespace nearmiss::isolation {

namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

/// Starts a program, and gives it some descriptors under given numbers. The program gets a session of its
/// own, so that no terminal interrupts it. The program starts with the default reaction to every signal, and
/// blocks no signal.
class Spawn {
 public:
  Spawn() {
    posix_spawn_file_actions_init(&actions_);
    posix_spawnattr_init(&attributes_);
    // Without this reset, the plug-in would also block or ignore each signal that the parent of nearmiss
    // blocks or ignores. The plug-in might then behave differently, or end in a way that hides the cause.
    sigset_t signals;
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes_, &signals);
    sigfillset(&signals);
    posix_spawnattr_setsigdefault(&attributes_, &signals);
    posix_spawnattr_setflags(&attributes_,
                             POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  Spawn(const Spawn&) = delete;
  Spawn& operator=(const Spawn&) = delete;
  ~Spawn() {
    posix_spawnattr_destroy(&attributes_);
    posix_spawn_file_actions_destroy(&actions_);
  }

  void pass(int descriptor, int number) {
    // The copies get larger numbers than the program's descriptors will have, so that dup2(2) overwrites no
    // copy that is still needed.
    constexpr int above = 16;
    passed_.emplace_back(fcntl(descriptor, F_DUPFD_CLOEXEC, above));
    check(passed_.back().number() >= 0, "descriptor");
    posix_spawn_file_actions_adddup2(&actions_, passed_.back().number(), number);
  }

  pid_t run(const std::string& program, std::vector<std::string> arguments) {
    std::vector<char*> words;
    for (std::string& each : arguments) words.push_back(each.data());
    words.push_back(nullptr);
    pid_t process = -1;
    errno = posix_spawn(&process, program.c_str(), &actions_, &attributes_, words.data(), environ);
    check(errno == 0, program.c_str());
    return process;
  }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
  std::vector<Descriptor> passed_;
};

}  // namespace

SocketPair::SocketPair() {
  std::array<int, 2> sockets{};
  check(socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, sockets.data()) == 0, "socket");
  ours = Descriptor(sockets[0]);
  theirs = Descriptor(sockets[1]);
}

bool is_ready(int file, milliseconds time) {
  const auto until = steady_clock::now() + time;
  pollfd wanted{file, POLLIN, 0};
  int ready = poll(&wanted, 1, static_cast<int>(time.count()));
  while (ready < 0 && errno == EINTR) {
    const auto left = std::chrono::ceil<milliseconds>(until - steady_clock::now());
    ready = poll(&wanted, 1, static_cast<int>(std::max(left, milliseconds(0)).count()));
  }
  return ready > 0;
}

void Supervisor::start(std::vector<std::string> arguments, const Files& files, const Stop& stop) {
  SocketPair status;
  const int wanted = 1;
  check(setsockopt(status.ours.number(), SOL_SOCKET, SO_PASSCRED, &wanted, sizeof wanted) == 0, "socket");
  const std::string program = path_beside("nearmiss-worker");
  arguments.insert(arguments.begin(), {"nearmiss-worker", NEARMISS_WORKER_CODE});
  {
    // At the end of this block, `spawn` closes nearmiss's copies of the descriptors that it passes, because
    // only the worker may keep these descriptors open.
    Spawn spawn;
    spawn.pass(files.replies, reply_socket);
    spawn.pass(status.theirs.number(), status_socket);
    spawn.pass(files.answers, answers_memory);
    worker_ = spawn.run(program, std::move(arguments));
  }
  status_ = std::move(status.ours);
  status.theirs.close();
  if (!learns_process(stop))
    throw NoWorker(fmt::format(
        "no worker process: {} does not start one, or is not of the same build as nearmiss", program));
}

bool Supervisor::hears_from_worker(const Stop& stop) const {
  constexpr std::chrono::seconds patience(60);
  constexpr milliseconds look_again(10);
  const auto until = steady_clock::now() + patience;
  while (!is_ready(status_.number(), look_again)) {
    stop.check(Stop::grace);
    if (steady_clock::now() >= until) return false;
  }
  return true;
}

bool Supervisor::learns_process(const Stop& stop) {
  if (!hears_from_worker(stop)) return false;
  Status first{};
  iovec content{&first, sizeof first};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(ucred))> control{};
  msghdr message{};
  message.msg_iov = &content;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  if (recvmsg(status_.number(), &message, MSG_DONTWAIT) != sizeof first) return false;
  const cmsghdr* const attached = CMSG_FIRSTHDR(&message);
  if (attached == nullptr || attached->cmsg_type != SCM_CREDENTIALS) return false;
  ucred sender{};  // has the plug-in's process id in the namespace of nearmiss
  std::memcpy(&sender, CMSG_DATA(attached), sizeof sender);
  process_ = sender.pid;
  // Without this call, a plug-in without a PID namespace could write to the memory of nearmiss through /proc.
  if (first.is_in_namespace == 0) prctl(PR_SET_DUMPABLE, 0);
  return process_ > 0;
}

Supervisor::~Supervisor() {
  if (worker_ <= 0) return;
  dismiss();
  // If no `Status` has come, the worker may not have begun to run, and may never notice that it is dismissed.
  if (process_ <= 0) kill(worker_, SIGKILL);
  constexpr int tries = 2000;
  for (int i = 0; i < tries; ++i) {
    if (waitpid(worker_, nullptr, WNOHANG) != 0) return;
    kill(worker_, SIGCONT);  // a plug-in without a namespace may have stopped the worker
    poll(nullptr, 0, 1);
  }
  kill(worker_, SIGKILL);
  waitpid(worker_, nullptr, 0);
}

}  // namespace nearmiss::isolation

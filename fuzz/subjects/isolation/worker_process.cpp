#include "fuzz/subjects/isolation/worker_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <new>
#include <system_error>

#include "ccd/error.hpp"

namespace nearmiss::isolation {

namespace {

using std::chrono::steady_clock;

/// The path of nearmiss-worker: next to this program, or else where it was built.
std::string worker_executable() {
  std::error_code unknown;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", unknown);
  const auto beside = self.parent_path() / "nearmiss-worker";
  return std::filesystem::exists(beside, unknown) ? beside.string() : NEARMISS_WORKER;
}

void check(bool fine, const char* what) {
  if (!fine) throw Error(fmt::format("no worker process: {}: {}", what, std::strerror(errno)));
}

}  // namespace

WorkerProcess::Descriptor::~Descriptor() {
  if (number >= 0) close(number);
}

void WorkerProcess::Unmap::operator()(Shared* memory) const { munmap(memory, sizeof(Shared)); }

WorkerProcess::Child::~Child() {
  if (id <= 0) return;
  kill(id, SIGKILL);
  waitpid(id, nullptr, 0);
}

WorkerProcess::WorkerProcess(const std::string& path, const PluginLimits& limits) : limits_(limits) {
  const Descriptor memory{memfd_create("nearmiss-worker", MFD_CLOEXEC)};
  check(memory.number >= 0 && ftruncate(memory.number, sizeof(Shared)) == 0, "memory");
  void* const mapped = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED, memory.number, 0);
  check(mapped != MAP_FAILED, "memory");
  shared_.reset(new (mapped) Shared);
  start(path, memory.number);
  const How how = wait();
  if (how == How::dead) throw Error(path + ": the plug-in ended its process while it was loaded");
  if (how == How::late) throw Error(path + ": the plug-in takes too long to load");
  if (shared_->error[0] != '\0') throw Error(shared_->error.data());
}

void WorkerProcess::start(const std::string& path, int memory) {
  std::array<int, 2> sockets{};
  check(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets.data()) == 0, "socket");
  socket_.number = sockets[0];
  const Descriptor theirs{sockets[1]};
  // Moves both descriptors above the numbers to which they are duplicated, so that one cannot overwrite the
  // other.
  const Descriptor socket_above{fcntl(theirs.number, F_DUPFD_CLOEXEC, 16)};
  const Descriptor memory_above{fcntl(memory, F_DUPFD_CLOEXEC, 16)};
  check(socket_above.number >= 0 && memory_above.number >= 0, "descriptor");

  const std::string executable = worker_executable();
  std::string name = "nearmiss-worker";
  std::string plugin = path;
  std::string bytes = std::to_string(limits_.bytes);
  std::array<char*, 4> arguments{name.data(), plugin.data(), bytes.data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, socket_above.number, socket_descriptor);
  posix_spawn_file_actions_adddup2(&actions, memory_above.number, memory_descriptor);
  pid_t id = -1;
  errno = posix_spawn(&id, executable.c_str(), &actions, nullptr, arguments.data(), environ);
  const bool started = errno == 0;
  posix_spawn_file_actions_destroy(&actions);
  check(started, executable.c_str());
  process_.id = id;
}

std::chrono::duration<double> WorkerProcess::computed() const {
  clockid_t clock{};
  timespec time{};
  if (clock_getcpuclockid(process_.id, &clock) != 0 || clock_gettime(clock, &time) != 0)
    return {};  // the process died, which the socket shows
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

WorkerProcess::How WorkerProcess::wait() const {
  constexpr int patience = 10;
  constexpr int look_again_ms = 10;
  std::uint32_t calls = shared_->calls;
  auto since = steady_clock::now();
  auto computed_since = computed();
  while (true) {
    pollfd socket{socket_.number, POLLIN, 0};
    const bool spoke = poll(&socket, 1, look_again_ms) > 0;
    if (spoke) {
      char byte = 0;
      return read(socket_.number, &byte, 1) == 1 ? How::done : How::dead;
    }
    if (const std::uint32_t now = shared_->calls; now != calls) {
      calls = now;
      since = steady_clock::now();
      computed_since = computed();
    } else if (computed() - computed_since >= limits_.time ||
               steady_clock::now() - since >= patience * limits_.time) {
      return How::late;
    }
  }
}

std::optional<WorkerFailure> WorkerProcess::perform(Request request) const {
  // A plug-in may overwrite the shared memory, so nothing read from there later is trusted.
  const std::uint32_t first = shared_->first;
  const std::uint32_t last = shared_->count - 1;
  shared_->current = first;
  const char byte = static_cast<char>(request);
  static_cast<void>(send(socket_.number, &byte, 1, MSG_NOSIGNAL));  // a dead worker is noticed below
  const How end = wait();
  if (end == How::done) return std::nullopt;
  const std::uint32_t query = std::clamp<std::uint32_t>(shared_->current, first, last);
  WorkerFailure failure{query, Fault::time, 0};
  if (end == How::dead) {
    siginfo_t how{};
    waitid(P_PID, static_cast<id_t>(process_.id), &how, WEXITED | WNOWAIT);
    failure.fault = Fault::crash;
    failure.code = how.si_code == CLD_EXITED ? -how.si_status : how.si_status;
  }
  if (shared_->memory_refused != 0) {
    failure.fault = Fault::memory;
    failure.code = 0;
  }
  return failure;
}

}  // namespace nearmiss::isolation

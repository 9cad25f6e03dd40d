// nearmiss-worker PLUGIN BYTES: the process in which a plug-in runs. It answers requests until the asking
// process ends. BYTES limits the memory that it may use in addition to what loading took; 0 means no limit.
#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <thread>

#include "ccd/error.hpp"
#include "ccd/plugin.hpp"
#include "ccd/stopwatch.hpp"
#include "fuzz/subjects/isolation/shared.hpp"

namespace {

using namespace nearmiss;
using namespace nearmiss::isolation;

Shared* shared = nullptr;

}  // namespace

// These functions replace the allocator for the plug-in, so that failures are noted; glibc provides the names
// below for that purpose. (Sanitizers have their own allocators.)
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define NEARMISS_SANITIZER_ALLOCATES
#endif
#endif
#ifndef NEARMISS_SANITIZER_ALLOCATES
namespace {

void note_refusal() {
  if (shared != nullptr) shared->memory_refused.store(1, std::memory_order_relaxed);
}

}  // namespace

extern "C" {
// NOLINTBEGIN(bugprone-reserved-identifier): the library's own names
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
// NOLINTEND(bugprone-reserved-identifier)

void* malloc(std::size_t size) {
  void* const block = __libc_malloc(size);
  if (block == nullptr) note_refusal();
  return block;
}
void* calloc(std::size_t count, std::size_t size) {
  void* const block = __libc_calloc(count, size);
  if (block == nullptr) note_refusal();
  return block;
}
void* realloc(void* old, std::size_t size) {
  void* const block = __libc_realloc(old, size);
  if (block == nullptr && size != 0) note_refusal();
  return block;
}
}
#endif

namespace {

/// Discards the plug-in's output, and sets how signals are handled.
void close_off() {
  const int nothing = open("/dev/null", O_RDWR);
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nothing, standard);
  if (nothing > STDERR_FILENO) close(nothing);
  // An interrupt goes to both processes. The asking process then ends this one, which must not look like a
  // crash.
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_IGN);
  // A crash must look like a crash, even if a sanitizer would turn it into an exit.
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) std::signal(signal, SIG_DFL);
}

/// Ends this process when the asking process has ended, whatever the plug-in does.
void end_with_the_other_side() {
  std::thread([] {
    pollfd other_side{socket_descriptor, 0, 0};
    while (poll(&other_side, 1, -1) < 0 || (other_side.revents & POLLHUP) == 0) {
    }
    _exit(0);
  }).detach();
}

void limit_memory(rlim_t more) {
  if (more == 0) return;
  std::FILE* const statm = std::fopen("/proc/self/statm", "r");
  unsigned long pages = 0;
  if (statm == nullptr || std::fscanf(statm, "%lu", &pages) != 1) _exit(1);
  std::fclose(statm);
  const rlim_t bytes = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + more;
  const rlimit limit{bytes, bytes};
  setrlimit(RLIMIT_AS, &limit);
}

Query query_at(std::uint32_t i) {
  Query query;
  query.kind = shared->kind;
  query.x = shared->queries[i];
  return query;
}

/// Notes which query comes next, because the plug-in may crash in it.
void begin(std::uint32_t i) {
  shared->memory_refused.store(0, std::memory_order_relaxed);
  shared->current.store(i, std::memory_order_release);
  shared->calls.fetch_add(1, std::memory_order_release);
}

void ask(const Plugin& plugin, std::uint32_t i) {
  begin(i);
  PluginAnswer& answer = shared->answers[i];
  answer.number = std::numeric_limits<double>::quiet_NaN();
  answer.value = plugin.ask(query_at(i), answer.number);
}

void ask(const Plugin& plugin, std::uint32_t first, std::uint32_t last) {
  for (std::uint32_t i = first; i < last; ++i) ask(plugin, i);
}

void answer(const Plugin& plugin, Request request) {
  const Plugin& empty = Plugin::empty_plugin();
  const std::uint32_t first = shared->first;
  const std::uint32_t last = shared->count;
  switch (request) {
    case Request::decide:
      ask(plugin, first, last);
      break;
    case Request::decide_timed: {
      const auto few = std::min<std::uint32_t>(first + warm_up_queries, last);
      ask(empty, first, few);
      ask(plugin, first, few);
      // Measures the time of all threads, since a plug-in may have threads of its own.
      shared->nanoseconds = time_beyond(
          CLOCK_PROCESS_CPUTIME_ID, [&] { ask(plugin, first, last); }, [&] { ask(empty, first, last); });
      break;
    }
    case Request::time_each:
      for (std::uint32_t i = first; i < last; ++i)
        shared->answers[i].nanoseconds = best_time_beyond(
            CLOCK_PROCESS_CPUTIME_ID, [&] { ask(plugin, i); }, [&] { ask(empty, i); });
      break;
    case Request::bounds:
      for (std::uint32_t i = first; i < last; ++i) {
        begin(i);
        shared->answers[i].number = plugin.distance_bound(query_at(i));
      }
      break;
  }
}

void say_done() {
  const char done = 0;
  while (write(socket_descriptor, &done, 1) < 0 && errno == EINTR) {
  }
}

template <std::size_t n>
void copy(const std::string& text, std::array<char, n>& to) {
  to[text.copy(to.data(), n - 1)] = '\0';
}

int work(const char* path, const char* bytes) {
  void* const memory =
      mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED, memory_descriptor, 0);
  if (memory == MAP_FAILED) return 1;
  shared = static_cast<Shared*>(memory);
  close_off();
  end_with_the_other_side();
  std::unique_ptr<Plugin> plugin;
  try {
    plugin = std::make_unique<Plugin>(path);
    copy(plugin->name(), shared->name);
    shared->claims_bound = plugin->claims_bound();
  } catch (const Error& error) {
    copy(error.what(), shared->error);
  }
  limit_memory(std::strtoull(bytes, nullptr, 10));
  say_done();
  for (char request = 0; read(socket_descriptor, &request, 1) == 1;) {
    answer(*plugin, static_cast<Request>(request));
    say_done();
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return argc == 3 ? work(argv[1], argv[2]) : 2; }

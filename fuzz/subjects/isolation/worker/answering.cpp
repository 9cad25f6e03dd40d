#include "fuzz/subjects/isolation/worker/answering.hpp"

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <memory>
#include <string>
#include <string_view>

#include "ccd/error.hpp"
#include "ccd/plugin.hpp"
#include "ccd/stopwatch.hpp"
#include "fuzz/subjects/isolation/shared.hpp"

namespace {

using namespace nearmiss;
using namespace nearmiss::isolation;

const SharedQuestions* questions = nullptr;
SharedAnswers* answers = nullptr;

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
  if (answers != nullptr) answers->memory_refused.store(1, std::memory_order_relaxed);
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

template <std::size_t n>
void copy(std::string_view text, std::array<char, n>& to) {
  to[text.copy(to.data(), n - 1)] = '\0';
}

/// Notes what an exception says that nobody caught, and ends the process.
[[noreturn]] void note_exception() {
  try {
    if (const auto exception = std::current_exception()) std::rethrow_exception(exception);
  } catch (const std::exception& exception) {
    copy(exception.what()[0] != '\0' ? exception.what() : "std::exception", answers->exception);
  } catch (...) {
    copy("of a type that is not derived from std::exception", answers->exception);
  }
  std::abort();
}

/// Sets how this process ends, before the plug-in is loaded.
void prepare_for_faults() {
  // A crash must look like a crash, even if a sanitizer would turn it into an exit.
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) std::signal(signal, SIG_DFL);
  std::set_terminate(note_exception);
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
  query.kind = questions->kind;
  query.x = questions->queries[i];
  return query;
}

/// Notes which query comes next, because the plug-in may crash in it.
void begin(std::uint32_t i) {
  answers->memory_refused.store(0, std::memory_order_relaxed);
  answers->current.store(i, std::memory_order_release);
  answers->calls.fetch_add(1, std::memory_order_release);
}

/// Decides one query.
void ask(const Plugin& plugin, std::uint64_t call, std::uint32_t i) {
  begin(i);
  PluginAnswer& answer = answers->of[i];
  answer.number = std::numeric_limits<double>::quiet_NaN();
  answer.value = plugin.ask(query_at(i), answer.number);
  answer.call = call;
}

void answer(const Plugin& plugin, const Call& call) {
  const Plugin& empty = Plugin::empty_plugin();
  const std::uint32_t first = questions->first;
  const std::uint32_t last = questions->last;
  const auto ask_all = [&](const Plugin& asked, std::uint32_t end) {
    for (std::uint32_t i = first; i < end; ++i) ask(asked, call.number, i);
  };
  switch (call.request) {
    case Request::load:
      break;  // it is loaded
    case Request::decide:
      ask_all(plugin, last);
      break;
    case Request::decide_timed: {
      const auto few = std::min<std::uint32_t>(first + warm_up_queries, last);
      ask_all(empty, few);
      ask_all(plugin, few);
      // The time of all threads, since a plug-in may have threads of its own.
      answers->nanoseconds = time_beyond(
          CLOCK_PROCESS_CPUTIME_ID, [&] { ask_all(plugin, last); }, [&] { ask_all(empty, last); });
      break;
    }
    case Request::time_each:
      for (std::uint32_t i = first; i < last; ++i)
        answers->of[i].nanoseconds = best_time_beyond(
            CLOCK_PROCESS_CPUTIME_ID, [&] { ask(plugin, call.number, i); },
            [&] { ask(empty, call.number, i); });
      break;
    case Request::bounds:
      for (std::uint32_t i = first; i < last; ++i) {
        begin(i);
        answers->of[i].number = plugin.ask_bound(query_at(i)).bound;
        answers->of[i].call = call.number;
      }
      break;
  }
}

void reply(std::uint64_t number) {
  while (send(reply_socket, &number, sizeof number, MSG_NOSIGNAL) < 0 && errno == EINTR) {
  }
}

bool receive(Call& call) {
  while (true) {
    const ssize_t size = recv(reply_socket, &call, sizeof call, 0);
    if (size >= 0 || errno != EINTR) return size == sizeof call;
  }
}

template <class Memory>
Memory* map(int descriptor, int protection) {
  void* const memory = mmap(nullptr, sizeof(Memory), protection, MAP_SHARED, descriptor, 0);
  close(descriptor);
  return memory == MAP_FAILED ? nullptr : static_cast<Memory*>(memory);
}

std::unique_ptr<Plugin> load(const char* path) {
  try {
    auto plugin = std::make_unique<Plugin>(path);
    copy(plugin->name(), answers->name);
    copy(plugin->version(), answers->version);
    answers->claims_bound = plugin->claims_bound();
    return plugin;
  } catch (const Error& error) {
    copy(error.what(), answers->error);
    return nullptr;
  }
}

}  // namespace

namespace nearmiss::isolation {

int answer_requests(const char* path, std::uint64_t bytes) {
  questions = map<const SharedQuestions>(questions_memory, PROT_READ);
  answers = map<SharedAnswers>(answers_memory, PROT_READ | PROT_WRITE);
  if (questions == nullptr || answers == nullptr) return 1;
  prepare_for_faults();
  Call call{};
  if (!receive(call)) return 0;
  const std::unique_ptr<Plugin> plugin = load(path);
  limit_memory(bytes);
  reply(call.number);
  while (plugin && receive(call)) {
    answer(*plugin, call);
    reply(call.number);
  }
  return 0;
}

}  // namespace nearmiss::isolation

#include "fuzz/subjects/isolation/worker/memory.hpp"

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <fstream>
#include <string>

#include "fuzz/subjects/isolation/process_stat.hpp"

namespace nearmiss::isolation {

namespace {

std::atomic<std::uint32_t>* refused = nullptr;

}  // namespace

void note_refusals_in(std::atomic<std::uint32_t>& flag) { refused = &flag; }

void note_refusal() {
  if (refused != nullptr) refused->store(1, std::memory_order_relaxed);
}

}  // namespace nearmiss::isolation

// These functions replace those of glibc for the plug-in, so that they can note when an allocation fails.
// They call glibc's functions by the names below, which glibc provides for this purpose. (Sanitizers have
// their own allocators.)
#if defined(__SANITIZE_ADDRESS__)
#define NEARMISS_SANITIZER_ALLOCATES
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define NEARMISS_SANITIZER_ALLOCATES
#endif
#endif
#ifndef NEARMISS_SANITIZER_ALLOCATES
using nearmiss::isolation::note_refusal;

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
void* mmap(void* at, std::size_t size, int protection, int flags, int file, off_t offset) noexcept {
  const long address = syscall(SYS_mmap, at, size, protection, flags, file, offset);
  if (address == -1 && errno == ENOMEM) note_refusal();
  return reinterpret_cast<void*>(address);
}
void* mmap64(void* at, std::size_t size, int protection, int flags, int file, off_t offset) noexcept {
  return mmap(at, size, protection, flags, file, offset);
}
}
#endif

namespace nearmiss::isolation {

namespace {

/// The folder in /proc of `process`, which is this process or its only child, a program. The path does not
/// contain the number `process`, because /proc may show another PID namespace, in which processes have other
/// numbers.
std::string folder_of(pid_t process) {
  if (process == getpid()) return "/proc/self";
  std::ifstream("/proc/thread-self/children") >> process;
  return "/proc/" + std::to_string(process);
}

Memory memory_of(pid_t process) {
  const auto memory = memory_in(folder_of(process));
  if (!memory) _exit(1);
  return *memory;
}

void limit(pid_t process, __rlimit_resource resource, rlim_t now, rlim_t later) {
  const rlimit both{now, later};
  prlimit(process, resource, &both, nullptr);
}

}  // namespace

void limit_memory_of_loading(std::uint64_t more) {
  if (more == 0) return;
  const rlim_t data = memory_of(getpid()).data;
  limit(getpid(), RLIMIT_DATA, data + 2 * more, data + 3 * more);
  limit(getpid(), RLIMIT_FSIZE, more, more);
  std::signal(SIGXFSZ, SIG_IGN);
}

void limit_memory(pid_t process, std::uint64_t more) {
  if (more == 0) return;
  rlimit data{};
  prlimit(process, RLIMIT_DATA, nullptr, &data);
  limit(process, RLIMIT_DATA, data.rlim_max, data.rlim_max);
  const rlim_t addresses = memory_of(process).addresses + more;
  limit(process, RLIMIT_AS, addresses, addresses);
}

}  // namespace nearmiss::isolation

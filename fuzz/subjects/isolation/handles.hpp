// Classes that own file descriptors or shared memory, and release them when the owner is destroyed.
#pragma once

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <utility>

#include "fuzz/subjects/isolation/trial_error.hpp"

namespace nearmiss::isolation {

/// Unless `fine` is true, throws NoWorker with `what` and the system's reason (errno).
inline void check(bool fine, const char* what) {
  if (!fine) throw NoWorker(fmt::format("no worker process: {}: {}", what, std::strerror(errno)));
}

/// Owns a file descriptor, and closes it.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() { close(); }

  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_ = -1;
};

/// Memory that a process can share with another process. No process can change the size of this memory. The
/// system provides memory only for the parts that are used.
class SharedMemory {
 public:
  SharedMemory() = default;
  /// With `others_may_write`, other processes can write to the memory. Throws NoWorker if the system refuses
  /// the memory.
  SharedMemory(const char* name, std::size_t bytes, bool others_may_write)
      : file_(memfd_create(name, MFD_CLOEXEC | MFD_ALLOW_SEALING)), bytes_(bytes) {
    check(file_.number() >= 0 && ftruncate(file_.number(), static_cast<off_t>(bytes)) == 0, "memory");
    void* const mapped = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file_.number(), 0);
    check(mapped != MAP_FAILED, "memory");
    start_ = mapped;
    const int size = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL;
    check(fcntl(file_.number(), F_ADD_SEALS, others_may_write ? size : size | F_SEAL_FUTURE_WRITE) == 0,
          "sealed memory");
  }
  SharedMemory(SharedMemory&& other) noexcept { swap(other); }
  SharedMemory& operator=(SharedMemory&& other) noexcept {
    swap(other);
    return *this;
  }
  ~SharedMemory() {
    if (start_ != nullptr) munmap(start_, bytes_);
  }

  [[nodiscard]] int file() const { return file_.number(); }
  template <class Content>
  [[nodiscard]] Content* as() const {
    return static_cast<Content*>(start_);
  }

  /// Makes the system provide memory for the first `bytes` bytes, so that their use cannot fail later.
  /// Returns whether the system has enough memory.
  [[nodiscard]] bool reserve(std::size_t bytes) const {
    return fallocate(file_.number(), 0, 0, static_cast<off_t>(bytes)) == 0;
  }

 private:
  void swap(SharedMemory& other) {
    std::swap(file_, other.file_);
    std::swap(start_, other.start_);
    std::swap(bytes_, other.bytes_);
  }

  Descriptor file_;
  void* start_ = nullptr;
  std::size_t bytes_ = 0;
};

}  // namespace nearmiss::isolation

// Descriptors and shared memory that are released with their owner.
#pragma once

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <new>
#include <utility>

#include "fuzz/subjects/isolation/trial_error.hpp"

namespace nearmiss::isolation {

/// Throws NoWorker with the system's reason if something failed.
inline void check(bool fine, const char* what) {
  if (!fine) throw NoWorker(fmt::format("no worker process: {}: {}", what, std::strerror(errno)));
}

/// Closes a file descriptor.
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

/// Memory with a `Content` that a process can share with another one. Nobody can change its size.
template <class Content>
class SharedMemory {
 public:
  /// `others_may_write`: whether other processes can write to it. Throws NoWorker.
  explicit SharedMemory(bool others_may_write)
      : file_(memfd_create("nearmiss-worker", MFD_CLOEXEC | MFD_ALLOW_SEALING)) {
    check(file_.number() >= 0 && ftruncate(file_.number(), sizeof(Content)) == 0, "memory");
    void* const mapped =
        mmap(nullptr, sizeof(Content), PROT_READ | PROT_WRITE, MAP_SHARED, file_.number(), 0);
    check(mapped != MAP_FAILED, "memory");
    content_ = new (mapped) Content;
    const int size = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL;
    check(fcntl(file_.number(), F_ADD_SEALS, others_may_write ? size : size | F_SEAL_FUTURE_WRITE) == 0,
          "sealed memory");
  }
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;
  ~SharedMemory() { munmap(content_, sizeof(Content)); }

  [[nodiscard]] int file() const { return file_.number(); }
  Content& operator*() const { return *content_; }
  Content* operator->() const { return content_; }

 private:
  Descriptor file_;
  Content* content_ = nullptr;
};

}  // namespace nearmiss::isolation

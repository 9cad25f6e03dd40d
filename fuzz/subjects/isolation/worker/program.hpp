// A detector that is a program of its own, in any language.
#pragma once

#include <poll.h>
#include <sys/types.h>

#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>

#include "ccd/nearmiss_subject.h"

namespace nearmiss::isolation {

/// Runs a command, which answers batches of queries (fuzz/subjects/PROGRAMS.md says how), as a child of this process. If
/// it ends, so does this process, in the same way.
class Program {
 public:
  /// Starts the command, and reads what it says about itself. `time` is kept at its computing time, in ns. Throws Error.
  Program(const std::string& command, std::atomic<std::uint64_t>& time);
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program();

  [[nodiscard]] pid_t process() const { return process_; }
  /// The program as a detector. At most one program can be used so.
  [[nodiscard]] const nearmiss_subject& subject() const { return subject_; }

 private:
  enum class Question : std::uint8_t { decide, bound };

  void start(const std::string& command);
  void read_description();
  void describe(std::string_view key, const std::string& value);

  void ask(Question question, int kind, std::size_t n, const double* x, const double* h, double* answers);
  void write_all(const void* data, std::size_t size);
  void read_all(void* data, std::size_t size);
  /// Waits until a pipe can be used, and meanwhile reads what the program prints as errors.
  void wait_for(int pipe, short event);
  void read_errors();
  /// Ends this process as the program ended.
  [[noreturn]] void end_like_it();

  std::string command_;
  std::atomic<std::uint64_t>& time_;
  pid_t process_ = -1;
  clockid_t clock_{};
  int in_ = -1, out_ = -1,
      errors_ = -1;          ///< pipes to its standard input, and from its standard output and error
  std::string last_errors_;  ///< the end of what it printed as errors
  std::string name_, version_, about_;
  nearmiss_subject subject_{};
};

}  // namespace nearmiss::isolation

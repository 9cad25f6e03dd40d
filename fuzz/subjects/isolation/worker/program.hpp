// A detector that is a program of its own, in any language.
#pragma once

#include <poll.h>
#include <sys/types.h>

#include <cstdint>
#include <string>

#include "ccd/nearmiss_subject.h"
#include "fuzz/subjects/isolation/worker/program_description.hpp"

namespace nearmiss::isolation {

/// Thrown if a program wrote bytes that answer no question.
struct UnaskedBytes {};

/// Runs a command as a child of this process. The command answers batches of queries, as
/// fuzz/subjects/PROGRAMS.md says. If the command ends, this process copies the end of the command's standard
/// error to its own standard error. If the command failed and wrote a message there, Program then throws
/// std::runtime_error with the last line of the message; otherwise, this process ends as the command did.
class Program {
 public:
  /// Starts the command, and reads its description. Throws Error if the description is missing or invalid.
  explicit Program(const std::string& command);
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  /// Closes the program's standard input, and waits until the program has ended.
  ~Program();

  [[nodiscard]] pid_t process() const { return process_; }
  /// The program as a detector. A process can have only one Program.
  [[nodiscard]] const nearmiss_subject& subject() const { return description_.subject; }

 private:
  enum class Question : std::uint8_t { decide, bound, distance, step };

  // The functions of `subject()`.
  static void decide_with_the_program(void* state, int kind, std::size_t n, const double* x, const double* h,
                                      int* answer, double* toi);
  static double bound_of_the_program(void* state, int kind, const double* x, double h);
  static double bound_of_contact(void* state, int kind, const double* x);
  static double distance_of_the_program(void* state, int kind, const double* x, double* weights);
  static double step_of_the_program(void* state, int kind, const double* x, double* y);
  static double seconds_it_says(void* state);

  void start(const std::string& command);
  std::string read_description();

  /// Writes a request to the program. Throws UnaskedBytes if the program has written anything since its last
  /// answer.
  void ask(Question question, int kind, std::size_t n, const double* x, const double* h);
  /// Reads the program's answer, and calls take(i, number, time) for each query i. Throws UnaskedBytes if the
  /// program has written more bytes than the answer has.
  template <class Take>
  void read_answers(std::size_t n, const Take& take);
  /// Asks the program about one query, and returns the number in the program's answer. Throws UnaskedBytes as
  /// ask() and read_answers() do.
  double number(Question question, int kind, const double* x, double h);
  /// Reads the seconds at the end of an answer, if the program gives them. Throws UnaskedBytes if the program
  /// has written anything after them.
  void read_end();
  void expect_silence() const;
  void write_all(const void* data, std::size_t size);
  void read_all(void* data, std::size_t size);
  /// Waits until a pipe is ready, and meanwhile reads what the program writes to standard error. Ends this
  /// process if the program has ended.
  void wait_for(int pipe, short event);
  [[nodiscard]] bool has_ended() const;
  void read_errors();
  [[noreturn]] void end_like_it();

  std::string command_;
  pid_t process_ = -1;
  /// Pipes to the program's standard input, and from its standard output and standard error.
  int in_ = -1, out_ = -1, errors_ = -1;
  std::string last_errors_;  ///< the end of what the program wrote to standard error
  ProgramDescription description_;
  double seconds_ = -1;  ///< the seconds that the last answer took without copies, if the program gives them
};

}  // namespace nearmiss::isolation

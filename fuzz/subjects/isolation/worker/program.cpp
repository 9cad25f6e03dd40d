#include "fuzz/subjects/isolation/worker/program.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "ccd/query/error.hpp"
#include "ccd/subjects/detector.hpp"

namespace nearmiss::isolation {

namespace {

constexpr int look_again_ms = 5;
constexpr std::size_t rows_at_once = 2048;  // the number of queries that are written or read at once

/// The program that the functions of a nearmiss_subject ask.
Program* the_program = nullptr;

struct Pipe {
  int read = -1, write = -1;
  Pipe() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw Error("cannot start a program: no pipe");
    read = ends[0];
    write = ends[1];
  }
};

/// Called in the new process. Makes the pipes the standard streams of this process, and replaces the
/// process's program by the command.
[[noreturn]] void become(const std::string& command, const Pipe& in, const Pipe& out, const Pipe& errors) {
  dup2(in.read, STDIN_FILENO);
  dup2(out.write, STDOUT_FILENO);
  dup2(errors.write, STDERR_FILENO);
  closefrom(STDERR_FILENO + 1);
  std::signal(SIGPIPE, SIG_DFL);
  // `exec` replaces the shell by the program, so that limits of this process's child apply to the program
  // itself. A command that begins with `cd FOLDER &&` already has an `exec`.
  execl("/bin/sh", "sh", "-c", ((command.starts_with("cd ") ? "" : "exec ") + command).c_str(), nullptr);
  _exit(127);
}

/// The last line of the text that is not empty.
std::string last_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

}  // namespace

Program::Program(const std::string& command) : command_(command) {
  start(command);
  try {
    description_ = ProgramDescription::parse(read_description());
  } catch (const Error& error) {
    throw Error("pipe:" + command_ + ": " + error.what());
  }
  the_program = this;
  nearmiss_subject& subject = description_.subject;
  subject.name = description_.name.c_str();
  subject.version = description_.version.c_str();
  subject.about = description_.about.c_str();
  subject.decide = decide_with_the_program;
  if (description_.says_seconds) subject.seconds_of_kernels = seconds_it_says;
  if (description_.claims_bound && description_.ignores_separation_in_bounds)
    subject.distance_bound = bound_of_contact;
  else if (description_.claims_bound)
    subject.distance_bound_within = bound_of_the_program;
  if (subject.distance_kinds != 0) subject.distance = distance_of_the_program;
  if (subject.step_kinds != 0) subject.step = step_of_the_program;
  if (const std::string fault = fault_of(subject); !fault.empty())
    throw Error("pipe:" + command_ + ": found " + fault + ", expected what fuzz/subjects/PROGRAMS.md says");
}

void Program::decide_with_the_program(void* /*state*/, int kind, std::size_t n, const double* x,
                                      const double* h, int* answer, double* toi) {
  the_program->ask(Question::decide, kind, n, x, h);
  the_program->read_answers(n, [&](std::size_t i, double given, double time) {
    answer[i] =
        given >= -1e9 && given <= 1e9 && given == static_cast<int>(given) ? static_cast<int>(given) : 1 << 30;
    toi[i] = time;
  });
}

double Program::bound_of_the_program(void* /*state*/, int kind, const double* x, double h) {
  return the_program->number(Question::bound, kind, x, h);
}

double Program::seconds_it_says(void* /*state*/) { return the_program->seconds_; }

double Program::bound_of_contact(void* state, int kind, const double* x) {
  return bound_of_the_program(state, kind, x, 0);
}

double Program::distance_of_the_program(void* /*state*/, int kind, const double* x, double* /*weights*/) {
  const auto size = static_cast<std::ptrdiff_t>(coordinate_count(kind_of_bit(kind).value()) / 2);
  std::array<double, 24> at_rest{};
  std::copy_n(x, size, at_rest.begin());
  std::copy_n(x, size, at_rest.begin() + size);
  return the_program->number(Question::distance, kind, at_rest.data(), 0);
}

double Program::step_of_the_program(void* /*state*/, int kind, const double* x, double* y) {
  const double h = 0;
  double clearance = 0;
  the_program->ask(Question::step, kind, 1, x, &h);
  the_program->read_all(&clearance, sizeof clearance);
  the_program->read_all(y, coordinate_count(kind_of_bit(kind).value()) / 2 * sizeof(double));
  the_program->read_end();
  return clearance;
}

Program::~Program() {
  close(in_);
  while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
  for (const int each : {out_, errors_}) close(each);
}

void Program::start(const std::string& command) {
  const Pipe in;
  const Pipe out;
  const Pipe errors;
  while ((process_ = fork()) < 0 && errno == EAGAIN) poll(nullptr, 0, look_again_ms);  // too many processes
  if (process_ == 0) become(command, in, out, errors);
  if (process_ < 0) throw Error("cannot start a program");
  std::signal(SIGPIPE, SIG_IGN);
  for (const int each : {in.read, out.write, errors.write}) close(each);
  in_ = in.write;
  out_ = out.read;
  errors_ = errors.read;
  for (const int each : {in_, out_, errors_}) fcntl(each, F_SETFL, O_NONBLOCK);
}

std::string Program::read_description() {
  constexpr std::size_t most = 65536;
  std::string text;
  while (!text.ends_with("\n\n")) {
    if (text.size() == most) throw Error("found no empty line behind its description");
    text.push_back('\0');
    read_all(&text.back(), 1);
  }
  return text;
}

void Program::ask(Question question, int kind, std::size_t n, const double* x, const double* h) {
  const std::size_t size = coordinate_count(kind_of_bit(kind).value());
  expect_silence();
  std::vector<double> part{static_cast<double>(question), static_cast<double>(kind), static_cast<double>(n)};
  const auto write_part = [&] {
    write_all(part.data(), part.size() * sizeof(double));
    part.clear();
  };
  if (subject().layout == NEARMISS_ARRAYS) {
    write_part();
    write_all(x, size * n * sizeof(double));
    write_all(h, n * sizeof(double));
    return;
  }
  for (std::size_t i = 0; i < n; ++i) {
    part.insert(part.end(), x + size * i, x + size * (i + 1));
    part.push_back(h[i]);
    if (i % rows_at_once == rows_at_once - 1 || i == n - 1) write_part();
  }
}

template <class Take>
void Program::read_answers(std::size_t n, const Take& take) {
  std::vector<double> rows(2 * std::min(n, rows_at_once));
  for (std::size_t first = 0; first < n; first += rows_at_once) {
    const std::size_t count = std::min(rows_at_once, n - first);
    read_all(rows.data(), 2 * count * sizeof(double));
    for (std::size_t i = 0; i < count; ++i) take(first + i, rows[2 * i], rows[2 * i + 1]);
  }
  read_end();
}

double Program::number(Question question, int kind, const double* x, double h) {
  double number = 0;
  ask(question, kind, 1, x, &h);
  read_answers(1, [&](std::size_t /*i*/, double given, double /*time*/) { number = given; });
  return number;
}

void Program::read_end() {
  if (description_.says_seconds) read_all(&seconds_, sizeof seconds_);
  expect_silence();
}

void Program::expect_silence() const {
  int unread = 0;
  if (ioctl(out_, FIONREAD, &unread) == 0 && unread > 0) throw UnaskedBytes();
}

void Program::write_all(const void* data, std::size_t size) {
  const char* next = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = write(in_, next, size);
    if (written < 0 && errno == EPIPE) end_like_it();
    if (written < 0 && errno == EAGAIN) wait_for(in_, POLLOUT);
    if (written <= 0) continue;
    next += written;
    size -= static_cast<std::size_t>(written);
  }
}

void Program::read_all(void* data, std::size_t size) {
  char* next = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t got = read(out_, next, size);
    if (got == 0) end_like_it();
    if (got < 0 && errno == EAGAIN) wait_for(out_, POLLIN);
    if (got <= 0) continue;
    next += got;
    size -= static_cast<std::size_t>(got);
  }
}

void Program::wait_for(int pipe, short event) {
  std::array<pollfd, 2> pipes{{{pipe, event, 0}, {errors_, POLLIN, 0}}};
  const nfds_t count = errors_ >= 0 ? pipes.size() : 1;
  const bool ended = has_ended();
  poll(pipes.data(), count, ended ? 0 : look_again_ms);
  if (ended && pipes[0].revents == 0) end_like_it();  // the program's own children may hold the pipe open
  if (count > 1 && pipes[1].revents != 0) read_errors();
}

bool Program::has_ended() const {
  siginfo_t how{};
  return waitid(P_PID, static_cast<id_t>(process_), &how, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         how.si_pid != 0;
}

void Program::read_errors() {
  constexpr std::size_t most = 4096;
  std::array<char, most> block{};
  const ssize_t size = read(errors_, block.data(), block.size());
  if (size > 0) {
    last_errors_.append(block.data(), static_cast<std::size_t>(size));
    if (last_errors_.size() > most) last_errors_.erase(0, last_errors_.size() - most);
  } else if (size == 0) {
    close(errors_);
    errors_ = -1;
  }
}

void Program::end_like_it() {
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  for (int i = 0; errors_ >= 0 && i < 1000; ++i) {
    const pollfd before{errors_, POLLIN, 0};
    pollfd now = before;
    if (poll(&now, 1, 0) <= 0) break;
    read_errors();
  }
  static_cast<void>(!write(STDERR_FILENO, last_errors_.data(), last_errors_.size()));
  if (WIFSIGNALED(status)) {
    std::signal(WTERMSIG(status), SIG_DFL);
    raise(WTERMSIG(status));
  }
  const std::string said = last_line(last_errors_);
  if (WEXITSTATUS(status) != 0 && !said.empty()) throw std::runtime_error(said);
  _exit(WEXITSTATUS(status));
}

}  // namespace nearmiss::isolation

#include "fuzz/subjects/isolation/worker/program.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <stdexcept>
#include <vector>

#include "ccd/detector.hpp"
#include "ccd/error.hpp"

namespace nearmiss::isolation {

namespace {

constexpr std::size_t numbers_per_query = 25;  // 24 coordinates and the separation

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

/// In the new process: takes the pipes as standard streams, and becomes the command.
[[noreturn]] void become(const std::string& command, const Pipe& in, const Pipe& out, const Pipe& errors) {
  dup2(in.read, STDIN_FILENO);
  dup2(out.write, STDOUT_FILENO);
  dup2(errors.write, STDERR_FILENO);
  closefrom(STDERR_FILENO + 1);
  std::signal(SIGPIPE, SIG_DFL);
  // The shell itself is replaced, so that the limits and the computing time are those of the program.
  execl("/bin/sh", "sh", "-c", ("exec " + command).c_str(), nullptr);
  _exit(127);
}

/// The last line that is not empty.
std::string last_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

double number(const std::string& text) {
  double value = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || rest != text.data() + text.size() || !(value >= 0))
    throw Error("found '" + text + "', expected a number");
  return value;
}

/// A value's place among words, counted from `first`.
int place(const std::string& value, const std::vector<std::string>& words, int first) {
  for (std::size_t i = 0; i < words.size(); ++i)
    if (value == words[i]) return first + static_cast<int>(i);
  std::string known;
  for (const std::string& each : words) known += (known.empty() ? "" : ", ") + each;
  throw Error("found '" + value + "', expected one of " + known);
}

}  // namespace

Program::Program(const std::string& command, std::atomic<std::uint64_t>& time)
    : command_(command), time_(time) {
  start(command);
  subject_.interface_version = NEARMISS_INTERFACE;
  try {
    read_description();
  } catch (const Error& error) {
    throw Error("pipe:" + command_ + ": " + error.what());
  }
  the_program = this;
  subject_.name = name_.c_str();
  subject_.version = version_.c_str();
  subject_.about = about_.c_str();
  subject_.decide = [](void* /*state*/, int kind, std::size_t n, const double* x, const double* h,
                       int* answer, double* toi) {
    std::vector<double> answers(2 * n);
    the_program->ask(Question::decide, kind, n, x, h, answers.data());
    for (std::size_t i = 0; i < n; ++i) {
      const double given = answers[2 * i];
      answer[i] = given >= -1e9 && given <= 1e9 && given == static_cast<int>(given) ? static_cast<int>(given)
                                                                                    : 1 << 30;
      toi[i] = answers[2 * i + 1];
    }
  };
  if (const std::string fault = fault_of(subject_); !fault.empty())
    throw Error("pipe:" + command_ + ": found " + fault + ", expected what fuzz/subjects/PROGRAMS.md says");
}

Program::~Program() {
  for (const int each : {in_, out_, errors_}) close(each);
}

void Program::start(const std::string& command) {
  const Pipe in;
  const Pipe out;
  const Pipe errors;
  process_ = fork();
  if (process_ == 0) become(command, in, out, errors);
  if (process_ < 0 || clock_getcpuclockid(process_, &clock_) != 0) throw Error("cannot start a program");
  std::signal(SIGPIPE, SIG_IGN);
  for (const int each : {in.read, out.write, errors.write}) close(each);
  in_ = in.write;
  out_ = out.read;
  errors_ = errors.read;
  for (const int each : {in_, out_, errors_}) fcntl(each, F_SETFL, O_NONBLOCK);
}

void Program::read_description() {
  constexpr std::size_t most = 65536;
  std::string text;
  while (!text.ends_with("\n\n")) {
    if (text.size() == most) throw Error("found no empty line behind its description");
    text.push_back('\0');
    read_all(&text.back(), 1);
  }
  std::size_t at = text.find('\n') + 1;
  if (text.substr(0, at) != "nearmiss " + std::to_string(NEARMISS_INTERFACE) + "\n")
    throw Error("found '" + text.substr(0, at - 1) + "', expected 'nearmiss " +
                std::to_string(NEARMISS_INTERFACE) + "'");
  while (at + 1 < text.size()) {
    const std::size_t end = text.find('\n', at);
    const std::string line = text.substr(at, end - at);
    at = end + 1;
    const std::size_t blank = line.find(' ');
    describe(line.substr(0, blank), blank == std::string::npos ? "" : line.substr(blank + 1));
  }
}

void Program::describe(std::string_view key, const std::string& value) {
  nearmiss_contract& contract = subject_.contract;
  if (key == "name") {
    name_ = value;
  } else if (key == "version") {
    version_ = value;
  } else if (key == "about") {
    about_ = value;
  } else if (key == "kinds") {
    subject_.kinds = place(value, {"vt", "ee", "vt ee"}, NEARMISS_VERTEX_TRIANGLE);
  } else if (key == "bits") {
    subject_.bits = static_cast<int>(number(value));
  } else if (key == "time") {
    subject_.time_sort = place(value, {"none", "estimate", "lower-bound"}, NEARMISS_NO_TIME);
  } else if (key == "separation") {
    subject_.takes_separation = place(value, {"no", "yes"}, 0);
  } else if (key == "batch") {
    subject_.batch = static_cast<std::size_t>(number(value));
  } else if (key == "bound") {
    if (place(value, {"no", "yes"}, 0) == 1)
      subject_.distance_bound = [](void* /*state*/, int kind, const double* x) {
        const double contact = 0;
        std::array<double, 2> answer{};
        the_program->ask(Question::bound, kind, 1, x, &contact, answer.data());
        return answer[0];
      };
  } else if (key == "apart-at-start") {
    contract.apart_at_start = place(value, {"no", "yes"}, 0);
  } else if (key == "one-root") {
    contract.one_root = place(value, {"no", "yes"}, 0);
  } else if (key == "grid") {
    contract.grid = number(value);
  } else if (key == "shortest") {
    contract.shortest = number(value);
  } else if (key == "longest") {
    contract.longest = number(value);
  } else {
    throw Error("found the line '" + std::string(key) +
                "', expected one that fuzz/subjects/PROGRAMS.md lists");
  }
}

void Program::ask(Question question, int kind, std::size_t n, const double* x, const double* h,
                  double* answers) {
  std::vector<double> frame{static_cast<double>(question), static_cast<double>(kind), static_cast<double>(n)};
  frame.reserve(frame.size() + numbers_per_query * n);
  for (std::size_t i = 0; i < n; ++i) {
    frame.insert(frame.end(), x + 24 * i, x + 24 * (i + 1));
    frame.push_back(h[i]);
  }
  write_all(frame.data(), frame.size() * sizeof(double));
  read_all(answers, 2 * n * sizeof(double));
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
  constexpr int look_again_ms = 5;
  std::array<pollfd, 2> pipes{{{pipe, event, 0}, {errors_, POLLIN, 0}}};
  const nfds_t count = errors_ >= 0 ? pipes.size() : 1;
  poll(pipes.data(), count, look_again_ms);
  if (count > 1 && pipes[1].revents != 0) read_errors();
  timespec time{};
  if (clock_gettime(clock_, &time) == 0)
    time_.store(static_cast<std::uint64_t>(time.tv_sec) * 1'000'000'000 +
                static_cast<std::uint64_t>(time.tv_nsec));
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
  if (WIFSIGNALED(status)) {
    std::signal(WTERMSIG(status), SIG_DFL);
    raise(WTERMSIG(status));
  }
  const std::string said = last_line(last_errors_);
  if (WEXITSTATUS(status) != 0 && !said.empty()) throw std::runtime_error(said);
  _exit(WEXITSTATUS(status));
}

}  // namespace nearmiss::isolation

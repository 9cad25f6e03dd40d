#include "fuzz/subjects/isolation/worker/answering.hpp"

#include <execinfo.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ccd/query/arithmetic.hpp"
#include "ccd/query/error.hpp"
#include "ccd/subjects/detector.hpp"
#include "ccd/subjects/plugin.hpp"
#include "ccd/subjects/stopwatch.hpp"
#include "fuzz/subjects/isolation/shared.hpp"
#include "fuzz/subjects/isolation/worker/memory.hpp"
#include "fuzz/subjects/isolation/worker/program.hpp"

// The start and the end of this program's code, as the linker sets them.
extern "C" const char __executable_start;  // NOLINT(bugprone-reserved-identifier)
extern "C" const char etext;

namespace {

using namespace nearmiss;
using namespace nearmiss::isolation;

SharedAnswers* answers = nullptr;
BatchMemory shared{};            // the memory of the current batch
std::uint32_t most_queries = 0;  // the largest number of queries that a batch may have

template <std::size_t n>
void copy(std::string_view text, std::array<char, n>& to) {
  to[text.copy(to.data(), n - 1)] = '\0';
}

/// Stores the message of the exception that is being handled in the memory shared with nearmiss.
void note_exception() {
  try {
    if (const auto exception = std::current_exception()) std::rethrow_exception(exception);
  } catch (const std::exception& exception) {
    const char* const what = exception.what();
    copy(what != nullptr && what[0] != '\0' ? what : "std::exception", answers->exception);
  } catch (...) {
    copy("of a type that is not derived from std::exception", answers->exception);
  }
}

/// Stores the message of an exception that cannot be caught, such as an exception from another thread, and
/// ends the process.
[[noreturn]] void note_exception_and_end() {
  note_exception();
  std::abort();
}

/// The signal of the crash that is being handled; 0 if there is none.
volatile std::sig_atomic_t crash = 0;

void handle(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags =
      SA_ONSTACK | SA_NODEFER;  // the stack may have overflowed, and a second crash must end this process
  sigaction(signal, &action, nullptr);
}

/// Writes the functions on the stack to standard error, the innermost first, up to the first function of this
/// program. Then ends the process by the signal of the crash, even if the stack cannot be read in time.
extern "C" void write_stack_and_end(int signal) {
  constexpr itimerval patience{{}, {0, 20'000}};
  constexpr int of_handler = 2;  // the innermost functions on the stack, which handle the signal
  static std::array<void*, 48> functions;
  if (crash == 0) {
    crash = signal;
    handle(SIGALRM, write_stack_and_end);
    setitimer(ITIMER_REAL, &patience, nullptr);
    const int count = backtrace(functions.data(), static_cast<int>(functions.size()));
    const auto is_own = [](const void* each) { return each >= &__executable_start && each < &etext; };
    int last = std::min(of_handler, count);
    while (last < count && !is_own(functions[static_cast<std::size_t>(last)])) ++last;
    backtrace_symbols_fd(functions.data() + of_handler, std::max(last - of_handler, 0), STDERR_FILENO);
  }
  std::signal(crash, SIG_DFL);
  raise(crash);
}

/// Sets how this process ends after a crash or an exception.
void prepare_for_faults(bool writes_stack) {
  constexpr std::size_t bytes = 1 << 16;
  static std::array<char, bytes> stack;
  const stack_t other{.ss_sp = stack.data(), .ss_flags = 0, .ss_size = stack.size()};
  sigaltstack(&other, nullptr);
  std::array<void*, 1> any{};
  backtrace(any.data(), 1);  // the first call of backtrace() allocates memory, so it is made before a crash
  // A crash must look like a crash, even if a sanitizer would turn it into an exit.
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
    handle(signal, writes_stack ? write_stack_and_end : SIG_DFL);
  std::set_terminate(note_exception_and_end);
}

/// Stores which query comes next, so that nearmiss knows which query to blame if the plug-in crashes.
void begin(std::uint32_t i) {
  answers->memory_refused.store(0, std::memory_order_relaxed);
  answers->current.store(i, std::memory_order_release);
  answers->calls.fetch_add(1, std::memory_order_release);
}

/// Stores, for each of n queries, the number of the call that answered the query (0: no call). Must be called
/// after the answers are written, because the process may end at any moment.
void note(std::uint64_t* calls, std::uint32_t n, std::uint64_t call) {
  for (std::uint32_t i = 0; i < n; ++i) std::atomic_ref(calls[i]).store(call, std::memory_order_release);
}

/// The coordinates of the queries [first, first + n) of the batch, in the layout that the detector wants.
const double* coordinates(const Detector& detector, Kind kind, std::uint32_t first, std::uint32_t n) {
  const std::size_t size = coordinate_count(kind);
  if (!detector.info().in_arrays) return shared.x() + size * first;
  if (n == shared.n) return shared.x();
  // This array is large enough, because a larger batch goes to the detector as a whole.
  static std::array<double, 24 * least_capacity> part;
  for (std::size_t k = 0; k < size; ++k) std::copy_n(shared.x() + shared.n * k + first, n, &part[n * k]);
  return part.data();
}

struct Answers {
  std::uint64_t* calls;
  double* numbers;
  int* values;
};

/// Asks a detector about a batch. The detector is the plug-in's, or the empty detector (Detector::empty). In
/// both cases, the batch has the layout that the plug-in's detector wants.
class Asking {
 public:
  Asking(const Detector& plugin, const Call& call)
      : plugin_(plugin),
        call_(call),
        step_(static_cast<std::uint32_t>(std::min<std::size_t>(plugin.info().batch, most_queries))) {}

  /// Makes the plug-in's detector decide the queries [first, last), up to `step` at once.
  void ask(std::uint32_t first, std::uint32_t last, std::uint32_t step) {
    ask(plugin_, {shared.calls(), shared.numbers(), shared.values()}, first, last, step);
  }
  void ask(std::uint32_t first, std::uint32_t last) { ask(first, last, step_); }

  void ask_empty(std::uint32_t first, std::uint32_t last, std::uint32_t step) {
    ask(Detector::empty(), {shared.calls_of_empty(), shared.numbers_of_empty(), shared.values_of_empty()},
        first, last, step);
  }

  /// Asks the plug-in's detector about the whole batch, and returns the computing time, less the computing
  /// time of the same calls to the empty detector. The time includes all threads, since a plug-in may have
  /// threads of its own. Before the measurement, makes the detector decide some queries, which brings the
  /// detector's code into the caches. Omits these extra queries if the first query takes so long that caches
  /// make no difference.
  std::uint64_t time_of_warm() {
    constexpr std::uint64_t long_query = 1'000'000;
    const std::uint32_t all = call_.queries;
    const auto timed = [&](std::uint32_t from, std::uint32_t to) {
      return time_beyond(
          CLOCK_PROCESS_CPUTIME_ID, [&] { ask(from, to); }, [&] { ask_empty(from, to, step_); });
    };
    const auto few = std::min<std::uint32_t>(warm_up_queries, all);
    ask_empty(0, few, step_);
    if (step_ == 1 && all > 0) {
      const std::uint64_t of_first = timed(0, 1);
      if (of_first >= long_query) return of_first + timed(1, all);
    }
    ask(0, few);
    kernel_nanoseconds_ = 0;
    return timed(0, all);
  }

  /// The last measured time, without the time that the detector spent on copies to and from a device.
  [[nodiscard]] std::uint64_t kernel_nanoseconds() const { return kernel_nanoseconds_; }

  /// Calls ask(x, h) for each query of the batch, and stores the result as the answer to this query.
  template <class Ask>
  void give(const Ask& ask) {
    for (std::uint32_t i = 0; i < call_.queries; ++i) {
      begin(i);
      shared.numbers()[i] = ask(coordinates(plugin_, call_.kind, i, 1), shared.separations()[i]);
      note(shared.calls() + i, 1, call_.number);
    }
  }
  void give_bounds() {
    give([&](const double* x, double h) { return plugin_.bound(call_.kind, x, h).bound; });
  }
  void give_distance() {
    give([&](const double* x, double /*h*/) {
      const DistanceAnswer given = plugin_.distance(call_.kind, x);
      std::copy(given.weights.begin(), given.weights.end(), answers->more.begin());
      return given.distance;
    });
  }
  void give_step() {
    give([&](const double* x, double /*h*/) {
      const StepAnswer given = plugin_.step(call_.kind, x);
      answers->more = given.y;
      return given.clearance;
    });
  }

 private:
  void ask(const Detector& detector, const Answers& to, std::uint32_t first, std::uint32_t last,
           std::uint32_t step) {
    for (std::uint32_t i = first; i < last; i += step) {
      const std::uint32_t n = std::min(step, last - i);
      note(to.calls + i, n, 0);
      begin(i);
      detector.decide(call_.kind, coordinates(plugin_, call_.kind, i, n), shared.separations() + i,
                      std::span(to.values + i, n), std::span(to.numbers + i, n));
      note(to.calls + i, n, call_.number);
      kernel_nanoseconds_ += detector.kernel_nanoseconds();
    }
  }

  const Detector& plugin_;
  const Call& call_;
  std::uint32_t step_;
  std::uint64_t kernel_nanoseconds_ = 0;
};

void answer(const Detector& detector, const Call& call) {
  shared.n = call.queries;
  Asking asking(detector, call);
  switch (call.request) {
    case Request::load:
    case Request::share:
      break;  // the plug-in is loaded already
    case Request::decide:
      asking.ask(0, call.queries);
      break;
    case Request::decide_timed:
      answers->nanoseconds = asking.time_of_warm();
      answers->kernel_nanoseconds = asking.kernel_nanoseconds();
      break;
    case Request::time_each:
      for (std::uint32_t i = 0; i < call.queries; ++i)
        shared.nanoseconds()[i] = best_time_beyond(
            CLOCK_PROCESS_CPUTIME_ID, [&] { asking.ask(i, i + 1, 1); },
            [&] { asking.ask_empty(i, i + 1, 1); });
      break;
    case Request::bounds:
      asking.give_bounds();
      break;
    case Request::distances:
      asking.give_distance();
      break;
    case Request::steps:
      asking.give_step();
      break;
  }
}

void reply(std::uint64_t number) {
  while (send(reply_socket, &number, sizeof number, MSG_NOSIGNAL) < 0 && errno == EINTR) {
  }
}

/// The two descriptors that come with Request::share. The first belongs to the memory for questions, and the
/// second to the memory for answers.
using Files = std::array<int, 2>;

/// Receives a call with at most `most` queries; if `files` is not null, also receives the files that come
/// with the call.
bool receive(Call& call, std::uint32_t most, Files* files = nullptr) {
  iovec content{&call, sizeof call};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(Files))> control{};
  msghdr message{};
  message.msg_iov = &content;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = files == nullptr ? 0 : control.size();
  ssize_t size = -1;
  while ((size = recvmsg(reply_socket, &message, MSG_CMSG_CLOEXEC)) < 0 && errno == EINTR) {
  }
  if (size != sizeof call || call.queries > most) return false;
  if (files == nullptr) return true;
  const cmsghdr* const attached = CMSG_FIRSTHDR(&message);
  if (attached == nullptr || attached->cmsg_len != CMSG_LEN(sizeof(Files))) return false;
  std::memcpy(files, CMSG_DATA(attached), sizeof(Files));
  return true;
}

/// Maps shared memory, and closes its file. Returns null if the memory cannot be mapped.
template <class Memory>
Memory* map(int file, int protection, std::size_t bytes) {
  void* const memory = mmap(nullptr, bytes, protection, MAP_SHARED, file, 0);
  close(file);
  return memory == MAP_FAILED ? nullptr : static_cast<Memory*>(memory);
}

/// Receives the call that shares the memory of batches. Returns whether that memory can be used.
bool receive_memory(Call& call) {
  Files files{};
  if (!receive(call, largest_batch, &files)) return false;
  most_queries = call.queries;
  shared = {.questions = map<double>(files[0], PROT_READ, most_queries * BatchMemory::bytes_of_question),
            .answers =
                map<std::byte>(files[1], PROT_READ | PROT_WRITE, most_queries * BatchMemory::bytes_of_answer),
            .n = 0};
  return shared.questions != nullptr && shared.answers != nullptr;
}

void describe(const DetectorInfo& info, const std::string& names) {
  PluginDescription& about = answers->about;
  if (info.name.size() >= about.name.size())
    throw Error("found options of " + std::to_string(info.name.size()) + " bytes, expected less than " +
                std::to_string(about.name.size()));
  copy(info.name, about.name);
  copy(info.version, about.version);
  copy(info.about, about.about);
  copy(names, about.names);
  about.kinds = info.kinds;
  about.is_narrow = info.is_narrow ? 1 : 0;
  about.time_sort = static_cast<std::int32_t>(info.time_sort);
  about.separation_kinds = info.separation_kinds;
  about.distance_kinds = info.distance_kinds;
  about.step_kinds = info.step_kinds;
  about.in_arrays = info.in_arrays ? 1 : 0;
  about.claims_bound = info.claims_bound ? 1 : 0;
  about.apart_at_start = info.contract.apart_at_start ? 1 : 0;
  about.one_root = info.contract.one_root ? 1 : 0;
  about.apart_by = info.contract.apart_by;
  about.grid = info.contract.grid;
  about.shortest = info.contract.shortest;
  about.longest = info.contract.longest;
  about.batch = info.batch;
}

/// Opens a detector, and describes it to nearmiss.
std::unique_ptr<Detector> open_detector(const nearmiss_subject& subject, const std::string& options,
                                        const std::vector<std::string>& names) {
  auto detector = std::make_unique<Detector>(subject, options);
  std::string lines;
  for (const std::string& name : names) lines += name + "\n";
  describe(detector->info(), lines);
  return detector;
}

/// A detector that is ready to be asked, and the process that runs it.
struct Loaded {
  std::unique_ptr<Detector> detector;  ///< null if the detector cannot be used
  pid_t process = getpid();
};

/// Loads the plug-in with this name. The plug-in's library or program lives as long as this process.
Loaded load(std::string_view name) {
  try {
    if (is_program(name)) {
      static const Program program(std::string(name.substr(program_prefix.size())));
      return {open_detector(program.subject(), "", {}), program.process()};
    }
    const PluginName parsed = PluginName::parse(name);
    static const PluginLibrary library(parsed.path);
    return {open_detector(library.subject(parsed.subject), parsed.options, library.names())};
  } catch (const Error& error) {
    const std::string_view text = error.what();
    // dlopen(3) may run out of memory without a call of our malloc, so this code notes the refusal.
    if (text.ends_with(std::strerror(ENOMEM))) note_refusal();
    copy(text, answers->error);
    return {};
  }
}

}  // namespace

namespace nearmiss::isolation {

int answer_requests(const char* plugin, std::uint64_t bytes) {
  answers = map<SharedAnswers>(answers_memory, PROT_READ | PROT_WRITE, sizeof(SharedAnswers));
  if (answers == nullptr) return 1;
  note_refusals_in(answers->memory_refused);
  // If the plug-in is a program, the program's stack is in another process.
  prepare_for_faults(!is_program(plugin));
  Call call{};
  if (!receive(call, 0)) return 0;
  limit_memory_of_loading(bytes);
  const Loaded loaded = load(plugin);
  reply(call.number);
  if (!loaded.detector || !receive_memory(call)) return 0;
  limit_memory(loaded.process, bytes);
  reply(call.number);
  while (receive(call, most_queries)) {
    try {
      answer(*loaded.detector, call);
    } catch (const UnaskedBytes&) {
      call.number = no_reply;
    } catch (...) {
      note_exception();
      if (loaded.process != getpid()) std::abort();  // the detector's program has ended
      make_arithmetic_plain();
      answers->threw = call.number;
    }
    reply(call.number);
  }
  return 0;
}

}  // namespace nearmiss::isolation

#include "fuzz/subjects/isolation/worker/answering.hpp"

#include <sys/mman.h>
#include <sys/socket.h>
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

namespace {

using namespace nearmiss;
using namespace nearmiss::isolation;

const SharedQuestions* questions = nullptr;
SharedAnswers* answers = nullptr;

template <std::size_t n>
void copy(std::string_view text, std::array<char, n>& to) {
  to[text.copy(to.data(), n - 1)] = '\0';
}

/// Notes the message of the exception that is being handled.
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

/// Notes an exception that cannot be caught, such as one from another thread, and ends the process.
[[noreturn]] void note_exception_and_end() {
  note_exception();
  std::abort();
}

/// Sets how this process ends, before the plug-in is loaded.
void prepare_for_faults() {
  // A crash must look like a crash, even if a sanitizer would turn it into an exit.
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) std::signal(signal, SIG_DFL);
  std::set_terminate(note_exception_and_end);
}

/// Notes which query comes next, because the plug-in may crash in it.
void begin(std::uint32_t i) {
  answers->memory_refused.store(0, std::memory_order_relaxed);
  answers->current.store(i, std::memory_order_release);
  answers->calls.fetch_add(1, std::memory_order_release);
}

/// Notes an answer. The number of its call comes last, because the process may end at any moment.
void note(PluginAnswer& to, std::uint64_t call, double number, int value) {
  to.number = number;
  to.value = value;
  std::atomic_ref(to.call).store(call, std::memory_order_release);
}

using Answers = std::array<PluginAnswer, batch_size>;

/// Has a detector decide the queries [first, last) in steps of `step`, and notes the answers in `noted`.
void ask(const Detector& detector, Answers& noted, std::uint64_t call, std::uint32_t first,
         std::uint32_t last, std::uint32_t step) {
  static std::array<int, batch_size> values;
  static std::array<double, batch_size> times;
  for (std::uint32_t i = first; i < last; i += step) {
    const std::uint32_t n = std::min(step, last - i);
    begin(i);
    detector.decide(questions->kind, questions->queries[i].data(), &questions->separations[i],
                    std::span(values).first(n), std::span(times).first(n));
    for (std::uint32_t k = 0; k < n; ++k) note(noted[i + k], call, times[k], values[k]);
  }
}

/// Asks the empty detector. Its answers go elsewhere, so that nobody takes them for those of the plug-in.
void ask_empty(std::uint64_t call, std::uint32_t first, std::uint32_t last, std::uint32_t step) {
  static Answers of_empty;
  ask(Detector::empty(), of_empty, call, first, last, step);
}

/// Asks the plug-in's detector, and measures the time of all threads, since a plug-in may have threads of its
/// own. Some queries are decided before that, so that the code is in the caches; but not if the first takes
/// so long that this makes no difference.
std::uint64_t time_of_warm(const Detector& detector, std::uint64_t call, std::uint32_t first,
                           std::uint32_t last, std::uint32_t step) {
  constexpr std::uint64_t long_query = 1'000'000;
  const auto ask_some = [&](std::uint32_t from, std::uint32_t to) {
    ask(detector, answers->of, call, from, to, step);
  };
  const auto timed = [&](std::uint32_t from, std::uint32_t to) {
    return time_beyond(
        CLOCK_PROCESS_CPUTIME_ID, [&] { ask_some(from, to); }, [&] { ask_empty(call, from, to, step); });
  };
  const auto few = std::min<std::uint32_t>(first + warm_up_queries, last);
  ask_empty(call, first, few, step);
  if (step == 1 && first < last) {
    const std::uint64_t of_first = timed(first, first + 1);
    if (of_first >= long_query) return of_first + timed(first + 1, last);
  }
  ask_some(first, few);
  return timed(first, last);
}

void give_bounds(const Detector& detector, std::uint64_t call, std::uint32_t first, std::uint32_t last) {
  for (std::uint32_t i = first; i < last; ++i) {
    begin(i);
    const BoundAnswer given =
        detector.bound(questions->kind, questions->queries[i].data(), questions->separations[i]);
    note(answers->of[i], call, given.bound, 0);
  }
}

void answer(const Detector& detector, const Call& call) {
  const std::uint32_t first = questions->first;
  const std::uint32_t last = std::min<std::uint32_t>(questions->last, batch_size);
  const auto step = static_cast<std::uint32_t>(std::min(detector.info().batch, batch_size));
  switch (call.request) {
    case Request::load:
      break;  // it is loaded already
    case Request::decide:
      ask(detector, answers->of, call.number, first, last, step);
      break;
    case Request::decide_timed:
      answers->nanoseconds = time_of_warm(detector, call.number, first, last, step);
      break;
    case Request::time_each:
      for (std::uint32_t i = first; i < last; ++i)
        answers->of[i].nanoseconds = best_time_beyond(
            CLOCK_PROCESS_CPUTIME_ID, [&] { ask(detector, answers->of, call.number, i, i + 1, 1); },
            [&] { ask_empty(call.number, i, i + 1, 1); });
      break;
    case Request::bounds:
      give_bounds(detector, call.number, first, last);
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
  about.claims_bound = info.claims_bound ? 1 : 0;
  about.apart_at_start = info.contract.apart_at_start ? 1 : 0;
  about.one_root = info.contract.one_root ? 1 : 0;
  about.apart_by = info.contract.apart_by;
  about.grid = info.contract.grid;
  about.shortest = info.contract.shortest;
  about.longest = info.contract.longest;
  about.batch = info.batch;
}

/// Opens a detector, and describes it.
std::unique_ptr<Detector> open_detector(const nearmiss_subject& subject, const std::string& options,
                                        const std::vector<std::string>& names) {
  auto detector = std::make_unique<Detector>(subject, options);
  std::string lines;
  for (const std::string& name : names) lines += name + "\n";
  describe(detector->info(), lines);
  return detector;
}

/// A detector that is ready to be asked, and the process that it is in.
struct Loaded {
  std::unique_ptr<Detector> detector;  ///< null if it cannot be used
  pid_t process = getpid();
};

/// Loads the plug-in of this name, whose library or program lives as long as this process.
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
    if (text.ends_with(std::strerror(ENOMEM))) note_refusal();  // dlopen(3) does not allocate by malloc
    copy(text, answers->error);
    return {};
  }
}

}  // namespace

namespace nearmiss::isolation {

int answer_requests(const char* plugin, std::uint64_t bytes) {
  questions = map<const SharedQuestions>(questions_memory, PROT_READ);
  answers = map<SharedAnswers>(answers_memory, PROT_READ | PROT_WRITE);
  if (questions == nullptr || answers == nullptr) return 1;
  note_refusals_in(answers->memory_refused);
  prepare_for_faults();
  Call call{};
  if (!receive(call)) return 0;
  limit_memory_of_loading(bytes);
  const Loaded loaded = load(plugin);
  limit_memory(loaded.process, bytes);
  reply(call.number);
  while (loaded.detector && receive(call)) {
    try {
      answer(*loaded.detector, call);
    } catch (const UnaskedBytes&) {
      call.number = no_reply;
    } catch (...) {
      note_exception();
      if (loaded.process != getpid()) std::abort();  // the program has ended
      make_arithmetic_plain();
      answers->threw = call.number;
    }
    reply(call.number);
  }
  return 0;
}

}  // namespace nearmiss::isolation

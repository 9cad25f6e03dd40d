#include "fuzz/subjects/isolation/worker_process.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <mutex>
#include <sstream>
#include <utility>
#include <vector>

#include "ccd/query/printable.hpp"
#include "ccd/subjects/plugin.hpp"
#include "fuzz/parallel.hpp"
#include "fuzz/subjects/isolation/room.hpp"

namespace nearmiss::isolation {

namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

/// A text that the worker wrote, made printable.
template <std::size_t n>
std::string text(const std::array<char, n>& written) {
  return printable(std::string_view(written.data(), strnlen(written.data(), n)));
}

/// The printable lines that the plug-in's process wrote to standard error. An address in memory at the end of
/// a line, "[0x7f0012345678]", is removed, because it differs from process to process.
std::string lines_of(const Status& ended) {
  std::istringstream written(
      std::string(ended.errors.data(), strnlen(ended.errors.data(), ended.errors.size())));
  std::string lines;
  for (std::string line; std::getline(written, line);) {
    if (const std::size_t address = line.rfind("[0x"); address != line.npos && line.ends_with(']'))
      line.resize(address);
    lines += printable(line) + "\n";
  }
  return lines;
}

// An allowance for the computing time that the worker itself needs for a timed call: the worker receives the
// call, asks Detector::empty() twice, and replies. In 1,500 calls with empty caches on two busy cores, the
// median was 20 microseconds, and the longest time was 1,500 microseconds.
constexpr Duration of_call_itself = std::chrono::microseconds(500);
constexpr double most_asked_twice = 2;  // once to warm up the caches, and once to measure the time

constexpr std::uint64_t mebibyte = 1 << 20;

std::string name_of_batch(const DetectorInfo& info, std::size_t queries) {
  return fmt::format("{}: a batch of {} queries", info.name, queries);
}

/// Throws Error if `fault` is not "". The text `fault` says what is wrong with a plug-in's description.
void expect_no(const std::string& fault) {
  if (!fault.empty()) throw Error("the plug-in's process described " + fault);
}

/// The largest number of times that a request calls the plug-in for one query: two calls for a timed batch
/// (the first of them warms up the caches), and three calls for the time of a single query.
double calls_per_query(Request request) {
  return request == Request::decide_timed ? 2 : request == Request::time_each ? 3 : 1;
}

}  // namespace

std::uint64_t memory_of_batch(const DetectorInfo& info, std::size_t queries, const PluginLimits& limits) {
  queries = std::min(queries, capacity_for(info));
  const std::uint64_t bytes = queries * (BatchMemory::bytes_of_question + BatchMemory::bytes_of_answer);
  if (queries > least_capacity && limits.bytes != 0 && bytes > limits.bytes)
    throw TrialError(
        fmt::format("{} needs {} MiB of memory, found a limit of {} MiB, expected a larger --query-memory or "
                    "fewer queries",
                    name_of_batch(info, queries), bytes / mebibyte + 1, limits.bytes / mebibyte));
  return bytes;
}

DetectorInfo info_of(const PluginDescription& about, const std::string& options) {
  DetectorInfo info;
  info.name = text(about.name);
  info.version = text(about.version);
  info.about = text(about.about);
  info.kinds = about.kinds & bits_of_all_kinds;
  info.is_narrow = about.is_narrow != 0;
  info.time_sort =
      static_cast<TimeSort>(std::clamp(about.time_sort, 0, static_cast<int>(TimeSort::free_step)));
  info.separation_kinds = about.separation_kinds & info.kinds;
  info.distance_kinds = about.distance_kinds & bits_of_all_kinds;
  info.step_kinds = about.step_kinds & bits_of_all_kinds;
  info.batch = std::clamp<std::uint64_t>(about.batch, 1, largest_batch);
  info.in_arrays = about.in_arrays != 0;
  info.claims_bound = about.claims_bound != 0;
  info.contract = {.apart_at_start = about.apart_at_start != 0,
                   .one_root = about.one_root != 0,
                   .apart_by = about.apart_by,
                   .grid = about.grid,
                   .shortest = about.shortest,
                   .longest = about.longest};
  const std::string own = info.name.substr(0, info.name.find(':'));
  expect_no(fault_of_name(own));
  if (info.name != own + (options.empty() ? "" : ":" + options))
    expect_no("the name '" + info.name + "', which has other options than were given");
  expect_no(fault_of(info.contract));
  return info;
}

std::vector<std::string> names_of(const PluginDescription& about) {
  std::istringstream lines{std::string(about.names.data(), strnlen(about.names.data(), about.names.size()))};
  std::vector<std::string> names;
  for (std::string line; std::getline(lines, line); names.push_back(line)) expect_no(fault_of_name(line));
  if (names.size() > most_detectors) expect_no("more than " + std::to_string(most_detectors) + " detectors");
  return names;
}

bool WorkerProcess::Elapsed::exceeds(const Elapsed& limit) const {
  return computing >= limit.computing || passed >= limit.passed;
}

WorkerProcess::Elapsed WorkerProcess::Elapsed::with_waiting(Duration computing) {
  constexpr double patience = 10;
  return {computing, patience * computing};
}

/// Measures the times that have passed since this object was made.
class WorkerProcess::Watch {
 public:
  explicit Watch(const WorkerProcess& worker) : worker_(worker) {}
  [[nodiscard]] Elapsed elapsed() const {
    const Duration own = worker_.own_computing() - own_;
    const Duration running = worker_.others_.running - others_.running;
    const Duration ended = worker_.others_.ended - others_.ended;
    const Duration certain =
        own + (knew_others_ ? running + std::max(Duration{}, ended - clock_tick()) : Duration{});
    const Duration passed = steady_clock::now() - start_ - (worker_.suspended_ - suspended_);
    return {std::max(Duration{}, own + running + ended), passed, certain};
  }

 private:
  const WorkerProcess& worker_;
  Duration own_ = worker_.own_computing();
  ComputingTime others_ = worker_.others_;
  bool knew_others_ = worker_.others_compute_;
  Duration suspended_ = worker_.suspended_;
  steady_clock::time_point start_ = steady_clock::now();
};

Duration WorkerProcess::own_computing() const { return computing_time(supervisor_.process()); }

void WorkerProcess::look_at_others() {
  const Duration before = others_.sum();
  others_ = computing_time_of_tree(supervisor_.worker());
  others_.running -= own_computing();
  constexpr Duration of_supervisor = std::chrono::milliseconds(1);  // more than the supervisor needs in a
                                                                    // call
  others_compute_ |= others_.sum() - before > of_supervisor;
}

WorkerProcess::WorkerProcess(const PluginCode& file, const PluginLimits& limits) : limits_(limits) {
  start(file.name());
  try {
    load(file.name());
  } catch (const Error&) {
    // If the file was changed, this call throws PluginChanged, because the change is then the reason for the
    // failure.
    file.expect_unchanged(*limits_.stop);
    throw;
  }
  // If the file was changed, the worker may have loaded other bytes than nearmiss has read.
  file.expect_unchanged(*limits_.stop);
}

void WorkerProcess::dismiss() {
  if (leaves_by_) return;
  leaves_by_ = steady_clock::now() + std::chrono::ceil<milliseconds>(limits_.leaving);
  replies_.close();
  if (!is_waiting_) supervisor_.dismiss();
}

WorkerProcess::~WorkerProcess() {
  dismiss();
  const auto left = std::chrono::ceil<milliseconds>(*leaves_by_ - steady_clock::now());
  if (is_waiting_) ends_within(std::max(left, milliseconds(0)));
}

void WorkerProcess::start(const std::string& plugin) {
  SocketPair replies;
  replies_ = std::move(replies.ours);
  supervisor_.start({plugin, std::to_string(limits_.bytes), limits_.own_namespace ? "1" : "0"},
                    {replies.theirs.number(), header_.file()}, *limits_.stop);
}

std::uint64_t WorkerProcess::data() const { return largest_data_of_tree(supervisor_.worker()); }

void WorkerProcess::load(const std::string& plugin) {
  // This process checks the memory that the plug-in takes, because the system's limit does not count data
  // that is mapped over another mapping, as static data is. The limit `most_data_` also leaves room for the
  // worker itself, which may need a little more memory than it has now.
  constexpr std::uint64_t of_worker = 1 << 20;
  most_data_ = data() + of_worker + 2 * limits_.bytes;
  const Elapsed limit{limits_.loading, limits_.loading};
  const End end = ask({0, Request::load}, limit, limit);
  if (end == End::query_late || end == End::call_late)
    throw Error(
        fmt::format("{}: the plug-in takes longer than {:.0f} s to load", plugin, limits_.loading.count()));
  const std::string expected = "expected at most twice --query-memory";
  if (end == End::too_large)
    throw Error(
        fmt::format("{}: the plug-in took too much memory while it was loaded: {}", plugin, expected));
  const std::string memory = answers_->memory_refused == 0 ? "" : ". It was refused memory: " + expected;
  if (end != End::done) {
    const std::string exception = text(answers_->exception);
    throw Error(plugin + ": the plug-in " +
                (exception.empty() ? "ended its process" : "threw an exception: " + exception) +
                " while it was loaded" + memory);
  }
  if (answers_->error[0] != '\0') throw Error(text(answers_->error) + memory);
  try {
    info_ = info_of(answers_->about, is_program(plugin) ? "" : PluginName::parse(plugin).options);
    names_ = names_of(answers_->about);
  } catch (const Error& fault) {
    throw Error(plugin + ": " + fault.what());
  }
  share();
  look_at_others();
  others_compute_ = false;  // the computing time of other processes during loading does not count
}

void WorkerProcess::share() {
  const std::size_t most = capacity_for(info_);
  questions_of_batch_ = SharedMemory("nearmiss-questions", most * BatchMemory::bytes_of_question, false);
  answers_of_batch_ = SharedMemory("nearmiss-answers", most * BatchMemory::bytes_of_answer, true);
  batch_ = {
      .questions = questions_of_batch_.as<double>(), .answers = answers_of_batch_.as<std::byte>(), .n = 0};
  const Elapsed limit{limits_.loading, limits_.loading};
  const Call call{.number = 0, .request = Request::share, .queries = static_cast<std::uint32_t>(most)};
  if (ask(call, limit, limit) != End::done)
    throw Error(info_.name + ": the plug-in's process does not take the memory of batches");
}

void WorkerProcess::reserve(std::size_t queries) {
  if (queries <= reserved_) return;
  const std::string what = name_of_batch(info_, queries);
  const std::uint64_t bytes = memory_of_batch(info_, queries, limits_);
  // Only one worker at a time may reserve memory, so that two workers do not count on the same free memory.
  static std::mutex one_by_one;
  const std::lock_guard lock(one_by_one);
  expect_memory(what, bytes);
  if (!questions_of_batch_.reserve(queries * BatchMemory::bytes_of_question) ||
      !answers_of_batch_.reserve(queries * BatchMemory::bytes_of_answer))
    throw TrialError(fmt::format("{}: found no shared memory: {}", what, std::strerror(errno)));
  reserved_ = queries;
}

void WorkerProcess::give(std::span<const Query> queries) {
  const std::size_t n = queries.size();
  reserve(n);
  batch_.n = n;
  in_parts(n, [&](std::size_t first, std::size_t last) {
    limits_.stop->check(Stop::grace);
    for (std::size_t i = first; i < last; ++i) {
      const Query seen = rounded_for(info_, queries[i]);
      lay_out(info_, seen, i, n, batch_.x());
      batch_.separations()[i] = seen.separation;
    }
  });
}

std::optional<WorkerFailure> WorkerProcess::perform(Request request, std::span<const Query> queries) {
  give(queries);
  const auto n = static_cast<std::uint32_t>(queries.size());
  answers_->current = 0;
  answers_->exception[0] = '\0';
  const Call call{++call_, request, queries.front().kind, n};
  const bool decides = request == Request::decide || request == Request::decide_timed;
  const auto at_once = decides ? static_cast<std::uint32_t>(std::min<std::size_t>(info_.batch, n)) : 1;
  const Duration of_queries = limits_.time * calls_per_query(request);
  End end = ask(call, Elapsed::with_waiting(limit_of_batch(at_once) * limits_.time),
                Elapsed::with_waiting(n == 1 ? of_queries : call_limit * of_queries));
  const auto answers = [&](std::uint32_t i) { return batch_.calls()[i] == call.number; };
  if (end == End::done && answers_->threw == call.number) end = End::threw;
  for (std::uint32_t i = 0; i < n && end == End::done; ++i)
    if (!answers(i)) end = End::broken;
  if (end == End::done) {
    // During the first call, the plug-in may prepare something that later calls need.
    const bool is_first = call.number == 1;
    least_ = is_first ? Duration{} : (elapsed_.certain - of_call_itself) / most_asked_twice;
    return std::nullopt;
  }
  // A worker that does not cheat has answered all queries before the current query.
  std::uint32_t query = std::min<std::uint32_t>(answers_->current, n - 1);
  for (std::uint32_t i = 0; i < query; ++i)
    if (!answers(i)) query = i;
  WorkerFailure found = failure(end, query);
  if (end == End::dead) found.errors = lines_of(ended_);
  if (n > 1 && (at_once > 1 || end == End::call_late))
    found.suspects = std::min(end == End::call_late ? n : at_once, n - query);
  return found;
}

WorkerFailure WorkerProcess::failure(End end, std::uint32_t query) const {
  if (answers_->memory_refused != 0 && end != End::broken) return {query, Fault::memory};
  switch (end) {
    case End::query_late:
    case End::call_late:
      return {query, Fault::time};
    case End::threw:
      return {.query = query, .fault = Fault::exception, .text = text(answers_->exception), .goes_on = true};
    case End::dead: {
      if (std::string exception = text(answers_->exception); !exception.empty())
        return {.query = query, .fault = Fault::exception, .text = std::move(exception)};
      const bool exited = ended_.code == CLD_EXITED;
      return {query, Fault::crash, exited ? -ended_.status : ended_.status};
    }
    default:
      return {query, Fault::protocol};
  }
}

WorkerProcess::End WorkerProcess::ask(const Call& call, const Elapsed& of_query, const Elapsed& of_call) {
  is_waiting_ = false;
  const End end = sent(call, of_query, of_call);
  is_waiting_ = end == End::done;
  return end;
}

WorkerProcess::End WorkerProcess::sent(const Call& call, const Elapsed& of_query, const Elapsed& of_call) {
  constexpr int look_again_ms = 10;
  constexpr Duration longest_turn = milliseconds(100);
  // Looking at the plug-in's other processes takes at most a tenth of the time.
  constexpr int most_looking = 10;
  constexpr std::uint64_t calls_between_looks = 16;
  // No look is due while the plug-in is being loaded.
  const bool looks = others_compute_ || (call.number + 1) % calls_between_looks == 0;
  if (others_compute_) look_at_others();
  auto next_look = steady_clock::now();
  // The clock starts before the call is sent, because the worker may be done before this process runs again.
  const Watch watch(*this);
  std::uint32_t calls = answers_->calls;
  // A failure to send is ignored here: if the worker is dead or does not read the call, no reply comes, and
  // the loop below ends the call.
  send_call(call);
  std::optional<Watch> query_watch(watch);
  auto turn = steady_clock::now();
  while (true) {
    std::array<pollfd, 2> sockets{{{replies_.number(), POLLIN, 0}, {supervisor_.socket(), POLLIN, 0}}};
    const bool spoke = poll(sockets.data(), sockets.size(), look_again_ms) > 0;
    limits_.stop->check(Stop::grace);
    const auto now = steady_clock::now();
    // If nearmiss did not run for longer than longest_turn, it was suspended, and the plug-in may have been
    // suspended, too.
    if (!spoke) suspended_ += std::max(Duration{}, Duration(now - turn) - longest_turn);
    turn = now;
    if (spoke ? looks : now >= next_look) {
      look_at_others();
      next_look = now + most_looking * (steady_clock::now() - now);
    }
    elapsed_ = watch.elapsed();
    if (call.request == Request::load && limits_.bytes != 0 && data() > most_data_) return End::too_large;
    if (spoke)
      if (const auto end = end_of(call.number)) return *end;
    if (const std::uint32_t begun = answers_->calls; begun != calls) {
      calls = begun;
      query_watch.emplace(*this);
    } else if (query_watch->elapsed().exceeds(of_query)) {
      return End::query_late;
    }
    if (elapsed_.exceeds(of_call)) return End::call_late;
  }
}

void WorkerProcess::send_call(const Call& call) const {
  Call copy = call;
  iovec content{&copy, sizeof copy};
  const std::array files{questions_of_batch_.file(), answers_of_batch_.file()};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof files)> control{};
  msghdr message{};
  message.msg_iov = &content;
  message.msg_iovlen = 1;
  if (call.request == Request::share) {
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    cmsghdr* const attached = CMSG_FIRSTHDR(&message);
    attached->cmsg_level = SOL_SOCKET;
    attached->cmsg_type = SCM_RIGHTS;
    attached->cmsg_len = CMSG_LEN(sizeof files);
    std::memcpy(CMSG_DATA(attached), files.data(), sizeof files);
  }
  static_cast<void>(sendmsg(replies_.number(), &message, MSG_NOSIGNAL | MSG_DONTWAIT));
}

std::optional<WorkerProcess::End> WorkerProcess::end_of(std::uint64_t call) {
  const std::optional<End> end = read_reply(call);
  if (!end) return ends_within(milliseconds(0)) ? std::optional(End::dead) : std::nullopt;
  if (end != End::dead) return end;
  // If the process dies, its socket is closed, and its supervisor reports the end right afterwards.
  return ends_within(milliseconds(1000)) ? End::dead : End::broken;
}

/// How the call ended, according to the worker's socket; nothing if this socket has no message.
std::optional<WorkerProcess::End> WorkerProcess::read_reply(std::uint64_t call) const {
  std::uint64_t reply = 0;
  std::array<char, sizeof reply + 1> message{};
  const auto size = recv(replies_.number(), message.data(), message.size(), MSG_DONTWAIT);
  if (size < 0 && errno == EAGAIN) return std::nullopt;
  if (size <= 0) return End::dead;
  std::memcpy(&reply, message.data(), sizeof reply);
  char more = 0;
  const bool is_alone = recv(replies_.number(), &more, sizeof more, MSG_PEEK | MSG_DONTWAIT) <= 0;
  return size == sizeof reply && reply == call && is_alone ? End::done : End::broken;
}

bool WorkerProcess::ends_within(milliseconds time) {
  if (!is_ready(supervisor_.socket(), time)) return false;
  Status told{};
  // If the socket is closed and has no message, the supervisor itself has ended, too.
  if (recv(supervisor_.socket(), &told, sizeof told, MSG_DONTWAIT) == sizeof told) ended_ = told;
  return true;
}

std::uint64_t WorkerProcess::limited(std::uint64_t nanoseconds, Duration least) const {
  const auto in_nanoseconds = [](Duration time) { return static_cast<std::uint64_t>(time.count() * 1e9); };
  const Duration most = std::max({elapsed_.computing, elapsed_.passed, least});
  return std::clamp(nanoseconds, in_nanoseconds(std::max(least, Duration{})), in_nanoseconds(most));
}

}  // namespace nearmiss::isolation

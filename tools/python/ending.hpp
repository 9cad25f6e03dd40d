// Lets the interpreter exit while other threads are still in a call. Python ends a thread that asks for its
// lock after that, and a thread that is ended within C++ aborts the program.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <set>
#include <thread>

namespace nearmiss::python {

/// Whether the interpreter is exiting.
inline std::atomic<bool> is_ending = false;
/// The thread in which it exits. Functions that Python calls at its exit may still make calls there.
inline std::thread::id ending_thread;
/// The number of calls that are under way, and their threads, which are known while one has Python's lock.
inline std::atomic<int> running = 0;
inline std::multiset<unsigned long> threads_of_calls;

/// Whether a call in this thread must end.
inline bool must_end() { return is_ending && std::this_thread::get_id() != ending_thread; }

/// Ends a call by the exception that ends its thread without a word. A thread that prints while the
/// interpreter exits aborts the program, too.
[[noreturn]] inline void end_silently() {
  PyErr_SetNone(PyExc_SystemExit);
  throw pybind11::error_already_set();
}

/// Whether calls in this thread must end, as an object that changes when they must. Calls that Python makes at
/// its exit are not to end.
inline const std::atomic<bool>& ending() {
  static constinit const std::atomic<bool> never = false;
  return is_ending && !must_end() ? never : is_ending;
}

/// Notes that a call is under way. It is made and destroyed while this thread has Python's lock.
struct Running {
  Running() {
    if (must_end()) end_silently();
    ++running;
    threads_of_calls.insert(thread);
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  ~Running() {
    threads_of_calls.erase(threads_of_calls.find(thread));
    --running;
  }

  const unsigned long thread = PyThread_get_thread_ident();
};

/// Forgets the calls of a parent's other threads, in a child that was forked from this one.
inline void forget_other_threads() {
  const unsigned long own = PyThread_get_thread_ident();
  std::erase_if(threads_of_calls, [&](unsigned long each) { return each != own; });
  running = static_cast<int>(threads_of_calls.size());
}

/// Ends all calls; the package calls it when the interpreter exits. Waits a second at most, because a Python
/// function under trial may not return.
inline void end_calls() {
  ending_thread = std::this_thread::get_id();
  is_ending = true;
  // A Python function that computes on would be ended within C++.
  for (const unsigned long each : threads_of_calls) PyThreadState_SetAsyncExc(each, PyExc_SystemExit);
  const pybind11::gil_scoped_release others_run;
  constexpr std::chrono::milliseconds pause(1), patience(1000);
  for (auto waited = pause; running > 0 && waited < patience; waited += pause)
    std::this_thread::sleep_for(pause);
}

}  // namespace nearmiss::python

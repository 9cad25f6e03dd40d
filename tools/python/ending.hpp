// Lets the interpreter exit while other threads are still in a call of this package. Once the interpreter
// exits, Python ends every other thread that asks for Python's lock (the GIL). If Python ended a thread
// within C++, the program would abort.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <set>
#include <thread>

namespace nearmiss::python {

/// Whether the interpreter is exiting.
inline std::atomic<bool> is_ending = false;
/// The thread in which the interpreter exits. Functions that Python calls at its exit may still make calls
/// in this thread.
inline std::thread::id ending_thread;
/// The number of calls of this package's functions that are under way, and the threads that make these calls.
/// `threads_of_calls` may be used only with Python's lock.
inline std::atomic<int> running = 0;
inline std::multiset<unsigned long> threads_of_calls;

/// Whether calls in this thread must end.
inline bool must_end() { return is_ending && std::this_thread::get_id() != ending_thread; }

/// Ends a call by SystemExit, which ends the call's thread without output: a thread that printed while the
/// interpreter exits would also abort the program.
[[noreturn]] inline void end_silently() {
  PyErr_SetNone(PyExc_SystemExit);
  throw pybind11::error_already_set();
}

/// A flag that becomes true when calls in this thread must end. The flag stays false for calls that Python
/// makes at its exit.
inline const std::atomic<bool>& ending() {
  static constinit const std::atomic<bool> never = false;
  return is_ending && !must_end() ? never : is_ending;
}

/// Notes that a call is under way. Make and destroy this object while the thread has Python's lock.
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

/// In a forked child, forgets the calls of all threads of the parent except the thread that forked.
inline void forget_other_threads() {
  const unsigned long own = PyThread_get_thread_ident();
  std::erase_if(threads_of_calls, [&](unsigned long each) { return each != own; });
  running = static_cast<int>(threads_of_calls.size());
}

/// Ends all calls. The package calls this function when the interpreter exits. Waits at most a second,
/// because a Python function on trial may never return.
inline void end_calls() {
  ending_thread = std::this_thread::get_id();
  is_ending = true;
  // Raises SystemExit in Python functions that still compute: otherwise, Python would end their threads
  // within C++.
  for (const unsigned long each : threads_of_calls) PyThreadState_SetAsyncExc(each, PyExc_SystemExit);
  const pybind11::gil_scoped_release others_run;
  constexpr std::chrono::milliseconds pause(1), patience(1000);
  for (auto waited = pause; running > 0 && waited < patience; waited += pause)
    std::this_thread::sleep_for(pause);
}

}  // namespace nearmiss::python

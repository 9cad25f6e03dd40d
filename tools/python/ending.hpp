// What a module does when the interpreter exits while calls are under way in other threads. Python ends a thread
// that asks for its lock after that, and a thread that ends within C++ aborts the program.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace nearmiss::python {

inline std::atomic<bool> is_ending =
    false;                            ///< whether the interpreter is exiting, so that all calls must end
inline std::atomic<int> running = 0;  ///< number of calls that are under way

/// Ends this thread's part of the program without a word: a thread that prints while the interpreter exits
/// aborts the program, too.
[[noreturn]] inline void end_silently() {
  PyErr_SetNone(PyExc_SystemExit);
  throw pybind11::error_already_set();
}

/// Notes that a call is under way. It is made and destroyed while this thread has Python's lock.
struct Running {
  Running() {
    if (is_ending) end_silently();
    ++running;
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  ~Running() { --running; }
};

/// Ends all calls; the package calls it when the interpreter exits. Waits a few seconds at most, because a
/// Python function under trial may not return.
inline void end_calls() {
  is_ending = true;
  const pybind11::gil_scoped_release others_run;
  constexpr std::chrono::milliseconds pause(1), patience(3000);
  for (auto waited = pause; running > 0 && waited < patience; waited += pause)
    std::this_thread::sleep_for(pause);
}

}  // namespace nearmiss::python

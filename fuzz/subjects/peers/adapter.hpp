// The part that all adapters of CCDs in C++ share. Such a CCD decides one query at a time, and may have
// options that are numbers. An adapter has a function that decides, one that describes the detector, and
// nearmiss_get_subject().
#pragma once

#include <array>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>

#include "ccd/nearmiss_subject.h"
#include "ccd/subjects/number_options.hpp"

namespace nearmiss::peers {

/// One query: four vertices at t = 0 and t = 1, and the separation.
struct Question {
  const double* x;  ///< 24 coordinates (nearmiss_subject.h)
  double separation;

  [[nodiscard]] const double* start(int vertex) const { return x + 3 * vertex; }
  [[nodiscard]] const double* end(int vertex) const { return x + 12 + 3 * vertex; }
};

/// The detector's answer to one query.
struct Answer {
  int value = NEARMISS_NO_COLLISION;
  double time = std::numeric_limits<double>::quiet_NaN();

  /// The answer of a function that returns whether there is a collision.
  static Answer of(bool collides) { return {collides ? NEARMISS_COLLISION : NEARMISS_NO_COLLISION}; }
  static Answer of(bool collides, double time) { return {of(collides).value, time}; }
};

/// The function decide() of the interface, made from a function that decides one query.
template <Answer (*decide_one)(const void* state, int kind, const Question& question)>
void decide_each(void* state, int kind, std::size_t n, const double* x, const double* h, int* answer,
                 double* toi) {
  for (std::size_t i = 0; i < n; ++i) {
    const Answer said = decide_one(state, kind, {x + 24 * i, h[i]});
    answer[i] = said.value;
    toi[i] = said.time;
  }
}

/// A detector that decides both kinds, one query at a time. An adapter sets other members if need be.
template <Answer (*decide_one)(const void* state, int kind, const Question& question)>
nearmiss_subject detector(const char* name, const char* version, const char* about) {
  nearmiss_subject subject{};
  subject.interface_version = NEARMISS_INTERFACE;
  subject.name = name;
  subject.version = version;
  subject.about = about;
  subject.kinds = NEARMISS_VERTEX_TRIANGLE + NEARMISS_EDGE_EDGE;
  subject.decide = decide_each<decide_one>;
  return subject;
}

/// The detector for nearmiss_get_subject(index), among those that these functions describe.
template <nearmiss_subject (*... describe)()>
const nearmiss_subject* numbered(std::size_t index) {
  static const std::array subjects{describe()...};
  return index < subjects.size() ? &subjects[index] : nullptr;
}

/// Lets the user set these options. The detector's functions get a `State` for each thread.
template <class State, const auto& options>
void take_options(nearmiss_subject& subject) {
  subject.open = [](const char* text, char* message, std::size_t size) -> void* {
    auto state = std::make_unique<State>();
    const std::string fault = set_options(options, text, *state);
    if (fault.empty()) return state.release();
    std::snprintf(message, size, "%s", fault.c_str());
    return nullptr;
  };
  subject.close = [](void* state) { delete static_cast<State*>(state); };
}

}  // namespace nearmiss::peers

// Turns a plug-in for another processor into a program (fuzz/subjects/PROGRAMS.md), so that an emulator can
// run the plug-in.
#include <array>
#include <cstddef>
#include <cstdio>
#include <vector>

#include "ccd/nearmiss_subject.h"

namespace {

constexpr std::size_t row = 25;  // the coordinates and the separation
constexpr double asks_for_bound = 1;

/// Reads n numbers. Returns false if the input ends before n numbers have been read.
bool read(double* x, std::size_t n) { return std::fread(x, sizeof *x, n, stdin) == n; }

void answer(const nearmiss_subject& detector, double question, int kind, const std::vector<double>& x) {
  for (std::size_t i = 0; i < x.size(); i += row) {
    std::array<double, 2> numbers{0, -1};
    if (question == asks_for_bound) {
      numbers[0] = detector.distance_bound(nullptr, kind, &x[i]);
    } else {
      int hit = 0;
      detector.decide(nullptr, kind, 1, &x[i], &x[i + row - 1], &hit, &numbers[1]);
      numbers[0] = hit;
    }
    std::fwrite(numbers.data(), sizeof(double), numbers.size(), stdout);
  }
  std::fflush(stdout);
}

}  // namespace

int main() {
  const nearmiss_subject& detector = *nearmiss_get_subject(0);
  std::printf("nearmiss 4\nname %s\nversion %s\nabout %s\nkinds vt ee\nbatch 1000\nbound yes\n\n",
              detector.name, detector.version, detector.about);
  std::fflush(stdout);
  std::array<double, 3> request{};
  std::vector<double> x;
  while (read(request.data(), request.size())) {
    x.resize(static_cast<std::size_t>(request[2]) * row);
    if (!read(x.data(), x.size())) return 1;
    answer(detector, request[0], static_cast<int>(request[1]), x);
  }
}

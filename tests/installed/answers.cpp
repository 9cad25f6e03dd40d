// Asks an installed nearmiss through its C++ interface, in several layouts and from several threads. Compares
// the answers with those on standard input. The input has blocks, each with queries of one kind:
//
//     int32 kind, n, timed
//     double x[n][2][4][3], h[n]
//     int8 collides[n], wang[n]; double bound[n]            wang[n] and bound[n] ignore the separation
//     if timed: double lo[n], hi[n] of the earliest times; lo[n], hi[n] of the smallest distances
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <nearmiss/nearmiss.hpp>
#include <new>
#include <random>
#include <thread>
#include <vector>

namespace {

std::atomic<std::size_t> differences = 0;
std::atomic<std::size_t> allocations = 0;

template <class T>
std::vector<T> numbers(std::size_t count) {
  std::vector<T> read(count);
  if (std::fread(read.data(), sizeof(T), count, stdin) == count) return read;
  std::fputs("the input ends within a block\n", stderr);
  std::exit(2);
}

void expect(bool holds, const char* what) {
  if (!holds && ++differences < 10) std::fprintf(stderr, "%s\n", what);
}

template <class T>
void compare(const char* what, std::span<const T> found, std::span<const T> expected) {
  expect(std::memcmp(found.data(), expected.data(), found.size_bytes()) == 0, what);
}
template <class T>
void compare(const char* what, const std::vector<T>& found, const std::vector<T>& expected) {
  compare(what, std::span<const T>(found), std::span<const T>(expected));
}

}  // namespace

[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* const memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t /*size*/) noexcept { std::free(memory); }

namespace {

struct Block {
  nearmiss::Kind kind;
  std::size_t n;
  std::vector<double> x, h;
  std::vector<std::int8_t> collides, wang;
  std::vector<double> bound, times, distances;
};

void ask(const nearmiss::Queries& queries, const Block& block, const char* layout) {
  std::vector<std::int8_t> answers(block.n);
  expect(nearmiss::collides(queries.with_separations(block.h), answers) == nearmiss::Status::ok, "status");
  compare(layout, answers, block.collides);
  expect(nearmiss::wang(queries, answers) == nearmiss::Status::ok, "status of wang");
  compare("wang", answers, block.wang);
}

/// Checks that random queries, none of which needs exact arithmetic, are answered without allocating memory.
void allocates_nothing() {
  using nearmiss::Queries;
  constexpr std::size_t n = 10000;
  std::mt19937 random(1);
  std::vector<double> x(24 * n), h(n);
  for (double& each : x) each = std::ldexp(static_cast<double>(random()), -32);
  std::vector<std::int8_t> answers(n);
  std::vector<std::uint8_t> decided_by(n);
  for (const nearmiss::Kind kind : nearmiss::kinds_of_meshes) {
    const Queries queries = Queries::packed(kind, x);
    const std::size_t before = allocations;
    (void)nearmiss::collides(queries, answers, decided_by);
    (void)nearmiss::collides(queries.with_separations(h), answers);
    (void)nearmiss::wang(queries, answers);
    expect(allocations == before, "memory is allocated");
    expect(std::count(decided_by.begin(), decided_by.end(), NEARMISS_BY_EXACT) == 0,
           "exact arithmetic is needed");
    expect(std::count(answers.begin(), answers.end(), NEARMISS_COLLISION) > 100, "there are few collisions");
  }
}

void ask_in_all_layouts(const Block& block) {
  using nearmiss::Queries;
  const std::size_t n = block.n;
  ask(Queries::packed(block.kind, block.x), block, "packed");

  // Passes the queries as a mesh whose primitives share no vertex. A vertex takes the space of four numbers
  // instead of three, and the vertices are in another order than in the queries.
  std::vector<double> start(16 * n), end(16 * n);
  std::vector<std::int32_t> vertices(4 * n);
  for (std::size_t v = 0; v < 4 * n; ++v) {
    vertices[v] = static_cast<std::int32_t>(4 * n - 1 - v);
    for (std::size_t k = 0; k < 3; ++k) {
      start[4 * (4 * n - 1 - v) + k] = block.x[24 * (v / 4) + 3 * (v % 4) + k];
      end[4 * (4 * n - 1 - v) + k] = block.x[24 * (v / 4) + 12 + 3 * (v % 4) + k];
    }
  }
  Queries mesh = Queries::of_mesh(block.kind, vertices, start.data(), end.data());
  mesh.layout().vertex_stride = 4 * sizeof(double);
  ask(mesh, block, "mesh");

  // Passes the queries as a structure of arrays: [2][4][3][n].
  std::vector<double> turned(24 * n);
  for (std::size_t q = 0; q < n; ++q)
    for (std::size_t c = 0; c < 24; ++c) turned[c * n + q] = block.x[24 * q + c];
  nearmiss_queries layout = Queries::packed(block.kind, block.x).layout();
  const auto row = static_cast<std::ptrdiff_t>(n * sizeof(double));
  layout.start = turned.data();
  layout.end = turned.data() + 12 * n;
  layout.query_stride = sizeof(double);
  layout.coordinate_stride = row;
  layout.vertex_stride = 3 * row;
  ask(Queries(layout), block, "turned");

  // Queries in float have the same answers as queries in double with the same values.
  const std::vector<float> small(block.x.begin(), block.x.end());
  const std::vector<double> rounded(small.begin(), small.end());
  std::vector<std::int8_t> of_float(n), of_double(n);
  expect(nearmiss::collides(Queries::packed(block.kind, small), of_float) ==
             nearmiss::collides(Queries::packed(block.kind, rounded), of_double),
         "status of float");
  compare("float", of_float, of_double);

  if (block.times.empty()) return;
  std::vector<double> lo(n), hi(n), lo_of_times(n), hi_of_times(n);
  const Queries queries = Queries::packed(block.kind, block.x).with_separations(block.h);
  expect(nearmiss::earliest_times(queries, lo_of_times, hi_of_times) == nearmiss::Status::ok,
         "status of times");
  compare("times", std::span<const double>(lo_of_times), std::span(block.times).first(n));
  compare("times from above", std::span<const double>(hi_of_times), std::span(block.times).last(n));
  expect(nearmiss::smallest_distances(queries, lo, hi) == nearmiss::Status::ok, "status of distances");
  compare("distances", std::span<const double>(lo), std::span(block.distances).first(n));
  compare("distances from above", std::span<const double>(hi), std::span(block.distances).last(n));

  const nearmiss::Coordinates x(block.x.data(), 24);
  const nearmiss::Interval first = nearmiss::earliest_time(block.kind, x, block.h[0]);
  expect(first.lo == lo_of_times[0] && first.hi == hi_of_times[0], "times of one");
  expect(static_cast<std::int8_t>(nearmiss::collides(block.kind, x, block.h[0])) == block.collides[0],
         "the answer to one");
  expect(static_cast<std::int8_t>(nearmiss::wang(block.kind, x)) == block.wang[0], "wang of one");
}

}  // namespace

int main() {
  std::int32_t head[3];
  std::size_t asked = 0;
  while (std::fread(head, sizeof head, 1, stdin) == 1) {
    const auto n = static_cast<std::size_t>(head[1]);
    Block block{head[0] == NEARMISS_EDGE_EDGE ? nearmiss::Kind::edge_edge : nearmiss::Kind::vertex_triangle,
                n,
                numbers<double>(24 * n),
                numbers<double>(n),
                numbers<std::int8_t>(n),
                numbers<std::int8_t>(n),
                numbers<double>(n),
                {},
                {}};
    if (head[2] != 0) {
      block.times = numbers<double>(2 * n);
      block.distances = numbers<double>(2 * n);
    }
    asked += n;
    std::thread other(
        [&] { ask(nearmiss::Queries::packed(block.kind, block.x), block, "packed, beside another thread"); });
    ask_in_all_layouts(block);
    other.join();
  }

  allocates_nothing();
  std::vector<std::int8_t> few(1);
  const std::vector<double> two(48);
  expect(nearmiss::collides(nearmiss::Queries::packed(nearmiss::Kind::edge_edge, two), few) ==
             nearmiss::Status::bad_argument,
         "a span that is too short");
  std::printf("C++, nearmiss %s: %zu queries, %zu differences\n", nearmiss_version(), asked,
              differences.load());
  return differences == 0 ? 0 : 1;
}

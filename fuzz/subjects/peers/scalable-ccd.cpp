// Scalable-CCD (Belgrod, Wang, Ferguson, Zhao, Attene, Panozzo and Schneider, "Time of impact dataset for
// continuous collision detection and a scalable conservative algorithm", 2023): Tight-Inclusion for a GPU, in
// one of two versions. `scalable-ccd`, the default, computes in double; `scalable-ccd-float`, built without
// SCALABLE_CCD_USE_DOUBLE, computes in float. Here, its kernels are compiled for the host, and run in one
// thread. On a GPU, they are compiled with --use_fast_math, which may change the last bits, and all domains
// (boxes of parameters) of one level of bisection are tested at the same time. When a kernel tests a domain,
// it compares the limit on iterations with the number of domains that were tested earlier. On a GPU, chance
// decides how many domains of the same level this number includes; here it includes none, so that the limit
// drops as few domains as possible. This adapter does what partial_ipc_ccd_strategy() in
// cuda/ipc_ccd_strategy.cu does. If the CCD finds a time below 1e-6, that function asks again, without a
// separation and without a limit on iterations, and answers with 0.8 of the new time. If the iterations run
// out, the kernel drops the remaining domains; the answer is then "no collision", except if the kernel has
// already found a collision. If the queue exceeds 2^24 domains, this adapter answers "cannot tell"; the
// original enlarges its queue and asks again, until the GPU's memory is full.
// Source: github.com/Continuous-Collision-Detection/Scalable-CCD, 8f9347c. Licence: Apache 2.0.
// Question: contact, or a separation, which the code calls min_distance. The time of impact is a lower bound.
// The options have the values that ipc-toolkit (b40e9c07, ipc.cpp) passes: tolerance=1e-6, iterations=1e7
// (-1: no limit).
// Contract: none.
// $SCALABLE_CCD is the repository, and $CUDA is the folder of CUDA's headers. No GPU is needed.
// $EXCERPT is a folder with two files that you make: root_finder_kernels.cuh is an excerpt of
// cuda/narrow_phase/root_finder.cu, from `namespace scalable_ccd::cuda {` to the end of ccd_kernel(), with
// the namespace closed; this omits only the host's code, which launches the kernels. scalable_ccd/config.hpp
// is empty, and replaces the one that CMake makes. The command for the version in float leaves out
// -DSCALABLE_CCD_USE_DOUBLE, and has -o build/release/peers/scalable-ccd-float.so:
//
//   tools/subject --pkg-config eigen3 fuzz/subjects/peers/scalable-ccd.cpp -- -std=c++20
//       -DSCALABLE_CCD_USE_DOUBLE -I$EXCERPT -I$SCALABLE_CCD/src -I$CUDA/include
#include <cuda_runtime.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>

#include <scalable_ccd/cuda/scalar.cuh>

// Replacements for what CUDA provides on a GPU. Here, the threads of a kernel run one after another.
namespace host {
uint3 thread{0, 0, 0};
constexpr uint3 block{0, 0, 0};
constexpr dim3 one{1, 1, 1};
}  // namespace host
#define threadIdx host::thread
#define blockIdx host::block
#define blockDim host::one
#define gridDim host::one

// NOLINTBEGIN(bugprone-reserved-identifier): CUDA's names
int __float_as_int(float x) { return std::bit_cast<int>(x); }
unsigned __float_as_uint(float x) { return std::bit_cast<unsigned>(x); }
float __int_as_float(int bits) { return std::bit_cast<float>(bits); }
float __uint_as_float(unsigned bits) { return std::bit_cast<float>(bits); }
long long __double_as_longlong(double x) { return std::bit_cast<long long>(x); }
double __longlong_as_double(long long bits) { return std::bit_cast<double>(bits); }
// NOLINTEND(bugprone-reserved-identifier)

/// Replaces *at by change(*at), and returns the old value. Copies bytes, because callers access the bits of a
/// float or double as an integer.
template <class Number, class Change>
Number replaced(Number* at, const Change& change) {
  Number before;
  std::memcpy(&before, at, sizeof before);
  const Number after = change(before);
  std::memcpy(at, &after, sizeof after);
  return before;
}
template <class Number>
Number atomicMin(Number* at, Number value) {
  return replaced(at, [=](Number before) { return std::min(before, value); });
}
template <class Number>
Number atomicMax(Number* at, Number value) {
  return replaced(at, [=](Number before) { return std::max(before, value); });
}
int atomicAdd(int* at, int value) {
  return replaced(at, [=](int before) { return before + value; });
}
int atomicCAS(int* at, int expected, int value) {
  return replaced(at, [=](int before) { return before == expected ? value : before; });
}
unsigned atomicInc(unsigned* at, unsigned last) {
  return replaced(at, [=](unsigned before) { return before >= last ? 0 : before + 1; });
}

template <class A, class B>
auto max(A a, B b) {
  return std::fmax(a, b);
}

#include <scalable_ccd/cuda/narrow_phase/interval.cuh>
// The headers below and the excerpt (root_finder_kernels.cuh) use CUDA's names, and use interval.cuh without
// including it.
#include <scalable_ccd/cuda/narrow_phase/ccd_buffer.cuh>
#include <scalable_ccd/cuda/narrow_phase/ccd_config.cuh>
#include <scalable_ccd/cuda/narrow_phase/ccd_data.cuh>
#include <scalable_ccd/cuda/utils/atomic_min_float.cuh>

#include <root_finder_kernels.cuh>

#include "ccd/nearmiss_functions.hpp"

namespace {

using nearmiss::plugin::Answer;
using nearmiss::plugin::Question;
using scalable_ccd::Scalar;
namespace cuda = scalable_ccd::cuda;

struct Settings {
  double tolerance = 1e-6, iterations = 1e7;
};

constexpr std::array<nearmiss::Option<Settings>, 2> settings{
    {{"tolerance", &Settings::tolerance, 1e-300, 1e300}, {"iterations", &Settings::iterations, -1, 2e9}}};

/// The number of domains that the queue can hold. With a limit of 1e7 iterations, the CCD adds fewer domains
/// than this.
constexpr unsigned capacity = 1U << 24;

/// The memory of the queue: 0.9 GB, of which the system provides only the parts that are used.
cuda::CCDDomain* storage() {
  static const std::unique_ptr<cuda::CCDDomain[]> domains(new cuda::CCDDomain[capacity]);
  return domains.get();
}

/// Calls a kernel in n threads, one after another.
template <class Kernel>
void launch(unsigned n, const Kernel& kernel) {
  for (host::thread.x = 0; host::thread.x < n; ++host::thread.x) kernel();
  host::thread.x = 0;
}

/// Does what ccd() in root_finder.cu does, for one query: lowers `toi`, and returns whether the queue was too
/// small.
template <bool is_vf>
bool overflows(cuda::CCDData data, double iterations, double tolerance, bool allow_zero_toi, Scalar& toi) {
  cuda::CCDBuffer queue;
  queue.m_data = storage();
  queue.m_starting_size = 1;
  queue.m_capacity = capacity;
  queue.m_tail = 1;
  cuda::CONFIG.co_domain_tolerance = static_cast<Scalar>(tolerance);
  cuda::CONFIG.use_ms = data.ms > 0;
  cuda::CONFIG.allow_zero_toi = allow_zero_toi;
  cuda::CONFIG.max_iter = static_cast<int>(iterations);
  launch(1, [&] { cuda::initialize_buffer(&queue); });
  launch(1, [&] { cuda::compute_tolerance<is_vf>(&data, 1); });
  while (queue.starting_size() > 0 && queue.overflow_flag() == 0) {
    const cuda::CCDData before = data;
    launch(queue.starting_size(), [&] {
      cuda::CCDData seen = before;
      cuda::ccd_kernel<is_vf>(&queue, &seen, &toi);
    });
    data.nbr_checks += static_cast<int>(queue.starting_size());
    launch(1, [&] { cuda::shift_queue_start(&queue); });
  }
  return queue.overflow_flag() != 0;
}

/// Does what partial_ipc_ccd_strategy() does, for one query.
template <bool is_vf>
Answer decide(const Settings& set, const Question& q) {
  cuda::CCDData data{q.start(0), q.start(1), q.start(2), q.start(3), q.end(0), q.end(1), q.end(2), q.end(3)};
  data.ms = static_cast<Scalar>(q.separation);
  Scalar toi = 1;
  if (overflows<is_vf>(data, set.iterations, set.tolerance, true, toi)) return {NEARMISS_UNKNOWN, 0};
  if (toi < 1e-6) {
    toi = 1;
    data.ms = 0;
    if (overflows<is_vf>(data, -1, set.tolerance, false, toi)) return {NEARMISS_UNKNOWN, 0};
    toi = static_cast<Scalar>(0.8 * toi);
  }
  return Answer::of(toi < 1, toi);
}

#ifdef SCALABLE_CCD_USE_DOUBLE
constexpr const char* name = "scalable-ccd";
constexpr int bits = 53;
#else
constexpr const char* name = "scalable-ccd-float";
constexpr int bits = 24;
#endif

}  // namespace

NEARMISS_SUBJECT(
    detector(name, "8f9347c",
             "Scalable-CCD, compiled for the host, as ipc-toolkit asks it; options tolerance=1e-6, "
             "iterations=1e7 (-1: no limit; no collision if they run out)")
        .options<settings>()
        .vertex_triangle(decide<true>)
        .edge_edge(decide<false>)
        .set(&nearmiss_subject::bits, bits)
        .set(&nearmiss_subject::time_sort, NEARMISS_TIME_LOWER_BOUND)
        .set(&nearmiss_subject::takes_separation, 1))

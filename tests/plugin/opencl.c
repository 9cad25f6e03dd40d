/* A CCD on any device that has OpenCL, for large batches. It divides the time step into 16 intervals, and
 * looks in each interval for a direction along which the primitives stay apart. The distance of two vertices
 * along a fixed direction is linear in time, so it suffices to look at the ends of the interval. The CCD
 * reports a collision at the start of the first interval that has no such direction. No contact is earlier
 * than this start. Rounding causes no miss. Once the largest coordinate is scaled into [1/2, 1), the error of
 * a distance along d is less than 13 * 2^-24 s, with s = |dx| + |dy| + |dz|, and the CCD requires a distance
 * of 64 * 2^-24 s. (In units of 2^-24 s, the error of each of two points is at most 2.1; their difference
 * adds 2, and three products and two sums add 6.) Numbers below 2^-126, which a device may take for 0, matter
 * far less, since neither d nor the largest coordinate is tiny.
 *
 *     cc -shared -fPIC -I. -o opencl.so tests/plugin/opencl.c -lOpenCL
 *
 * With the option optimise=0, the device compiles the kernel without optimisation. LLVM 18, which pocl uses
 * on Debian 13, ends the process when it optimises the kernel. */
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ccd/nearmiss_subject.h"

#define TEXT(...) #__VA_ARGS__
static const char* const text = TEXT(
    int stay_apart(const float3* from, const float3* to, int split, float3 d) {
      const float size = fabs(d.x) + fabs(d.y) + fabs(d.z);
      float least = INFINITY, most = -INFINITY;
      for (int a = 0; a < split; ++a)
        for (int b = split; b < 4; ++b)
          for (int end = 0; end < 2; ++end) {
            const float3 w = end ? to[b] - to[a] : from[b] - from[a];
            const float s = d.x * w.x + d.y * w.y + d.z * w.z;
            least = fmin(least, s);
            most = fmax(most, s);
          }
      return size > 0x1p-80f && (least > 0x1p-18f * size || most < -0x1p-18f * size);
    }

    kernel void decide(global const float* x, ulong n, int split, global float* time) {
      const ulong i = get_global_id(0);
      if (i >= n) return;
      float largest = 0;
      for (int k = 0; k < 24; ++k) largest = fmax(largest, fabs(x[n * k + i]));
      const int scale = -1 - ilogb(largest);
      float3 ends[8], from[4], to[4];
      for (int v = 0; v < 8; ++v)
        ends[v] = (float3)(ldexp(x[n * (3 * v) + i], scale), ldexp(x[n * (3 * v + 1) + i], scale),
                           ldexp(x[n * (3 * v + 2) + i], scale));
      for (int v = 0; v < 4; ++v) to[v] = ends[v];
      for (int j = 0; j < 16; ++j) {
        const float t = (j + 1) / 16.0f;
        for (int v = 0; v < 4; ++v) {
          from[v] = to[v];
          to[v] = ends[v] * (1 - t) + ends[4 + v] * t;
        }
        const float3 u = split == 1 ? from[2] - from[1] : from[1] - from[0];
        const float3 v = from[3] - from[split == 1 ? 1 : 2];
        const float3 normal = cross(u, v);
        const float3 d[8] = {(float3)(1, 0, 0),    (float3)(0, 1, 0),
                             (float3)(0, 0, 1),    normal,
                             cross(normal, u),     cross(normal, v),
                             cross(normal, v - u), from[2] + from[3] - from[0] - from[split == 1 ? 0 : 1]};
        int apart = largest > 0x1p-90f; /* false if the device may take the coordinates for 0 */
        for (int k = 0; apart && !stay_apart(from, to, split, d[k]); ++k) apart = k < 7;
        if (!apart) {
          time[i] = j / 16.0f;
          return;
        }
      }
      time[i] = -1;
    });

typedef struct {
  cl_context context;
  cl_command_queue queue;
  cl_kernel kernel;
  cl_mem x, time;
  size_t room; /* number of queries that the buffers x and time can hold */
  double seconds;
} device;

static cl_int ask(device* on, int kind, size_t n, const double* x, int* answer, double* toi) {
  cl_int error = CL_SUCCESS;
  if (n > on->room) {
    if (on->room > 0) clReleaseMemObject(on->x), clReleaseMemObject(on->time);
    on->x = clCreateBuffer(on->context, CL_MEM_READ_ONLY | CL_MEM_ALLOC_HOST_PTR, 24 * n * sizeof(float),
                           NULL, &error);
    on->time = clCreateBuffer(on->context, CL_MEM_WRITE_ONLY | CL_MEM_ALLOC_HOST_PTR, n * sizeof(float), NULL,
                              &error);
    on->room = error == CL_SUCCESS ? n : 0;
  }
  float* const in = clEnqueueMapBuffer(on->queue, on->x, CL_TRUE, CL_MAP_WRITE_INVALIDATE_REGION, 0,
                                       24 * n * sizeof(float), 0, NULL, NULL, &error);
  if (in == NULL) return error;
  for (size_t k = 0; k < 24 * n; ++k) in[k] = (float)x[k];
  clEnqueueUnmapMemObject(on->queue, on->x, in, 0, NULL, NULL);
  const cl_ulong count = n;
  const cl_int split = kind == NEARMISS_VERTEX_TRIANGLE ? 1 : 2;
  const size_t local = 64, global = (n + local - 1) / local * local;
  clSetKernelArg(on->kernel, 0, sizeof on->x, &on->x);
  clSetKernelArg(on->kernel, 1, sizeof count, &count);
  clSetKernelArg(on->kernel, 2, sizeof split, &split);
  clSetKernelArg(on->kernel, 3, sizeof on->time, &on->time);
  cl_event done;
  error = clEnqueueNDRangeKernel(on->queue, on->kernel, 1, NULL, &global, &local, 0, NULL, &done);
  if (error != CL_SUCCESS) return error;
  float* const out = clEnqueueMapBuffer(on->queue, on->time, CL_TRUE, CL_MAP_READ, 0, n * sizeof(float), 0,
                                        NULL, NULL, &error);
  for (size_t i = 0; out != NULL && i < n; ++i) {
    answer[i] = out[i] >= 0 ? NEARMISS_COLLISION : NEARMISS_NO_COLLISION;
    toi[i] = out[i];
  }
  if (out != NULL) clEnqueueUnmapMemObject(on->queue, on->time, out, 0, NULL, NULL);
  cl_ulong start = 0, end = 0;
  clGetEventProfilingInfo(done, CL_PROFILING_COMMAND_START, sizeof start, &start, NULL);
  clGetEventProfilingInfo(done, CL_PROFILING_COMMAND_END, sizeof end, &end, NULL);
  clReleaseEvent(done);
  on->seconds = (double)(end - start) * 1e-9;
  return error;
}

static void decide(void* state, int kind, size_t n, const double* x, const double* h, int* answer,
                   double* toi) {
  (void)h;
  const cl_int error = ask(state, kind, n, x, answer, toi);
  for (size_t i = 0; error != CL_SUCCESS && i < n; ++i) answer[i] = error; /* a negative number */
}

static void* open(const char* options, char* message, size_t size) {
  cl_platform_id platform;
  cl_device_id id;
  const int optimises = options[0] == '\0';
  cl_int error = optimises || strcmp(options, "optimise=0") == 0 ? CL_SUCCESS : CL_INVALID_VALUE;
  device* const on = calloc(1, sizeof *on);
  if (error == CL_SUCCESS) error = clGetPlatformIDs(1, &platform, NULL);
  if (error == CL_SUCCESS) error = clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &id, NULL);
  if (error == CL_SUCCESS) on->context = clCreateContext(NULL, 1, &id, NULL, NULL, &error);
  if (error == CL_SUCCESS)
    on->queue = clCreateCommandQueue(on->context, id, CL_QUEUE_PROFILING_ENABLE, &error);
  cl_program program = NULL;
  if (error == CL_SUCCESS)
    program = clCreateProgramWithSource(on->context, 1, (const char**)&text, NULL, &error);
  if (error == CL_SUCCESS)
    error = clBuildProgram(program, 1, &id, optimises ? "" : "-cl-opt-disable", NULL, NULL);
  if (error == CL_SUCCESS) on->kernel = clCreateKernel(program, "decide", &error);
  const double x[24] = {0}; /* the first query makes pocl compile the kernel */
  int answer;
  double toi;
  if (error == CL_SUCCESS) error = ask(on, NEARMISS_EDGE_EDGE, 1, x, &answer, &toi);
  if (error == CL_SUCCESS) return on;
  snprintf(message, size, "found the error %d of OpenCL, expected a device, and no option but optimise=0",
           error);
  return NULL;
}

static double seconds(void* state) { return ((device*)state)->seconds; }

const nearmiss_subject* nearmiss_get_subject(size_t index) {
  static const nearmiss_subject detector = {
      .interface_version = NEARMISS_INTERFACE,
      .name = "opencl",
      .about = "intervals of time and directions that separate, on a device",
      .kinds = NEARMISS_VERTEX_TRIANGLE + NEARMISS_EDGE_EDGE,
      .bits = 24,
      .time_sort = NEARMISS_TIME_LOWER_BOUND,
      .batch = 10000000,
      .open = open,
      .decide = decide,
      .layout = NEARMISS_ARRAYS,
      .seconds_of_kernels = seconds};
  return index == 0 ? &detector : NULL;
}

"""Measures how much time each interface adds to the harness's own call, in ns of processor time per query.

The Python package and the C function are called on the same memory, for a million queries of the uniform
family. All take turns. Prints medians of 15 runs, and their ratios to the harness. Two
measurements are compared with the C function instead: times of impact, which the harness asks one
by one, and float32, which it does not take.
Usage: PYTHONPATH=build/release/python python3 tests/python/speed.py build/release
"""

import ctypes
import pathlib
import statistics
import sys
import time

import numpy as np

import nearmiss

COUNT, RUNS = 10**6, 15

build = pathlib.Path(sys.argv[1])
library = ctypes.CDLL(build / 'oracle/libnearmiss.so')
harness = ctypes.CDLL(build / 'tests/benchmarks/libharness.so')
harness.harness_new.restype = ctypes.c_void_p


class Queries(ctypes.Structure):
    """nearmiss_queries of ccd/query/queries.h"""

    _fields_ = [
        ('kind', ctypes.c_int),
        ('type', ctypes.c_int),
        ('count', ctypes.c_size_t),
        ('start', ctypes.c_void_p),
        ('end', ctypes.c_void_p),
        ('query_stride', ctypes.c_ssize_t),
        ('vertex_stride', ctypes.c_ssize_t),
        ('coordinate_stride', ctypes.c_ssize_t),
        ('vertices', ctypes.c_void_p),
        ('separation', ctypes.c_void_p),
        ('separation_stride', ctypes.c_ssize_t),
    ]


def pointer(array):
    return array.ctypes.data_as(ctypes.c_void_p)


def queries_of(number, array):
    size = array.itemsize
    return Queries(
        number, array.dtype != float, len(array), array.ctypes.data, array.ctypes.data + 12 * size,
        24 * size, 3 * size, size, None, None, 0,
    )  # fmt: skip


def duration(call):
    start = time.process_time()
    call()
    return 1e9 * (time.process_time() - start)


def compare(name, count, reference, **calls):
    """Prints the time of each call, and its ratio to that of the reference."""
    every = [reference, *calls.values()]
    times = [[duration(call) for call in every] for _ in range(RUNS)]
    base, *others = (statistics.median(each) / count for each in zip(*times))
    columns = [f'{each:8.1f} {each / base:6.3f}' for each in others]
    columns = dict(zip(calls, columns))
    print(f'{name:28} {base:9.1f}   {columns.get("c", ""):15}   {columns["python"]}', flush=True)


def measure_answers(kind, number, array):
    asked = queries_of(number, array)

    for name, subject, rest in (('collides', b'exact-decision', [None]), ('wang', b'wang', [])):
        in_c, in_python = getattr(library, f'nearmiss_{name}'), getattr(nearmiss, name)

        def ask_c():
            in_c(ctypes.byref(asked), pointer(np.empty(len(array), np.int8)), *rest)

        def ask_python():
            in_python(kind, array)

        of = f'{name}, {kind}, {array.dtype}'
        if array.dtype != float:
            compare(of, len(array), ask_c, python=ask_python)
            continue
        handle = ctypes.c_void_p(
            harness.harness_new(subject, number, pointer(array), ctypes.c_size_t(len(array)))
        )
        compare(of, len(array), lambda: harness.harness_decide(handle), c=ask_c, python=ask_python)
        harness.harness_delete(handle)


def measure_times(kind, number, array):
    asked = queries_of(number, array)

    def ask_c():
        lo, hi = np.empty(len(array)), np.empty(len(array))
        library.nearmiss_earliest_time(
            ctypes.byref(asked), ctypes.c_double(0), pointer(lo), pointer(hi)
        )

    compare(
        f'earliest_time, {kind}, {array.dtype}', len(array), ask_c,
        python=lambda: nearmiss.earliest_time(kind, array),
    )  # fmt: skip


print(f'{"ns per query":28} reference   C       ratio     Python  ratio')
for kind, number in (('vt', 1), ('ee', 2)):
    x, _ = nearmiss.queries('uniform', kind, COUNT)
    single = x.astype(np.float32)
    measure_answers(kind, number, x)
    measure_answers(kind, number, single)
    measure_times(kind, number, x[: COUNT // 20])  # times take longer than answers

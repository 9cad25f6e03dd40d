"""Measures what the Python package adds to the C function on the same memory: ns of processor time per query of the uniform family,
medians of 15 runs that take turns, and their ratio.
Usage: PYTHONPATH=build/release/python python3 tests/python/speed.py build/release/oracle/libnearmiss.so
"""

import ctypes
import statistics
import sys
import time

import numpy as np

import nearmiss

COUNT, RUNS = 10**6, 15

library = ctypes.CDLL(sys.argv[1])


class Queries(ctypes.Structure):
    """nearmiss_queries of ccd/interface/queries.h"""

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


def duration(call):
    start = time.process_time()
    call()
    return 1e9 * (time.process_time() - start)


def compare(name, by_python, by_c, count):
    times = [(duration(by_python), duration(by_c)) for _ in range(RUNS)]
    python, c = (statistics.median(each) / count for each in zip(*times))
    print(f'{name:32} {python:8.1f} {c:8.1f} {python / c:7.3f}', flush=True)


def measure(kind, number):
    x, _ = nearmiss.queries('uniform', kind, COUNT)
    single = x.astype(np.float32)
    for array, type_number in ((x, 0), (single, 1)):
        size = array.itemsize
        queries = Queries(
            number, type_number, COUNT, array.ctypes.data, array.ctypes.data + 12 * size,
            24 * size, 3 * size, size, None, None, 0,
        )  # fmt: skip
        of = f'{kind}, {array.dtype}'
        asked = ctypes.byref(queries)

        def answers_of(function, *rest):
            answers = np.empty(queries.count, np.int8)
            pointer = answers.ctypes.data_as(ctypes.c_void_p)
            return function(asked, pointer, *rest)

        queries.count = COUNT
        for name, rest in (('collides', [None]), ('wang', [])):
            in_c, in_python = getattr(library, f'nearmiss_{name}'), getattr(nearmiss, name)
            compare(
                f'{name}, {of}', lambda: in_python(kind, array), lambda: answers_of(in_c, *rest), COUNT
            )  # fmt: skip
        few = queries.count = COUNT // 20  # a time takes longer than an answer

        def times():
            lo, hi = np.empty(few), np.empty(few)
            to = (each.ctypes.data_as(ctypes.c_void_p) for each in (lo, hi))
            library.nearmiss_earliest_time(asked, ctypes.c_double(0), *to)

        compare(
            f'earliest_time, {of}', lambda: nearmiss.earliest_time(kind, array[:few]), times, few
        )  # fmt: skip


print(f'{"ns per query":32}   Python        C   ratio')
measure('vt', 1)
measure('ee', 2)

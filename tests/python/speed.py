"""Measures how much time the Python package adds to the C functions, in ns of processor time per query.

Calls a function of the package and the corresponding C function in turn, with the same array of
queries of the family `uniform`. Prints the medians of 15 runs, and their ratios.
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

library = ctypes.CDLL(pathlib.Path(sys.argv[1]) / 'oracle/libnearmiss.so')


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


def compare(name, count, ask_c, ask_python):
    """Prints the times of a call in C and of one in Python, and their ratio."""
    times = [[duration(call) for call in (ask_c, ask_python)] for _ in range(RUNS)]
    in_c, in_python = (statistics.median(each) / count for each in zip(*times))
    print(f'{name:28} {in_c:9.1f} {in_python:9.1f} {in_python / in_c:6.3f}', flush=True)


def measure(name, kind, number, array, *rest, numbers=1, dtype=np.int8):
    """Compares functions that give `numbers` numbers for each query. The C function writes these
    numbers to arrays. `rest` has two lists of its arguments: those before these arrays, and those
    after them."""
    asked = queries_of(number, array)
    before, behind = rest or ([], [])

    def ask_c():
        to = [pointer(np.empty(len(array), dtype)) for _ in range(numbers)]
        getattr(library, f'nearmiss_{name}')(ctypes.byref(asked), *before, *to, *behind)

    of = f'{name}, {kind}, {array.dtype}'
    compare(of, len(array), ask_c, lambda: getattr(nearmiss, name)(kind, array))


print(f'{"ns per query":28} {"C":>9} {"Python":>9}  ratio')
for kind, number in (('vt', 1), ('ee', 2)):
    x, _ = nearmiss.queries('uniform', kind, COUNT)
    for array in (x, x.astype(np.float32)):
        measure('collides', kind, number, array, [], [None])
        measure('wang', kind, number, array)
    few = x[: COUNT // 20]  # a time takes longer than an answer
    measure('earliest_time', kind, number, few, [ctypes.c_double(0)], [], numbers=2, dtype=float)

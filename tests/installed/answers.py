"""Asks an installed nearmiss from Python, and compares its answers with those on standard input.

The input has the format that answers.cpp describes.
"""

import sys

import numpy as np

import nearmiss

KINDS = {1: 'vt', 2: 'ee'}


def read(dtype, *shape):
    count = int(np.prod(shape))
    data = sys.stdin.buffer.read(count * np.dtype(dtype).itemsize)
    return np.frombuffer(data, dtype, count).reshape(shape)


def blocks():
    """Yields kind, x, separation, collides, wang, bound, and times and distances or None."""
    while head := sys.stdin.buffer.read(12):
        kind, n, timed = np.frombuffer(head, np.int32)
        block = [KINDS[kind], read(float, n, 2, 4, 3), read(float, n)]
        block += [read(np.int8, n) == 1, read(np.int8, n) == 1, read(float, n)]
        block += [read(float, 2, n), read(float, 2, n)] if timed else [None, None]
        yield block


asked = differences = 0
for kind, x, separation, collides, wang, bound, times, distances in blocks():
    asked += len(x)
    differences += np.count_nonzero(nearmiss.collides(kind, x, separation) != collides)
    differences += np.count_nonzero(nearmiss.wang(kind, x) != wang)
    differences += np.count_nonzero(nearmiss.wang_bound(kind, x) != bound)
    if times is not None:
        differences += np.count_nonzero(nearmiss.earliest_time(kind, x, separation) != times)
        differences += np.count_nonzero(nearmiss.smallest_distance(kind, x) != distances)
print(f'Python: {asked} queries, {differences} differences')
sys.exit(differences != 0)

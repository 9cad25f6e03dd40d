"""A complete example of a subject that is a program. It reports a query if the axis-aligned boxes
around the moving primitives meet.

    build/release/nearmiss fuzz --subject 'pipe:python3 tests/plugin/example.py' --cases 100000
"""

import sys

import numpy as np

DECIDE, VERTEX_TRIANGLE = 0, 1

queries, answers = sys.stdin.buffer, sys.stdout.buffer
answers.write(b'nearmiss 3\nname boxes-numpy\nkinds vt ee\nbatch 2048\n\n')
answers.flush()
while header := queries.read(24):
    question, kind, n = np.frombuffer(header).astype(int)
    rows = np.frombuffer(queries.read(n * 200)).reshape(n, 25)
    x = rows[:, :24].reshape(n, 2, 4, 3)  # query, time, vertex, coordinate
    split = 1 if kind == VERTEX_TRIANGLE else 2
    a, b = x[:, :, :split], x[:, :, split:]
    apart = (a.max((1, 2)) < b.min((1, 2))) | (b.max((1, 2)) < a.min((1, 2)))
    collides = ~apart.any(1)
    time_of_impact = np.full(n, np.nan)  # not known
    answers.write(np.column_stack([collides, time_of_impact]).tobytes())
    answers.flush()

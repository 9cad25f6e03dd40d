"""A program with type annotations that uses the Python package. types_test.py checks it; nothing runs it."""

import numpy as np
from numpy.typing import NDArray

import nearmiss


def mine(kind: str, x: NDArray[np.float64], separation: NDArray[np.float64]) -> NDArray[np.bool_]:
    return nearmiss.wang('vt' if kind == 'vt' else nearmiss.Kind.EDGE_EDGE, x)


x = np.zeros((5, 2, 4, 3), np.float32)
hits = nearmiss.collides('vt', x, 0.5)
x_of_hits = x[hits]
answers, decided_by = nearmiss.collides('ee', x.tolist(), [0.0] * 5, decided_by=True)
either = nearmiss.collides('ee', x, decided_by=bool(len(hits)))
by_filter: int = (decided_by == nearmiss.DecidedBy.FILTER).sum()
lo, hi = nearmiss.earliest_time('vt', x, width=0.1)
longest: float = (hi - lo).max()
mesh = nearmiss.MeshPairs([[0, 1, 2, 3]], np.zeros((4, 3)), np.ones((4, 3)))
distance = nearmiss.smallest_distance('ee', mesh).lo[0]
proof: str = nearmiss.certificate('vt', x[0], 0.5, prove='time')
hits, toi = nearmiss.time_of_impact('vt', mesh, tmax=0.5)

result = nearmiss.trial([mine, 'wang', nearmiss.Subject(mine, 'again')], 1000, ['uniform'])
missed: int = result.counts('mine', family='uniform').missed
misses = result.findings[result.findings.what == 'false-negative']
shrunk: NDArray[np.float64] = misses.shrunk

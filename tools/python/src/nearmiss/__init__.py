"""Exact continuous collision detection (CCD) for queries in NumPy arrays, and trials of other CCDs.

>>> import nearmiss
>>> x = [[.25, .25, 1], [0, 0, 0], [1, 0, 0], [0, 1, 0], [.25, .25, -1], [0, 0, 0], [1, 0, 0], [0, 1, 0]]
>>> nearmiss.collides('vt', x)
True
>>> nearmiss.earliest_time('vt', x)
Interval(lo=0.5, hi=0.5)

A query is four vertices that move linearly from t = 0 to t = 1: a vertex x0 and a triangle x1 x2 x3 ('vt'), or the edges x0x1 and
x2x3 ('ee'). The question is whether the distance of the two closed primitives is at most the separation at some t in [0, 1].
"""

from nearmiss._functions import (
    DecidedBy,
    Interval,
    collides,
    earliest_time,
    smallest_distance,
    time_of_impact,
    wang,
    wang_bound,
)
from nearmiss._interface import version as __version__
from nearmiss._queries import Kind, MeshPairs
from nearmiss._trials import Counts, Findings, Subject, TrialResult, families, queries, trial

__all__ = [
    'Counts',
    'DecidedBy',
    'Findings',
    'Interval',
    'Kind',
    'MeshPairs',
    'Subject',
    'TrialResult',
    '__version__',
    'collides',
    'earliest_time',
    'families',
    'queries',
    'smallest_distance',
    'time_of_impact',
    'trial',
    'wang',
    'wang_bound',
]

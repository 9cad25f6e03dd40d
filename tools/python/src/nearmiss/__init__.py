"""Exact continuous collision detection (CCD) for queries in NumPy arrays, and trials of other CCDs.

>>> import nearmiss
>>> x = [[.25, .25, 1], [0, 0, 0], [1, 0, 0], [0, 1, 0], [.25, .25, -1], [0, 0, 0], [1, 0, 0], [0, 1, 0]]
>>> nearmiss.collides('vt', x)
True
>>> nearmiss.earliest_time('vt', x)
Interval(lo=0.5, hi=0.5)

A query consists of vertices that move linearly from t = 0 to t = 1 and form two closed primitives. The
question is whether the distance of the primitives is at most the separation at some t in [0, 1]. All
coordinates have the same, arbitrary unit; times are fractions of the step. Every function takes these
arguments:

kind:  'vt' for a vertex x0 and a triangle x1 x2 x3, 'ee' for the edges x0x1 and x2x3, 'vv' for the vertices
       x0 and x1, or 've' for a vertex x0 and an edge x1x2
x:     (n, 2, 4, 3): query, time, vertex, coordinate; or (n, 8, 3): the vertices at t = 0, then at t = 1; or
       MeshPairs. The shapes for 'vv' have 2 and 4 in place of 4 and 8; those for 've' have 3 and 6. An x of
       shape (2, 4, 3) or (8, 3) is one query, and its results are NumPy scalars instead of arrays (n,).
       Functions read float64 and float32 in place, with any strides, and convert integers to float64.

Every function raises a ValueError that names the first query with a coordinate that is not finite, or with a
separation that is negative or not finite. Other Python threads run during a call. trial() puts CCDs on trial,
such as a Python function. To say more about the function, wrap it in a Subject.
"""

from nearmiss import _built  # noqa: F401, before all that needs the compiled modules
from nearmiss._functions import (
    DecidedBy,
    Interval,
    certificate,
    collides,
    earliest_time,
    record,
    smallest_distance,
    time_of_impact,
    wang,
    wang_bound,
)
from nearmiss._finding import Finding
from nearmiss._interface import version as __version__
from nearmiss._queries import Kind, MeshPairs
from nearmiss._trials import Counts, Findings, Subject, TrialResult, families, queries, trial

__all__ = [
    'Counts',
    'DecidedBy',
    'Finding',
    'Findings',
    'Interval',
    'Kind',
    'MeshPairs',
    'Subject',
    'TrialResult',
    '__version__',
    'certificate',
    'collides',
    'earliest_time',
    'families',
    'queries',
    'record',
    'smallest_distance',
    'time_of_impact',
    'trial',
    'wang',
    'wang_bound',
]

"""The functions that take arrays of queries, and record(). __init__.py describes the arrays."""

import atexit
import enum
from typing import Any, Literal, NamedTuple, Union, overload

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from nearmiss import _interface
from nearmiss._queries import (
    _LAYOUTS,
    Asked,
    KindLike,
    MeshPairs,
    asked_of_wang,
    at_most_1,
    is_by_time,
    kind_of,
    not_negative,
)

atexit.register(_interface.end_calls)  # daemon threads may not use Python after this


class DecidedBy(enum.IntEnum):
    """What decided a query."""

    BOXES = 0  # the boxes that the primitives sweep do not meet
    FILTER = 1  # double arithmetic with certified bounds
    EXACT = 2  # exact arithmetic


class Interval(NamedTuple):
    """Two numbers for each query that enclose a time or a distance."""

    lo: NDArray[np.float64]
    hi: NDArray[np.float64]


@overload
def collides(
    kind: KindLike,
    x: Union[ArrayLike, MeshPairs],
    separation: ArrayLike = ...,
    *,
    decided_by: Literal[False] = ...,
) -> NDArray[np.bool_]:
    ...


@overload
def collides(
    kind: KindLike,
    x: Union[ArrayLike, MeshPairs],
    separation: ArrayLike = ...,
    *,
    decided_by: Literal[True],
) -> tuple[NDArray[np.bool_], NDArray[np.uint8]]:
    ...


@overload
def collides(
    kind: KindLike,
    x: Union[ArrayLike, MeshPairs],
    separation: ArrayLike = ...,
    *,
    decided_by: bool,
) -> Union[NDArray[np.bool_], tuple[NDArray[np.bool_], NDArray[np.uint8]]]:
    ...


def collides(
    kind: KindLike,
    x: Union[ArrayLike, MeshPairs],
    separation: ArrayLike = 0.0,
    *,
    decided_by: bool = False,
) -> Any:
    """Whether the primitives come within the separation at some t in [0, 1].

    A separation of 0 asks whether the primitives touch. The answer is that of exact arithmetic, even for
    degenerate, huge and subnormal queries. If the smallest distance is exactly the separation, the answer is
    yes.

    kind, x:    the queries, as help(nearmiss) describes them
    separation: a number for all queries, or (n,), in the unit of the coordinates
    decided_by: if true, returns a pair: the answers, and what decided each query, as values of DecidedBy
    """
    asked = Asked(kind, x, separation)
    answers, deciders = _interface.collides(asked.queries)
    hits = asked.are_collisions(answers)
    return (hits, asked.answers(deciders)) if decided_by else hits


def earliest_time(
    kind: KindLike,
    x: Union[ArrayLike, MeshPairs],
    separation: ArrayLike = 0.0,
    *,
    width: float = 0.0,
) -> Interval:
    """Encloses the earliest time t* at which the distance is at most the separation: lo <= t* <= hi.

    By default, lo and hi are equal if t* is a double, and neighbouring doubles if it is not. With `width`,
    hi - lo may be as large as `width`. lo is a safe time of impact: the distance exceeds the separation at
    all earlier times. lo and hi are infinite if there is no collision.

    kind, x, separation: as for collides()
    """
    width = not_negative('width', width)
    asked = Asked(kind, x, separation)
    return Interval(*map(asked.answers, _interface.earliest_time(asked.queries, width)))


def time_of_impact(
    kind: KindLike,
    x: Union[ArrayLike, MeshPairs],
    separation: ArrayLike = 0.0,
    tmax: float = 1.0,
) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
    """Whether each query is a collision at some t in [0, tmax], and its time of impact.

    The time is the largest double that is not after t* (earliest_time()), so the distance exceeds the
    separation at all earlier times. The time is infinite if there is no collision.

    kind, x, separation: as for collides()
    tmax:                the queries are about t in [0, tmax]; at most 1
    """
    tmax = at_most_1('tmax', tmax)
    asked = Asked(kind, x, separation)
    answers, times = _interface.time_of_impact(asked.queries, tmax)
    return asked.are_collisions(answers), asked.answers(times)


def smallest_distance(
    kind: KindLike, x: Union[ArrayLike, MeshPairs], *, relative_width: float = 1e-3
) -> Interval:
    """Encloses the smallest distance d over the step, in the unit of the coordinates: lo <= d <= hi.

    hi - lo is at most relative_width * hi, or as small as doubles allow. lo and hi are 0 if the primitives
    touch.

    kind, x: as for collides()
    """
    relative_width = not_negative('relative_width', relative_width)
    asked = Asked(kind, x)
    return Interval(
        *map(asked.answers, _interface.smallest_distance(asked.queries, relative_width))
    )


_PROOFS = ('decision', 'time', 'distance')  # the index of a name is its number in the C interface


def certificate(
    kind: KindLike,
    x: Union[ArrayLike, MeshPairs],
    separation: ArrayLike = 0.0,
    *,
    prove: Literal['decision', 'time', 'distance'] = 'decision',
) -> Any:
    """A proof of the answer to each query. A short program checks the proof, in exact fractions.

    For one query, returns the proof as a string; for several, returns an array (n,) of strings. A string has
    one or two lines of JSON. check() of tools/certificates/check.py, in the sources, reads a line and
    returns the statement that it proves; compare the statement with what you asked. On average, a
    certificate takes a millisecond and has a thousand characters.

    A certificate contains only the statements that can be proved. A statement has no proof only if
    the distance reaches the separation at an irrational time, and exceeds the separation again
    right after this time. If no statement is left, returns None in place of a string.

    kind, x, separation: as for collides()
    prove: 'decision': the answer of collides();
           'time': that the distance exceeds the separation before `lo` of earliest_time(), and is at most the
           separation at some time from `lo` to `hi`;
           'distance': bounds of the smallest distance, as smallest_distance() gives them; they ignore
           `separation`
    """
    try:
        what = _PROOFS.index(prove)
    except ValueError:
        raise ValueError(
            f"prove is {prove!r}, expected 'decision', 'time' or 'distance'"
        ) from None
    asked = Asked(kind, x, separation)
    return asked.answers(np.array(_interface.certificates(asked.queries, what), object))


def wang(
    kind: KindLike, x: Union[ArrayLike, MeshPairs], separation: ArrayLike = 0.0
) -> NDArray[np.bool_]:
    """Whether the failure-proof CCD of Wang (2014) reports each query as a collision.

    This CCD reports every collision. It may also report a query that is no collision, but only if
    the distance of the primitives falls to at most wang_bound() plus the separation.

    kind, x, separation: as for collides(); only 'vv' and 've' take a separation
    """
    asked = asked_of_wang(kind, x, separation)
    answers: NDArray[np.bool_] = asked.are_collisions(_interface.wang(asked.queries))
    return answers


def wang_bound(
    kind: KindLike, x: Union[ArrayLike, MeshPairs], separation: ArrayLike = 0.0
) -> NDArray[np.float64]:
    """The largest amount by which the distance of a false positive of wang() may exceed the
    separation, in the unit of the coordinates.

    Without a separation, this bound is about 41 B ε^¼, where B is the size of the pair and ε the machine
    epsilon of double.

    kind, x, separation: as for wang()
    """
    asked = asked_of_wang(kind, x, separation)
    bounds: NDArray[np.float64] = asked.answers(_interface.wang_bound(asked.queries))
    return bounds


def record(
    kind: KindLike,
    x: ArrayLike,
    answers: ArrayLike,
    times: ArrayLike = np.nan,
    separation: ArrayLike = 0.0,
    tmax: ArrayLike = 1.0,
    *,
    keep: bool = False,
) -> None:
    """Records queries and answers in the file that the environment variable NEARMISS_RECORD names, as
    nearmiss_record.h does in C. Does nothing if the variable is not set. `nearmiss replay FILE
    --as-answered` judges the answers.

    x:       the queries, (n, 2, v, 3) or (n, 2 v, 3), with v = 4, or 2 for 'vv' and 3 for 've'; without n for one query
    answers: what the CCD answered: bools, or 0 for no, 1 for yes and 2 for "cannot tell"
    times:   the times that the CCD gave, NaN where it gave none
    tmax:    the CCD was asked about t in [0, tmax]
    keep:    whether to keep these records longer, as for slow queries
    answers, times, separation and tmax: a number for all queries, or (n,). Other shapes raise a ValueError.
    """
    number, vertices = _LAYOUTS[kind_of(kind)]
    rows = np.ascontiguousarray(x, np.float64)
    is_by_time(rows.shape, vertices)
    rows = rows.reshape(-1, 6 * vertices)

    def each(values: ArrayLike, dtype: DTypeLike) -> NDArray[Any]:
        return np.ascontiguousarray(np.broadcast_to(np.asarray(values, dtype), (len(rows),)))

    given = each(separation, np.float64), each(tmax, np.float64), each(answers, np.int32)
    _interface.record(number, rows, *given, each(times, np.float64), keep)

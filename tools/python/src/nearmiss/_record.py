"""Records what a simulation in Python asks its CCD."""

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray
from typing import Any

from nearmiss import _interface
from nearmiss._queries import _LAYOUTS, KindLike, is_by_time, kind_of


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
    nearmiss_record.h does in C; without the variable, does nothing. `nearmiss replay FILE --as-answered` judges
    them.

    x:       the queries, (n, 2, v, 3) or (n, 2 v, 3), with v = 4, or 2 for 'vv' and 3 for 've'; without n for one query
    answers: what the CCD answered: bools, or 0, 1 and 2 for "cannot tell"
    times:   the times that the CCD gave, NaN where it gave none
    tmax:    the CCD was asked about t in [0, tmax]
    keep:    whether to keep these records longer, as for slow queries
    All but x are a number for all queries, or (n,). Other shapes raise a ValueError.
    """
    number, vertices = _LAYOUTS[kind_of(kind)]
    rows = np.ascontiguousarray(x, np.float64)
    is_by_time(rows.shape, vertices)
    rows = rows.reshape(-1, 6 * vertices)

    def each(values: ArrayLike, dtype: DTypeLike) -> NDArray[Any]:
        return np.ascontiguousarray(np.broadcast_to(np.asarray(values, dtype), (len(rows),)))

    given = each(separation, np.float64), each(tmax, np.float64), each(answers, np.int32)
    _interface.record(number, rows, *given, each(times, np.float64), keep)

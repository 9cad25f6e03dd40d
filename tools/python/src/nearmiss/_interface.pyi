from typing import Optional

import numpy as np
from numpy.typing import NDArray

from nearmiss._queries import Coordinates

version: str

class PlainArithmetic:
    def __enter__(self) -> None: ...
    def __exit__(self, *why: object) -> None: ...

class Queries:
    def __init__(
        self,
        kind: int,
        start: Coordinates,
        end: Coordinates,
        pairs: Optional[NDArray[np.int32]],
        separation: NDArray[np.float64],
    ) -> None: ...

def collides(queries: Queries) -> tuple[NDArray[np.int8], NDArray[np.uint8]]: ...
def earliest_time(
    queries: Queries, width: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
def time_of_impact(
    queries: Queries, tmax: float
) -> tuple[NDArray[np.int8], NDArray[np.float64]]: ...
def smallest_distance(
    queries: Queries, relative_width: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
def certificates(queries: Queries, what: int) -> list[Optional[str]]: ...
def wang(queries: Queries) -> NDArray[np.int8]: ...
def wang_bound(queries: Queries) -> NDArray[np.float64]: ...
def end_calls() -> None: ...
def record(
    kind: int,
    x: NDArray[np.float64],
    separation: NDArray[np.float64],
    tmax: NDArray[np.float64],
    answer: NDArray[np.int32],
    toi: NDArray[np.float64],
    keep: bool,
) -> None: ...

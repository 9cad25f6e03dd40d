from typing import Any, Callable, Optional, Sequence, Union

import numpy as np
from numpy.typing import NDArray

from nearmiss._trials import Subject

class Error(ValueError): ...

def hold(
    subjects: Sequence[Union[Subject, str]],
    families: Sequence[str],
    cases: int,
    seed: int,
    shrunk_of_each: int,
    progress: Optional[Callable[[int, int], None]],
) -> tuple[list[tuple[Any, ...]], dict[str, Any]]: ...
def end_calls() -> None: ...
def explanation(kind: str, x: NDArray[np.float64], separation: float) -> str: ...
def families() -> list[tuple[str, str]]: ...
def queries(
    family: str, kind: str, count: int, seed: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...

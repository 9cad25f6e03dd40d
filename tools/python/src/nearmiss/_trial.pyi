from typing import Any, Sequence, Union

import numpy as np
from numpy.typing import NDArray

from nearmiss._trials import Subject

class Error(ValueError): ...

def hold(
    subjects: Sequence[Union[Subject, str]],
    families: Sequence[str],
    cases: int,
    seed: int,
    shrunk_of_each_signature: int,
) -> tuple[list[tuple[Any, ...]], dict[str, Any]]: ...
def end_calls() -> None: ...
def explanation(kind: str, x: NDArray[np.float64], separation: float) -> str: ...
def families() -> list[tuple[str, str, bool]]: ...
def queries(
    family: str, kind: str, count: int, seed: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...

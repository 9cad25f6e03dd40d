"""Checks queries in arrays, and describes them for the C interface.

Copies coordinates only if the C interface cannot read them in place.
"""

import enum
import numbers
from dataclasses import dataclass
from typing import Any, Callable, Literal, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from nearmiss import _interface

Coordinates = Union[NDArray[np.float64], NDArray[np.float32]]


class Kind(str, enum.Enum):
    """The kind of a query, by its primitives."""

    VERTEX_TRIANGLE = 'vt'  # a vertex x0 and a triangle x1 x2 x3
    EDGE_EDGE = 'ee'  # the edges x0x1 and x2x3
    VERTEX_VERTEX = 'vv'  # the vertices x0 and x1
    VERTEX_EDGE = 've'  # a vertex x0 and an edge x1x2


KindLike = Union[Kind, Literal['vt', 'ee', 'vv', 've']]


class _Layout(NamedTuple):
    number: int  # number of the kind in the C interface
    vertices: int  # number of vertices of a query


_LAYOUTS = {
    Kind.VERTEX_TRIANGLE: _Layout(1, 4),
    Kind.EDGE_EDGE: _Layout(2, 4),
    Kind.VERTEX_VERTEX: _Layout(4, 2),
    Kind.VERTEX_EDGE: _Layout(8, 3),
}


@dataclass(frozen=True)
class MeshPairs:
    """Pairs of a moving mesh, as queries.

    pairs: (n, 4) integers, the numbers of the vertices x0 x1 x2 x3 of each pair; (n, 2) for 'vv', (n, 3) for 've'
    start: (v, 3) coordinates of all vertices at t = 0
    end:   (v, 3) coordinates of all vertices at t = 1
    """

    pairs: ArrayLike
    start: ArrayLike
    end: ArrayLike


def kind_of(kind: KindLike) -> Kind:
    """Returns the kind that a text names. Raises a ValueError for any other text."""
    try:
        return Kind(kind)
    except ValueError:
        raise ValueError(f"kind is {kind!r}, expected 'vt', 'ee', 'vv' or 've'") from None


def is_by_time(shape: tuple[int, ...], v: int) -> bool:
    """Whether an array of queries with v vertices has an axis for the two times. Raises a ValueError for a
    shape that no such array has."""
    by_time = shape[-3:] == (2, v, 3)
    is_known = by_time or shape[-2:] == (2 * v, 3)
    if not is_known or len(shape) not in (2 + by_time, 3 + by_time):
        raise ValueError(
            f'x has shape {shape}, expected (n, 2, {v}, 3) or (n, {2 * v}, 3), or (2, {v}, 3) or ({2 * v}, 3) '
            'for one query'
        )
    return by_time


class Asked:
    """Queries in the layout of the C interface, and the shape of their answers."""

    def __init__(
        self, kind: KindLike, x: Union[ArrayLike, MeshPairs], separation: ArrayLike = 0.0
    ) -> None:
        self.is_single = False
        with _interface.PlainArithmetic():  # NumPy converts numbers
            self.queries = self._read(_LAYOUTS[kind_of(kind)], x, separation)

    def _read(
        self, layout: _Layout, x: Union[ArrayLike, MeshPairs], separation: ArrayLike
    ) -> _interface.Queries:
        pairs: Optional[NDArray[np.int32]] = None
        if isinstance(x, MeshPairs):
            start, end = _vertices(x.start, 'start'), _vertices(x.end, 'end')
            if start.shape != end.shape:
                raise ValueError(f'start has shape {start.shape}, but end has shape {end.shape}')
            pairs = _checked_pairs(x.pairs, layout.vertices, len(start))
            count = len(pairs)
        else:
            start, end = self._halves(_numbers(x, 'x'), layout.vertices)
            count = len(start)
        return _interface.Queries(
            layout.number,
            *_alike(start, end),
            pairs,
            _separations(separation, count, self.is_single),
        )

    def _halves(self, x: Coordinates, v: int) -> tuple[Coordinates, Coordinates]:
        """The vertices at t = 0 and t = 1, both (n, v, 3)."""
        by_time = is_by_time(x.shape, v)
        self.is_single = x.ndim == 2 + by_time
        each: Any = x[np.newaxis] if self.is_single else x
        return (each[:, 0], each[:, 1]) if by_time else (each[:, :v], each[:, v:])

    def answers(self, array: NDArray[Any]) -> Any:
        """The answers to the queries; for a single query, a NumPy scalar."""
        return array[0] if self.is_single else array

    def are_collisions(self, answers: NDArray[np.int8]) -> Any:
        """The answers to the queries as bools. `answers` must be 0 or 1."""
        return self.answers(answers.view(np.bool_))


def asked_of_wang(kind: KindLike, x: Union[ArrayLike, MeshPairs], separation: ArrayLike) -> Asked:
    """Returns the queries. Raises a ValueError if wang() cannot answer them."""
    if _LAYOUTS[kind_of(kind)].vertices == 4 and np.any(separation):
        raise ValueError(f"separation is not 0, expected 0 for the kind '{kind_of(kind).value}'")
    return Asked(kind, x, separation)


def not_negative(name: str, value: Any) -> float:
    """Returns the value of an option as a nonnegative double. Raises a TypeError or ValueError
    with the option's name for any other value."""
    return _option(name, value, 'a double that is not negative', lambda number: number >= 0)


def at_most_1(name: str, value: Any) -> float:
    """Returns the value of an option as a double that is at most 1. Raises a TypeError or
    ValueError with the option's name for any other value."""
    return _option(name, value, 'a double that is at most 1', lambda number: number <= 1)


def _option(name: str, value: Any, expected: str, is_one: Callable[[float], bool]) -> float:
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value[()]
    with _interface.PlainArithmetic():
        refused = f'{name} is {value!r}, expected {expected}'
        if not isinstance(value, numbers.Real):
            raise TypeError(refused)
        try:
            number = float(value)
        except OverflowError:
            raise ValueError(refused) from None
        if not is_one(number) or number != value:
            raise ValueError(refused)
        return number


def _numbers(values: ArrayLike, name: str) -> Coordinates:
    """The values as an aligned float64 or float32 array. Values that need rounding raise an exception."""
    array = np.asarray(values)
    if array.dtype not in (np.float64, np.float32):
        if array.dtype.kind not in 'iuf' or array.dtype.itemsize > 8:
            raise TypeError(
                f'{name} has the type {array.dtype}, expected float64, float32 or integers'
            )
        array = array.astype(np.float64)
    _expect_doubles(values, name)
    return np.require(array, requirements='A')


def _expect_doubles(values: Any, name: str) -> None:
    """Refuses integers that doubles may not represent, even if NumPy has already rounded them."""
    _expect_no_mask(values, name)
    is_exact = True
    if isinstance(values, numbers.Integral):
        is_exact = abs(int(values)) <= 2**53
    elif isinstance(values, numbers.Real):
        return
    elif hasattr(values, '__array__') or isinstance(values, memoryview):
        array = np.asarray(values)  # as a whole
        is_exact = array.dtype.kind not in 'iu' or array.size == 0 or _are_doubles(array)
    elif hasattr(values, '__len__') and hasattr(values, '__getitem__'):
        for each in values:
            _expect_doubles(each, name)
    if not is_exact:
        raise ValueError(f'{name} has an integer beyond 2^53, which may be no double')


def _are_doubles(integers: NDArray[Any]) -> bool:
    return -(2**53) <= int(integers.min()) and int(integers.max()) <= 2**53


def _expect_no_mask(values: Any, name: str) -> None:
    if isinstance(values, np.ma.MaskedArray) and np.any(values.mask):
        raise ValueError(f'{name} has masked elements, expected none')


def _vertices(values: ArrayLike, name: str) -> Coordinates:
    array = _numbers(values, name)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f'{name} has shape {array.shape}, expected (v, 3)')
    return array


def _checked_pairs(values: ArrayLike, vertices_of_pair: int, vertices: int) -> NDArray[np.int32]:
    """Returns a checked copy of the pairs. No other thread can change the numbers in this copy."""
    _expect_no_mask(values, 'pairs')
    pairs = np.array(values)
    if pairs.ndim != 2 or pairs.shape[1] != vertices_of_pair:
        raise ValueError(f'pairs has shape {pairs.shape}, expected (n, {vertices_of_pair})')
    if pairs.dtype.kind not in 'iu':
        raise TypeError(f'pairs has the type {pairs.dtype}, expected integers')
    known = min(vertices, 2**31)
    outside = (pairs < 0) | (pairs >= known)
    if outside.any():
        pair, i = np.argwhere(outside)[0]
        raise ValueError(
            f'pair {pair} has the vertex {pairs[pair, i]}, expected a number from 0 to {known - 1}'
        )
    return np.ascontiguousarray(pairs, np.int32)


def _alike(start: Coordinates, end: Coordinates) -> tuple[Coordinates, Coordinates]:
    """`start` and `end`, converted if necessary so that both have the same type and the same strides."""
    if start.dtype != end.dtype:
        start, end = start.astype(np.float64), end.astype(np.float64)
    if start.strides != end.strides:
        start, end = start.copy(order='C'), end.copy(order='C')
    return start, end


def _separations(values: ArrayLike, count: int, is_single: bool) -> NDArray[np.float64]:
    array = np.require(_numbers(values, 'separation'), np.float64, 'A')
    if array.shape != () and (is_single or array.shape != (count,)):
        wanted = 'a number' if is_single else f'a number or ({count},)'
        raise ValueError(f'separation has shape {array.shape}, expected {wanted}')
    return array

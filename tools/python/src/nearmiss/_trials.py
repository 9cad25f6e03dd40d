"""Puts Python functions on trial: asks them hard random queries, and compares the answers with exact ones."""

import atexit
import dataclasses
import functools
import importlib
import operator
from dataclasses import dataclass
from typing import (
    Any,
    Callable,
    Iterable,
    Iterator,
    Literal,
    Optional,
    Sequence,
    Union,
    overload,
)

import numpy as np
from numpy.typing import NDArray

from nearmiss._finding import Finding, finding_of
from nearmiss._progress import Progress
from nearmiss._queries import KindLike, _expect_no_mask, kind_of

_TIME_SORTS = ('none', 'estimate', 'lower-bound', 'free-step')

CCD = Callable[[str, NDArray[np.float64], NDArray[np.float64]], Any]


@dataclass(frozen=True)
class Subject:
    """A CCD on trial.

    function: function(kind, x, separation) returns bools (n,): whether each query is a collision. kind is
              'vt', 'ee', 'vv' or 've'; x is (n, 2, v, 3), where v is 4, or 2 for 'vv' and 3 for 've';
              separation is (n,). The function must answer a query in the same way whenever it is asked.
    name:     the subject's name in results; by default, the name of the function
    time:     unless it is 'none', the function returns (bools, times), with a time in [0, 1] for each
              collision. 'estimate': the times are near the earliest times; 'lower-bound': the times are
              never after the earliest times; 'free-step': in addition, there is no contact if the step
              is shortened to the time, with the vertices' new end positions rounded to doubles
    kinds:    the kinds of queries that the subject is asked
    takes_separation: whether the subject is asked queries with a separation h > 0
    """

    function: CCD
    name: str = ''
    time: Literal['none', 'estimate', 'lower-bound', 'free-step'] = 'none'
    kinds: Union[KindLike, Sequence[KindLike]] = ('vt', 'ee')
    takes_separation: bool = False

    def __post_init__(self) -> None:
        if not callable(self.function):
            raise TypeError(f'function is {self.function!r}, expected a function')
        if self.time not in _TIME_SORTS:
            raise ValueError(f'time is {self.time!r}, expected one of {", ".join(_TIME_SORTS)}')
        kinds = _several('kinds', self.kinds, "some of 'vt', 'ee', 'vv' and 've'")
        object.__setattr__(self, 'kinds', tuple(kind_of(kind).value for kind in kinds))
        if not self.kinds:
            raise ValueError("kinds is (), expected some of 'vt', 'ee', 'vv' and 've'")
        if not isinstance(self.takes_separation, (bool, np.bool_)):
            raise TypeError(f'takes_separation is {self.takes_separation!r}, expected a bool')
        if not self.name:
            own = getattr(self.function, '__name__', None)
            object.__setattr__(self, 'name', own if isinstance(own, str) else 'function')
        if not isinstance(self.name, str):
            raise TypeError(f'name is {self.name!r}, expected a string')

    def _number_of_time_sort(self) -> int:
        return _TIME_SORTS.index(self.time)

    def _decide(
        self, kind: str, x: NDArray[np.float64], separation: NDArray[np.float64]
    ) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
        """The function's answers and times. Raises an exception if the function returns a wrong form."""
        shape = (len(x),)  # the function may change x
        answer = self.function(kind, x, separation)
        times: NDArray[Any] = np.full(shape, np.nan)
        if self.time != 'none':
            if not isinstance(answer, tuple) or len(answer) != 2:
                raise TypeError(
                    f'{self.name} returned a {type(answer).__name__}, expected (bools, times)'
                )
            _expect_no_mask(answer[1], f'the times of {self.name}')
            answer, times = answer[0], np.asarray(answer[1])
            if times.dtype.kind not in 'fiu' or times.dtype.itemsize > 8:
                raise TypeError(
                    f'{self.name} returned times of type {times.dtype}, expected float64'
                )
        _expect_no_mask(answer, f'the answer of {self.name}')
        hits = np.asarray(answer)
        if hits.dtype != np.bool_:
            raise TypeError(f'{self.name} returned answers of type {hits.dtype}, expected bool')
        for array, what in ((hits, 'answers'), (times, 'times')):
            if array.shape != shape:
                raise ValueError(
                    f'{self.name} returned {what} of shape {array.shape}, expected {shape}'
                )
        # An array of bools that is a view of other data may have bytes other than 0 and 1.
        return hits.view(np.uint8) != 0, np.asarray(times, np.float64)


@dataclass(frozen=True)
class Counts:
    """Counters of a subject's answers."""

    queries: int = 0  # queries of the subject's kinds, including those beyond its contract
    collisions: int = 0  # true collisions among the queries that it answered
    missed: int = 0  # collisions that it did not report
    false_positives: int = 0  # queries that it reported and that are no collisions
    late: int = 0  # times after the earliest time, although the subject promised lower bounds
    committed: int = 0  # times that are not late, but the step to them has contact after rounding
    no_answer: int = 0  # queries without an answer, such as a collision without a time
    beyond_contract: int = 0  # queries that it was not asked, because its contract excludes them
    farthest: float = 0.0  # largest ratio of a false positive's distance to its bound or wang's

    def __add__(self, other: 'Counts') -> 'Counts':
        sums = {name: value + vars(other)[name] for name, value in vars(self).items()}
        sums['farthest'] = max(self.farthest, other.farthest)
        return Counts(**sums)


@dataclass(frozen=True)
class Findings:
    """Queries on which subjects fail, with an array for each property. findings[mask] has some of the
    queries, and findings[i] is one query, a Finding. `for finding in findings` gives each query as a
    Finding.

    x, separation:             the queries: (m, 2, 4, 3) and (m,); 'vv' and 've' repeat their last vertex
    shrunk, shrunk_separation: where is_shrunk is true, the simplest queries that fail in the same way;
                               elsewhere the queries themselves
    kind:                      'vt', 'ee', 'vv' or 've'
    what:                      'false-negative', 'late', 'fault' or 'refuted-bound' of a subject; or
                               'oracle-disagreement'
    class_:                    'ordinary', 'degenerate' or 'extreme'
    subject, family:           names
    signature:                 what findings that fail in the same way have in common, such as the features
                               of the first contact
    provenance:                family:seed:index
    """

    x: NDArray[np.float64]
    separation: NDArray[np.float64]
    shrunk: NDArray[np.float64]
    shrunk_separation: NDArray[np.float64]
    is_shrunk: NDArray[np.bool_]
    kind: NDArray[np.str_]
    what: NDArray[np.str_]
    class_: NDArray[np.str_]
    subject: NDArray[np.str_]
    family: NDArray[np.str_]
    signature: NDArray[np.str_]
    provenance: NDArray[np.str_]

    def __len__(self) -> int:
        return len(self.x)

    @overload
    def __getitem__(self, which: Union[int, np.integer[Any]]) -> Finding:
        ...

    @overload
    def __getitem__(self, which: Union[slice, NDArray[Any]]) -> 'Findings':
        ...

    def __getitem__(self, which: Any) -> Union[Finding, 'Findings']:
        if isinstance(which, slice) or np.ndim(which) == 1:
            return Findings(**{name: array[which] for name, array in vars(self).items()})
        try:
            number = operator.index(which)
        except TypeError:
            raise TypeError(
                f'found {which!r}, expected a number, a mask, a slice or an array of numbers'
            ) from None
        of_one = {name: array[number] for name, array in vars(self).items()}
        return finding_of(of_one, _extension().explanation)

    def __iter__(self) -> Iterator[Finding]:
        return (self[i] for i in range(len(self)))

    def to_dataframe(self) -> Any:
        """A row for each finding, without the coordinates, as a DataFrame of pandas."""
        flat = {name: array for name, array in vars(self).items() if array.ndim == 1}
        return importlib.import_module('pandas').DataFrame(flat)

    def __repr__(self) -> str:
        return f'<{len(self)} findings>'


@dataclass(frozen=True)
class TrialResult:
    """The result of a trial: counters by subject, kind and family, and the queries on which subjects fail."""

    rows: Sequence[tuple[str, str, str, Counts]]  # subject, kind, family, counters
    findings: Findings

    def counts(
        self, subject: str, *, kind: Optional[KindLike] = None, family: Optional[str] = None
    ) -> Counts:
        """The counters of a subject, summed over all kinds and families, or only over those given."""
        if subject not in self.subjects:
            known = ', '.join(self.subjects)
            raise ValueError(f'found the subject {subject!r}, expected one of {known}')
        if family is not None and family not in self.families:
            known = ', '.join(self.families)
            raise ValueError(f'found the family {family!r}, expected one of {known}')
        chosen = None if kind is None else kind_of(kind).value
        parts = (
            counts
            for name, of_kind, of_family, counts in self.rows
            if name == subject and chosen in (None, of_kind) and family in (None, of_family)
        )
        return sum(parts, Counts())

    @property
    def subjects(self) -> list[str]:
        return list(dict.fromkeys(row[0] for row in self.rows))

    @property
    def families(self) -> list[str]:
        return list(dict.fromkeys(row[2] for row in self.rows))

    def __repr__(self) -> str:
        """A table with a line for each subject."""
        names = [field.name for field in dataclasses.fields(Counts)]
        width = max(map(len, ['subject', *self.subjects]))
        lines = ['  '.join([f'{"subject":{width}}', *(name.replace('_', ' ') for name in names)])]
        for subject in self.subjects:
            counts = dataclasses.astuple(self.counts(subject))
            cells = (
                f'{value:>{len(name)},.4g}'
                if isinstance(value, float)
                else f'{value:>{len(name)},}'
                for name, value in zip(names, counts)
            )
            lines.append('  '.join([f'{subject:{width}}', *cells]))
        return '\n'.join(lines)


def trial(
    subjects: Union[Subject, CCD, str, Iterable[Union[Subject, CCD, str]]],
    cases: int = 10000,
    families: Union[str, Sequence[str], None] = None,
    seed: int = 1,
    *,
    shrunk: int = 1,
    progress: Optional[bool] = None,
) -> TrialResult:
    """Asks subjects hard random queries, and compares their answers with the exact ones.

    subjects: one or several of these: a Subject; a function like that of a Subject; the name of a CCD or the
              path of a plug-in, as for `nearmiss fuzz` ('wang', 'fcl', './mine.so'). Plug-ins and published
              CCDs run in processes of their own, for which they need the program nearmiss of the same version
    cases:    total number of queries, divided among the families
    families: names, such as 'uniform', 'aspect@8' or 'uniform~0.1'; families() lists the names. By default,
              all families that ask for contact, and the families of vv and ve queries, which have
              random separations; if some subjects are functions, only families that have queries of a
              kind that a function decides
    seed:     seed of the random queries; `nearmiss fuzz` asks the same queries with the same families, cases
              and seed
    shrunk:   how many findings of each signature and class are shrunk; shrinking one finding may ask a
              subject thousands of queries
    progress: whether a line on stderr shows the progress; by default, only in a terminal or a notebook

    An exception that a function raises ends the trial, and is passed on.
    """
    chosen = _subjects_of(subjects)
    cases, seed, shrunk = (
        _count(name, value)
        for name, value in (('cases', cases), ('seed', seed), ('shrunk', shrunk))
    )
    names = (
        None
        if families is None
        else [_family(each) for each in _several('families', families, 'names')]
    )
    if cases < 1 or names == []:
        raise ValueError(
            f'found {cases} cases of {"no" if names == [] else "some"} families, expected at least one'
        )
    with Progress(cases, progress) as line:
        rows, columns = _extension().hold(
            chosen, names or [], cases, seed, shrunk, line.show if line.is_shown else None
        )
    return TrialResult(
        [(subject, kind, family, Counts(*counts)) for subject, kind, family, *counts in rows],
        Findings(
            **{
                name: np.asarray(column, str) if isinstance(column, list) else column
                for name, column in columns.items()
            }
        ),
    )


def _subjects_of(subjects: Any) -> list[Union[Subject, str]]:
    """The subjects of a trial. Raises an exception if two of them have the same name."""
    is_one = isinstance(subjects, (Subject, str)) or callable(subjects)
    if not is_one and (isinstance(subjects, bytes) or not isinstance(subjects, Iterable)):
        raise TypeError(
            f'subjects is {subjects!r}, expected a Subject, a function, a name, or several of these'
        )
    chosen: list[Union[Subject, str]] = [
        each if isinstance(each, (Subject, str)) else Subject(each)
        for each in ([subjects] if is_one else subjects)
    ]
    names = [each if isinstance(each, str) else each.name for each in chosen]
    if not names:
        raise ValueError('found no subject, expected at least one')
    if len(set(names)) != len(names):
        raise ValueError(f'subjects have the names {", ".join(names)}, expected different ones')
    for name in names:
        # isprintable() also refuses a lone surrogate, which UTF-8 cannot encode.
        if not str.isprintable(name):
            raise ValueError(f'found the name {name!r}, expected printable characters')
    return chosen


def _several(name: str, values: Any, expected: str) -> list[Any]:
    """The values as a list; a string is a single value."""
    if isinstance(values, str):
        return [values]
    if not isinstance(values, Iterable):
        raise TypeError(f'{name} is {values!r}, expected {expected}')
    return list(values)


def _family(name: Any) -> str:
    """The name of a family. The extension refuses unknown names."""
    if not isinstance(name, str):
        raise TypeError(f'found the family {name!r}, expected a name')
    if not str.isprintable(name):
        raise ValueError(f'found the family {name!r}, expected printable characters')
    return name


def _count(name: str, value: Any) -> int:
    """The value as an unsigned number of 64 bits."""
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f'{name} is {value!r}, expected an integer') from None
    if not 0 <= number < 2**64:
        wanted = 'not negative' if number < 0 else 'below 2^64'
        raise ValueError(f'{name} is {number}, expected a number that is {wanted}')
    return number


def families() -> dict[str, str]:
    """The names of the families of random queries, and for each name what is hard about the queries."""
    return dict(_extension().families())


def queries(
    family: str, kind: KindLike, count: int, seed: int = 1
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The first queries of a kind in a family: x (count, 2, 4, 3) and their separations (count,).

    The families 'v-NAME' have the kinds 'vv' and 've', with 2 and 3 vertices in place of 4.
    """
    x, separation = _extension().queries(
        _family(family), kind_of(kind).value, _count('count', count), _count('seed', seed)
    )
    return x, separation


@functools.cache
def _extension() -> Any:
    try:
        extension = importlib.import_module('nearmiss._trial')
    except ModuleNotFoundError:
        raise ImportError(
            'this nearmiss has no trials, because it was built without the component tools'
        ) from None
    atexit.register(extension.end_calls)  # daemon threads may not use Python after this
    return extension

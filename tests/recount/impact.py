"""Times of impact: which sort of time each subject gives, and how far its times are from the exact
times."""

import math
from dataclasses import dataclass

import numpy as np

from asking import VERTICES, coordinates
from enclosed import BORDERS, Enclosed, PRECISION

SORTS = {  # the sort of time that each built-in subject gives, with any scalar
    'basic': 'estimate',
    'basic-plain': 'estimate',
    'bridson': 'estimate',
    'wang-time': 'lower-bound',
    'advance': 'lower-bound',
    'exact': 'lower-bound',
    'exact-scalar': 'lower-bound',
}
WORDS = {
    'an estimate of the time': 'estimate',
    'a lower bound of the time': 'lower-bound',
    'a time to which the step is free': 'free-step',
}
PROMISED = ('lower-bound', 'free-step')  # sorts of times before which no contact is promised

# The bound that wang claims in double, in units of the pair's size B: sqrt(D^2 + 2 delta), with
# D^2 = 1678 eps^(1/2) and delta = 311 eps (sections 4.2 and 4.5 of the paper).
WANGS_BOUND = math.sqrt(1678 * math.sqrt(2.0**-52) + 2 * 311 * 2.0**-52)
ROUNDING = 1e-15  # more than the relative rounding error of one operation
SPLIT = {'vt': 1, 'ee': 2, 'vv': 1, 've': 1}  # the first vertex of the second primitive


def sort_of(subject, description):
    """The sort of time of a subject, from the description of a plug-in or from the name of a
    built-in subject."""
    built_in = SORTS.get(subject.split(':')[0], 'none')
    return next((sort for words, sort in WORDS.items() if words in description), built_in)


@dataclass
class Impact:
    """The times that a subject gives for the queries of one kind, and how far they are from t*, the
    exact earliest times. Arrays have one element for each query. An enclosure of `early`, `after`
    or `travelled` is NaN if the query has no such number."""

    sort: str
    time: np.ndarray  # the subject's time for a true positive; NaN if there is none
    early: Enclosed  # t* - time, if the time is not after t*
    after: Enclosed  # time - t*, if the time is after t*
    travelled: Enclosed  # relative motion of the vertices in the time `early`, divided by B
    stuck: np.ndarray  # bool
    committed: np.ndarray  # bool: contact before the end of the rounded step to a sound time
    touches_at_end: np.ndarray  # bool: contact only at the end of this step

    @property
    def given(self):
        return ~np.isnan(self.time)

    @property
    def late(self):
        """Whether the time is after t*, although the subject promised a lower bound of t*."""
        return ~np.isnan(self.after.lo) & (self.sort in PROMISED)

    @property
    def unsafe_step(self):
        """Whether the rounded step has contact before its end (`committed`), although the subject
        promised a step free of contact."""
        return self.committed & (self.sort == 'free-step')


def compare(nearmiss, times, kind, sort, verdicts, judged, collision, rounds):
    """Compares a subject's times for true positives with the earliest times t*. `times` gives enclosures
    of t*, and `rounds` says whether the subject computes in float."""
    given = verdicts.hit & collision & ~np.isnan(verdicts.time) & (sort != 'none')
    own = np.flatnonzero(given)
    lo, hi = (np.full(len(judged), np.nan) for _ in range(2))
    lo[own], hi[own] = times.of([judged[i] for i in own])
    time = np.where(given, verdicts.time, np.nan)
    is_after = (time >= hi) & ~((lo == hi) & (time == lo))  # if lo < hi, t* is between them
    early = _where(given & ~is_after, lo - time, hi - time)
    after = _where(is_after, time - hi, time - lo)
    stuck = (time == 0) & (hi > 0)
    travelled = Enclosed(*(np.full(len(judged), np.nan) for _ in range(2)))
    moving = np.flatnonzero(given & ~is_after)
    speed = _speeds(nearmiss, kind, [judged[i] for i in moving])
    most = np.maximum(
        early.hi[moving] * (1 + PRECISION), np.where(early.lo[moving] < BORDERS[0], BORDERS[0], 0)
    )
    most[early.hi[moving] == 0] = 0
    travelled.lo[moving], travelled.hi[moving] = early.lo[moving] * speed.lo, most * speed.hi
    sound = given & ~is_after & (time != 0) & (sort in PROMISED)
    committed, at_end = _committed(times, judged, time, np.flatnonzero(sound), rounds)
    return Impact(sort, time, early, after, travelled, stuck, committed, at_end)


def _committed(times, judged, time, own, in_float):
    """Considers, for each query, the step from the start to start + time * (end - start), rounded
    to float or double. Returns whether this step has contact before its end, and whether it has
    contact only at its end."""
    scalar = np.float32 if in_float else np.float64
    before, at_end = np.zeros(len(judged), bool), np.zeros(len(judged), bool)
    steps = {}
    for i in own:
        words = judged[i].split()
        count = len(words) // 6 * 6  # a separation may follow
        x = np.array([float.fromhex(word) for word in words[:count]]).astype(scalar)
        start, end = x[: count // 2], x[count // 2 :]
        with np.errstate(all='ignore'):
            place = start + scalar(time[i]) * (end - start)
        if np.isfinite(place).all():
            numbers = (float(number).hex() for number in (*start, *place))
            steps[i] = ' '.join([*numbers, *words[count:]])
    if steps:
        earliest = times.of(list(steps.values()))[0]
        before[list(steps)] = earliest < 1
        at_end[list(steps)] = earliest == 1
    return before, at_end


def _where(is_there, lo, hi):
    """Encloses differences from t* between `lo` and `hi` where `is_there` is true; gives NaN
    elsewhere. Negative ends become 0. The enclosures are widened by the rounding errors of the
    differences."""
    return Enclosed(
        np.where(is_there, np.maximum(lo, 0) * (1 - ROUNDING), np.nan),
        np.where(is_there, np.maximum(hi, 0) * (1 + ROUNDING), np.nan),
    )


def _speeds(nearmiss, kind, queries):
    """For each query, how far a vertex of one primitive moves in the whole step relative to a
    vertex of the other primitive: the largest of these distances, divided by the pair's size B."""
    if not queries:
        return Enclosed(np.zeros(0), np.zeros(0))
    pairs = [coordinates(kind, query) for query in queries]
    bound = nearmiss.verdicts(*_as_meshes(kind, pairs), 'wang').bound
    x = np.array([[float.fromhex(word) for word in pair] for pair in pairs])
    with np.errstate(all='ignore'):
        B = bound / WANGS_BOUND
        place = x.reshape(-1, 2, VERTICES[kind], 3) / B[:, None, None, None]
        moved = place[:, 1] - place[:, 0]
        first, second = np.split(moved, [SPLIT[kind]], axis=1)
        relative = np.linalg.norm(first[:, :, None] - second[:, None, :], axis=-1)
        relative = np.nan_to_num(relative, nan=0, posinf=np.inf)
        speed = relative.max(axis=(1, 2))
        speed[np.isinf(speed)] = 0  # as in the program that makes the report

        # The slack covers the rounding of quotients by B. It also covers a subnormal `bound`: B is
        # computed from `bound`, and a subnormal number has few digits.
        relative_error = 1e-12 + 1e-322 / bound
        slack = np.nan_to_num(
            1e-15 * np.abs(place).max(axis=(1, 2, 3)) + speed * relative_error, nan=np.inf
        )
    return Enclosed(np.maximum(speed - slack, 0), speed + slack)


def _as_meshes(kind, pairs):
    """Turns queries of any kind into queries of vt or ee, by repeating the last vertex of a query
    until the query has four vertices. Returns the new kind and the new queries."""
    missing, count = 4 - VERTICES[kind], 3 * VERTICES[kind]
    whole = [
        ' '.join(
            word
            for at in (0, count)
            for word in pair[at : at + count] + missing * pair[at + count - 3 : at + count]
        )
        for pair in pairs
    ]
    return 'ee' if kind == 'ee' else 'vt', whole


@dataclass
class Times:
    """A subject's times of impact for some queries: their counts and their errors."""

    sort: str  # 'none' without times
    given: int
    promised: int
    late: int
    stuck: int
    committed: int
    unsafe_steps: int
    touch_at_end: int
    early: Enclosed
    after: Enclosed
    travelled: Enclosed

    @classmethod
    def of(cls, impacts, own):
        """Adds up the times of impact of several kinds. `own` selects some queries of each kind."""
        of_kinds = list(zip(impacts, own))
        given, late, stuck, *of_steps = (
            sum(int(getattr(each, name)[some].sum()) for each, some in of_kinds)
            for name in ('given', 'late', 'stuck', 'committed', 'unsafe_step', 'touches_at_end')
        )
        sort = impacts[0].sort if given else 'none'
        early, after, travelled = (
            _without_gaps(Enclosed.joined([getattr(each, name)[some] for each, some in of_kinds]))
            for name in ('early', 'after', 'travelled')
        )
        promised = given if sort in PROMISED else 0
        sort = 'lower-bound' if promised else sort
        return cls(sort, given, promised, late, stuck, *of_steps, early, after, travelled)

    @property
    def errors(self):
        """Enclosures of |time - t*|."""
        return Enclosed.joined([self.early, self.after])


def _without_gaps(enclosed):
    return enclosed[~np.isnan(enclosed.lo)]

"""All queries of a campaign, with the answers of the oracle and of the subjects to each query."""

import functools
import re
import typing
from dataclasses import dataclass

import numpy as np

from asking import KINDS, separation
from enclosed import Enclosed
from impact import Impact, compare, sort_of


@dataclass
class Asked:
    """The answers of one subject to the queries of one kind. Arrays have one element for each
    query."""

    hit: np.ndarray  # bool
    stage: np.ndarray  # names of the accepting stages
    collision: np.ndarray  # bool: the truth of the query by which the subject is judged
    claims: bool  # whether the subject claims a bound
    ratios: Enclosed  # (distance - separation) / bound of a false positive; NaN elsewhere
    judged: list  # the queries by which the subject is judged, as lines
    impact: Impact
    claimed: typing.Callable  # query, as a line -> the bound that the subject claims

    def enclosed(self, name):
        """The numbers that the histogram `name` counts: one for each query, NaN if there is
        none."""
        return self.ratios if name == 'fp_distance' else getattr(self.impact, name)

    @property
    def false_negative(self):
        return self.collision & ~self.hit


@dataclass
class Answers:
    """All answers, and the queries of each kind, sorted by family and then by number."""

    seed: int
    family: dict  # kind -> names
    number: dict  # kind -> numbers within the family
    queries: dict  # kind -> lines
    factors: dict  # kind -> (family, number) -> values, for families with factors
    within: dict  # kind -> bool: a collision or a tie
    collision: dict  # kind -> bool
    asked: dict  # (subject, kind) -> Asked
    times: dict  # kind -> Known enclosures of t*

    def __post_init__(self):
        self.tallies = {}  # (subject, kinds, family) -> Tally
        self._place = {
            kind: {place: i for i, place in enumerate(zip(self.family[kind], self.number[kind]))}
            for kind in KINDS
        }

    @property
    def subjects(self):
        return sorted({subject for subject, _ in self.asked})

    def kinds(self, subject):
        """The kinds of queries that the subject was asked, in order."""
        return tuple(kind for kind in KINDS if (subject, kind) in self.asked)

    def families(self, kind):
        return sorted(set(self.family[kind]))

    def place(self, kind, provenance):
        """The index of the query "family:seed:number"; None if there is no such query."""
        family, seed, number = provenance.rsplit(':', 2)
        if seed != str(self.seed):
            return None
        return self._place[kind].get((family, int(number)))


def ask(nearmiss, seed, counts, subjects, kinds_of):
    """Collects answers to the first counts[kind][family] queries of each kind in each family.
    `subjects` are names, or paths of shared objects with one subject each. `kinds_of` maps the
    name of each subject to the kinds of queries that the subject was asked."""
    answers = Answers(seed, *_queries(nearmiss, seed, counts), {}, {}, {}, {})
    for kind in KINDS:
        answers.within[kind] = nearmiss.within(kind, answers.queries[kind])
        answers.collision[kind] = nearmiss.collisions(kind, answers.queries[kind])
        distances = Known(functools.partial(nearmiss.distances, kind))
        times = answers.times[kind] = Known(functools.partial(nearmiss.times, kind))
        for subject in subjects:
            name, description = nearmiss.plugin(subject) if '/' in subject else (subject, '')
            sort = sort_of(name, description)
            if kind in kinds_of.get(name, KINDS):
                answers.asked[name, kind] = _ask_one(
                    nearmiss, answers, subject, kind, distances, times, sort
                )
    return answers


def _queries(nearmiss, seed, counts):
    family, number, queries = {}, {}, {}
    for kind in KINDS:
        family[kind], number[kind], queries[kind] = [], [], []
        for name, count in sorted(counts[kind].items()):
            own = _numbers(kind, count)
            lines = nearmiss.family(name, seed, kind, count)
            if len(lines) != len(own):
                raise RuntimeError(
                    f'nearmiss family {name}: found {len(lines)} queries, expected {len(own)}'
                )
            family[kind] += [name] * len(own)
            number[kind] += own
            queries[kind] += lines
        family[kind] = np.array(family[kind])
        number[kind] = np.array(number[kind])
    return family, number, queries, _factors(nearmiss, seed, counts)


def _numbers(kind, count):
    """The numbers of the first queries of a kind in a family. These numbers are even for vt and
    vv, and odd for the other kinds."""
    first = KINDS.index(kind) % 2
    return range(first, first + 2 * count, 2)


def _factors(nearmiss, seed, counts):
    """Factors are properties that some families vary from query to query. The result maps a kind,
    and then the family and the number of a query, to the values of the query's factors."""
    factors = {kind: {} for kind in KINDS}
    for kind in KINDS:
        for name, count in counts[kind].items():
            if re.match('(v-)?(crossed|metres|units|distant)\\b', name):
                values = nearmiss.factors(name, seed, kind, count)
                keys = ((name, number) for number in _numbers(kind, count))
                factors[kind].update(zip(keys, values))
    return factors


def _ask_one(nearmiss, answers, subject, kind, distances, times, sort):
    verdicts = nearmiss.verdicts(kind, answers.queries[kind], subject)
    rounds = verdicts.rounded != answers.queries[kind]
    judged = verdicts.rounded if rounds else answers.queries[kind]
    collision = nearmiss.collisions(kind, judged) if rounds else answers.collision[kind]
    within = nearmiss.within(kind, judged) if rounds else answers.within[kind]
    collision = collision | (within & verdicts.hit)  # both answers are right for a tie
    false = np.flatnonzero(verdicts.hit & ~collision)
    h = np.array([separation(kind, judged[i]) for i in false])
    lo, hi = (np.maximum(end - h, 0) for end in distances.of([judged[i] for i in false]))
    ratio_lo, ratio_hi = np.full((2, len(judged)), np.nan)
    ratio_lo[false], ratio_hi[false] = ratios(lo, hi, verdicts.bound[false])
    unknown = false[verdicts.stage[false] == 'unknown']
    ratio_lo[unknown] = ratio_hi[unknown] = 0  # here, the subject claims no bound
    return Asked(
        verdicts.hit,
        verdicts.stage,
        collision,
        verdicts.claims,
        Enclosed(ratio_lo, ratio_hi),
        judged,
        compare(nearmiss, times, kind, sort, verdicts, judged, collision, rounds),
        lambda line: nearmiss.verdicts(kind, [line], subject).bound[0],
    )


class Known:
    """Computes enclosures of a quantity, such as the smallest distance. Computes them once per
    query."""

    def __init__(self, ask_about):
        self._ask_about, self._known = ask_about, {}

    def of(self, queries):
        """The lower and the upper ends of the enclosures of the quantity for some queries."""
        new = sorted({query for query in queries if query not in self._known})
        self._known.update(zip(new, self._ask_about(new).T))
        return np.array([self._known[query] for query in queries]).reshape(-1, 2).T


def ratios(lo, hi, bound):
    """Enclosures of distance / bound. The ratio is infinite if the bound is 0, and 0 if the bound
    is infinite."""
    slack = 1e-15  # more than the rounding error of one division
    with np.errstate(divide='ignore', over='ignore', invalid='ignore'):
        ratio_lo, ratio_hi = lo / bound * (1 - slack), hi / bound * (1 + slack)
    zero, infinite = bound == 0, np.isinf(bound)
    ratio_lo[zero] = ratio_hi[zero] = np.inf
    ratio_lo[infinite] = ratio_hi[infinite] = 0
    return ratio_lo, ratio_hi

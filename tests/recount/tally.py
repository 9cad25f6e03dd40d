"""Recomputes counters, histograms and intervals from single answers."""

import functools
from dataclasses import dataclass

import numpy as np
from scipy.special import betaincinv

# Borders of the histogram's bins, four to a decade from 10^-16 to 10^1. One more bin lies below
# all borders and one above.
BORDERS = np.array([10.0 ** (-16 + i / 4) for i in range(17 * 4 + 1)])
BINS = len(BORDERS) + 1
FARTHEST = 5  # number of farthest false positives that are kept
PRECISION = 1.01e-3  # relative error by which a reported largest ratio may exceed the true one
LARGEST = np.finfo(float).max
CLASSES = ('ordinary', 'degenerate', 'extreme', 'unclassified')


@dataclass
class Tally:
    """Counters of one subject over some queries, and distance / bound of its false positives."""

    subject: str
    queries: int
    collisions: int
    positives: int
    false_negatives: int
    false_positives: int
    claims: bool
    true_by_stage: dict
    false_by_stage: dict
    ratio_lo: np.ndarray  # lower ends of the enclosures of the false positives' ratios
    ratio_hi: np.ndarray

    @classmethod
    def of(cls, answers, subject, kinds, family=None):
        """The tally over the queries of these kinds, of one family, of a tuple of families, or of
        all. It is computed once."""
        key = subject, tuple(kinds), family
        if key not in answers.tallies:
            answers.tallies[key] = cls._of(answers, *key)
        return answers.tallies[key]

    @classmethod
    def _of(cls, answers, subject, kinds, family):
        parts = [_part(answers, subject, kind, family) for kind in kinds]
        hit, collision, stage, lo, hi = (np.concatenate(column) for column in zip(*parts))
        false = hit & ~collision
        return cls(
            subject,
            len(hit),
            int(collision.sum()),
            int(hit.sum()),
            int((collision & ~hit).sum()),
            int(false.sum()),
            answers.asked[subject, kinds[0]].claims,
            _by_name(stage[hit & collision]),
            _by_name(stage[false]),
            lo[false],
            hi[false],
        )

    @functools.cached_property
    def bins(self):
        """The histogram's bins of each false positive, by the lower and by the upper end of its
        ratio."""
        return [
            np.searchsorted(BORDERS, ratio, side='right')
            for ratio in (self.ratio_lo, self.ratio_hi)
        ]

    @functools.cached_property
    def histogram(self):
        """For each bin, the number of ratios certainly in it, and the number that may be in it."""
        first, last = self.bins
        least = np.bincount(first[first == last], minlength=BINS)
        most = least.copy()
        for lowest, highest in zip(first[first != last], last[first != last]):
            most[lowest : highest + 1] += 1
        return least, most

    def refuted(self):
        """The least and the largest number of refuted bounds that the enclosures allow."""
        if not self.claims:
            return 0, 0
        return int((self.ratio_lo > 1).sum()), int((self.ratio_hi > 1).sum())

    def farthest(self):
        """The enclosures of the largest ratios, largest first."""
        lo, hi = (np.sort(ratio)[::-1][:FARTHEST] for ratio in (self.ratio_lo, self.ratio_hi))
        return [reported(*ends) for ends in zip(lo, hi)]

    def quantile_bins(self, part):
        """The first and the last bin that may contain the ratio that a fraction `part` of all does
        not exceed.

        The result is None without false positives."""
        if self.false_positives == 0:
            return None
        place = max(int(np.ceil(part * self.false_positives)), 1) - 1
        return tuple(int(np.sort(bins)[place]) for bins in self.bins)


def _part(answers, subject, kind, family):
    asked = answers.asked[subject, kind]
    names = (family,) if isinstance(family, str) else family
    own = slice(None) if names is None else np.isin(answers.family[kind], names)
    return [
        each[own]
        for each in (asked.hit, asked.collision, asked.stage, asked.ratio_lo, asked.ratio_hi)
    ]


def classes_of(class_of):
    """The families of each class, in the order of reports; class_of maps families to classes."""
    members = {
        each: tuple(family for family, own in class_of.items() if own == each) for each in CLASSES
    }
    return {each: families for each, families in members.items() if families}


def _by_name(stages):
    return {str(name): int(count) for name, count in zip(*np.unique(stages, return_counts=True))}


def reported(lo, hi):
    """The range of a reported ratio whose true value is from lo to hi. Reports round ratios up.

    The largest double stands for infinity. For a ratio below all borders, a report need not know
    more than that."""
    most = BORDERS[0] if lo < BORDERS[0] else 0
    return min(lo, LARGEST), min(max(hi * (1 + PRECISION), most), LARGEST)


def stages(subject, counts):
    """Counts by the accepting stage that do not depend on which queries are decided at once.

    The subject exact decides many queries at once; its filter then leaves other queries
    undecided."""
    if subject != 'exact':
        return counts
    others = {name: count for name, count in counts.items() if name not in ('filter', 'exact')}
    return {**others, 'filter or exact': sum(counts.values()) - sum(others.values())}


def denominators(tally):
    """The totals that divide the numbers of false negatives and of false positives."""
    return tally.collisions, tally.queries - tally.collisions


def rate(count, total):
    """The quotient, or 0 if the total is 0."""
    return count / total if total else 0.0


@functools.cache
def upper_bound(count, total, risk=0.05):
    """Clopper and Pearson's upper bound of a rate, which is wrong with probability at most
    `risk`."""
    return 1.0 if count >= total else float(betaincinv(count + 1, total - count, 1 - risk))


def interval(count, total, risk=0.05):
    """Clopper and Pearson's interval of a rate, with half of the risk at each end."""
    lower = 0.0 if count == 0 else float(betaincinv(count, total - count + 1, risk / 2))
    return lower, upper_bound(count, total, risk / 2)

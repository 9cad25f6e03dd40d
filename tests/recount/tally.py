"""Recomputes counters, histograms and confidence intervals from single answers."""

import functools
from dataclasses import dataclass

import numpy as np
from scipy.special import betaincinv

from enclosed import Enclosed
from impact import Times

CLASSES = ('ordinary', 'degenerate', 'extreme', 'unclassified')
ON_REQUEST = {'committed', 'unknown'}  # failures that count only with --fail-on


@dataclass
class Tally:
    """The results of one subject for some queries: counters, times of impact, and, for each false
    positive, the ratio of its distance to the subject's bound."""

    subject: str
    queries: int
    collisions: int
    positives: int
    false_negatives: int
    false_positives: int
    claims: bool
    true_by_stage: dict
    false_by_stage: dict
    ratios: Enclosed  # distance / bound of the false positives
    times: Times

    @classmethod
    def of(cls, answers, subject, kinds, family=None):
        """The tally over the queries of some kinds. `family` is one family, a tuple of families, or None
        for all. Each tally is computed only once."""
        key = subject, tuple(kind for kind in kinds if kind in answers.kinds(subject)), family
        if key not in answers.tallies:
            answers.tallies[key] = cls._of(answers, *key)
        return answers.tallies[key]

    @classmethod
    def _of(cls, answers, subject, kinds, family):
        parts = [_part(answers, subject, kind, family) for kind in kinds]
        hit, collision, stage = (
            np.concatenate([getattr(asked, name)[own] for asked, own in parts])
            for name in ('hit', 'collision', 'stage')
        )
        false = hit & ~collision
        claims = answers.asked[subject, kinds[0]].claims
        return cls(
            subject,
            len(hit),
            int(collision.sum()),
            int(hit.sum()),
            int((collision & ~hit).sum()),
            int(false.sum()),
            claims,
            _by_name(stage[hit & collision]),
            _by_name(stage[false]),
            Enclosed.joined([asked.ratios[own] for asked, own in parts])[false],
            Times.of([asked.impact for asked, _ in parts], [own for _, own in parts]),
        )

    def refuted(self):
        """How many bounds are refuted. The ratios of distance to bound are known only as
        enclosures, so this returns the smallest and the largest possible number."""
        if not self.claims:
            return 0, 0
        return int((self.ratios.lo > 1).sum()), int((self.ratios.hi > 1).sum())

    @property
    def enclosed(self):
        """Maps the key of each histogram in a report to the numbers that the histogram counts."""
        times = self.times
        return {
            'fp_distance': self.ratios,
            'early': times.early,
            'after': times.after,
            'travelled': times.travelled,
        }

    @property
    def unknown(self):
        """The number of queries that the subject reported because it could not decide them."""
        return sum(
            stages.get('unknown', 0) for stages in (self.true_by_stage, self.false_by_stage)
        )


def _part(answers, subject, kind, family):
    """The answers to all queries of a kind, and an index that selects the queries of `family`."""
    names = (family,) if isinstance(family, str) else family
    own = slice(None) if names is None else np.isin(answers.family[kind], names)
    return answers.asked[subject, kind], own


def classes_of(class_of):
    """Maps each class, in the order of CLASSES, to its families; `class_of` maps families to classes."""
    members = {
        each: tuple(family for family, own in class_of.items() if own == each) for each in CLASSES
    }
    return {each: families for each, families in members.items() if families}


def _by_name(stages):
    return {str(name): int(count) for name, count in zip(*np.unique(stages, return_counts=True))}


def failures_of(counts):
    """The kinds of failures in a subject's counters, the gravest first. Recomputed campaigns have no
    faults."""
    found = {
        'miss': counts['false_negatives'],
        'late': counts['late'],
        'unsafe-step': counts['unsafe_steps'],
        'beyond-bound': counts['refuted_bounds'],
        'unjudged': counts['queries'] == 0,
        'committed': counts['committed'] - counts['unsafe_steps'],
        'unknown': counts['unknown'],
    }
    return [name for name, count in found.items() if count]


def stages(subject, counts):
    """Counts by accepting stage. For the subject `exact`, adds up the stages filter and exact, for
    the reason that README.md gives."""
    if subject != 'exact':
        return counts
    others = {name: count for name, count in counts.items() if name not in ('filter', 'exact')}
    return {**others, 'filter or exact': sum(counts.values()) - sum(others.values())}


def denominators(tally):
    """The denominators of the rates of false negatives and of false positives."""
    return tally.collisions, tally.queries - tally.collisions


def rate(count, total):
    """count / total, or 0 if `total` is 0."""
    return count / total if total else 0.0


@functools.cache
def upper_bound(count, total, risk=0.05):
    """Clopper and Pearson's upper bound, which the true rate exceeds with probability at most `risk`."""
    return 1.0 if count >= total else float(betaincinv(count + 1, total - count, 1 - risk))


def interval(count, total, risk=0.05):
    """Clopper and Pearson's interval of a rate, with half of the risk on each side."""
    lower = 0.0 if count == 0 else float(betaincinv(count, total - count + 1, risk / 2))
    return lower, upper_bound(count, total, risk / 2)

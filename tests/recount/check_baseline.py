"""Checks what a report says about changes of run times and of ways to fail since its baseline.
Reads the stores themselves."""

import json
import math
import re
import sqlite3
from collections import Counter, defaultdict
from dataclasses import dataclass, field
from statistics import mean, variance

from scipy.stats import hypergeom, t

from asking import KINDS
from check_numbers import SOLVED
from comparison import Near

RISK = 1e-3
FEWEST_FAMILIES = 8
FAMILY, SUBJECT, MACHINE = 0.05, 0.08, 0.15
ALL = 'all families'


@dataclass
class Night:
    """The data of a campaign in a store."""

    times: dict = field(default_factory=dict)
    counts: dict = field(default_factory=dict)
    seen: dict = field(default_factory=dict)
    processors: set = field(default_factory=set)

    @classmethod
    def of(cls, store):
        """Reads a store."""
        night = cls()
        database = sqlite3.connect(f'file:{store}?mode=ro', uri=True)

        def rows(table):
            for row in database.execute(f'SELECT key, value FROM {table}'):
                yield map(json.loads, row)

        for key, counts in rows('counts'):
            key = key['subject'], key['kind'], key['family']
            night.counts[key] = counts
            bins = [each for _, of_family in counts['times']['batches'] for each in of_family]
            if len(bins) > 1 and _is_random(key[2]):
                night.times[key] = _log_time(bins)
        for key, times in rows('seen'):
            night.seen[key['what'], key['subject'], key['text']] = times
        for _, shard in rows('shard'):
            night.processors.add(shard['environment'].get('cpu'))
        database.close()
        return night


def _is_random(family):
    return not family.endswith('/') and not family.startswith('scene:')


def _log_time(bins):
    """The mean logarithm of a family's times, its variance, and the degrees of freedom."""
    queries = sum(count for _, count in bins)
    logs = [(math.log(ps / 1000), count) for ps, count in bins]
    middle = sum(log * count for log, count in logs) / queries
    squares = sum(count * (log - middle) ** 2 for log, count in logs)
    return middle, squares / (len(bins) - 1) / queries, len(bins) - 1


def _median(values):
    """The median; if there are two middle values, the one nearer to 0."""
    values = sorted(values)
    return min(values[(len(values) - 1) // 2], values[len(values) // 2], key=abs)


class _Times:
    """The ratios of times to those of the baseline, and tests of these ratios."""

    def __init__(self, now, nights):
        self.now, self.nights = now, nights
        self.subjects = defaultdict(list)
        for key in now.times:
            self.subjects[key[0]].append(key)
        self.common, self.own = defaultdict(list), defaultdict(list)
        for night in nights:
            self._compare(night)

    def _compare(self, night):
        ratios = {
            key: time[0] - night.times[key][0]
            for key, time in self.now.times.items()
            if key in night.times
        }
        by_subject = {
            subject: [ratios[key] for key in keys if key in ratios]
            for subject, keys in self.subjects.items()
        }
        medians = {subject: _median(logs) for subject, logs in by_subject.items() if logs}
        machine = _median([0, *medians.values()])
        for subject, ratio in medians.items():
            kinds = {key[1] for key in self.subjects[subject]}
            names = ', '.join(kind for kind in KINDS if kind in kinds)
            self._note((subject, names, ALL), ratio, machine)
        for key, ratio in ratios.items():
            has_spread = len(self.subjects[key[0]]) >= FEWEST_FAMILIES
            self._note(key, ratio, medians[key[0]] if has_spread else machine)

    def _note(self, key, ratio, common):
        self.common[key].append(common)
        self.own[key].append(ratio - common)

    def _sampling(self, key):
        """The variances of a key's times, now and before, each with its degrees of freedom."""
        nights = [night.times[key] for night in self.nights if key in night.times]
        terms = [self.now.times[key], *nights]
        shares = [1, *([len(nights) ** -2] * len(nights))]
        return [(share * value, free) for share, (_, value, free) in zip(shares, terms)]

    def _spread(self, key):
        """The variances of a change that is due to chance, each with its degrees of freedom."""
        subject, _, family = key
        factor = 1 + 1 / len(self.own[key])
        families = [each for each in self.own if each[0] == subject and each[2] != ALL]
        if family == ALL:
            terms = [
                (value / len(self.subjects[subject]) ** 2, free)
                for each in families
                for value, free in self._sampling(each)
            ]
        else:
            terms = self._sampling(key)
        if family == ALL or len(self.subjects[subject]) < FEWEST_FAMILIES:
            assumed = SUBJECT if len(self.subjects) > 1 else MACHINE
            return [*terms, (assumed**2 * factor / 2, math.inf)]
        usual = 1.4826 * _median([abs(mean(self.own[each])) for each in families])
        sampled = _median([sum(v for v, _ in self._sampling(each)) for each in families])
        least = FAMILY**2 * (1 + 1 / len(self.own[families[-1]])) / 2
        return [*terms, (max(usual**2 - sampled, least), len(families) - 1)]

    def tested(self):
        """The entries that report.json should have for the compared times, in order."""
        for key in sorted(
            self.own, key=lambda k: (k[0], 0 if k[2] == ALL else KINDS.index(k[1]), k[2])
        ):
            own, terms = self.own[key], self._spread(key)
            value = sum(v for v, _ in terms)
            weight = sum(v**2 / free for v, free in terms)
            free = min(value**2 / weight, 1e6) if weight else 1e6
            between = variance(own) * (1 + 1 / len(own)) if len(own) > 1 else 0
            change = mean(own)
            if key[2] == ALL:
                now = mean(self.now.times[each][0] for each in self.subjects[key[0]])
            else:
                now = self.now.times[key][0]
            p = 2 * t.sf(abs(change) / math.sqrt(max(value, between)), free)
            yield key, {
                'slower': change > 0,
                'ratio': Near(math.exp(change), SOLVED),
                'p': Near(p, 1e-6),
                'before_ns': Near(math.exp(now - change - mean(self.common[key])), SOLVED),
                'expected_ns': Near(math.exp(now - change), SOLVED),
                'now_ns': Near(math.exp(now), SOLVED),
            }


def _check_times(comparison, where, found, now, nights):
    nights = [night for night in nights if night.processors == now.processors]
    tested = list(_Times(now, nights).tested()) if nights else []
    comparison.same('changes', f'{where} campaigns', found['campaigns_with_times'], len(nights))
    comparison.same('changes', f'{where} compared', found['compared_times'], len(tested))
    changed = [(key, row) for key, row in tested if row['p'].value < RISK / len(tested)]
    names = [(row['subject'], row['kind'], row['family']) for row in found['changed_times']]
    comparison.same('names', f'{where} changed', names, [key for key, _ in changed])
    for row, (key, expected) in zip(found['changed_times'], changed):
        comparison.entries('changes', f'{where} {key}', row, expected)


def _most_steps(keys):
    """The number of steps of the longest sweep: its families NAME@VALUE share their draws."""
    steps = Counter(
        (kind, re.sub('@[^~]*', '@', family)) for _, kind, family in keys if '@' in family
    )
    return max(steps.values(), default=1)


def _gone(now, nights):
    """Two sets of signatures that only the baseline has: those that are gone, and those that
    chance may hide. Assumes that subjects have no faults, and are asked only random queries."""
    before, seen, of_sort = defaultdict(int), defaultdict(int), defaultdict(int)
    for night in nights:
        for key, row in night.counts.items():
            before[key] += row['queries']
        for signature, times in night.seen.items():
            seen[signature] += times
            of_sort[signature[:2]] += times
    candidates = [signature for signature in seen if signature not in now.seen]
    level = RISK / (len(candidates) + len(of_sort)) if seen else 0

    def chance_of_none(subject, times):
        asked = {key: number for key, number in before.items() if key[0] == subject}
        steps = max(
            _most_steps(asked), _most_steps([key for key in now.counts if key[0] == subject])
        )
        least = min(
            now.counts[key]['queries'] / number if key in now.counts else 0
            for key, number in asked.items()
        )
        again = int(least * sum(asked.values())) // steps
        total = sum(asked.values()) // steps
        return hypergeom.cdf(0, again + total, times // steps, again)

    still = {signature[:2] for signature in now.seen}
    gone = {
        signature
        for signature in candidates
        if chance_of_none(signature[1], seen[signature]) < level
        or (
            signature[:2] not in still
            and chance_of_none(signature[1], of_sort[signature[:2]]) < level
        )
    }
    return gone, set(candidates) - gone


def check_baseline(comparison, where, found, now, nights):
    """Checks which run times have changed and which signatures are gone, by the stores of the
    campaign and of its baseline."""
    now, nights = Night.of(now), [Night.of(each) for each in nights]
    _check_times(comparison, where, found, now, nights)
    for name, expected in zip(('gone', 'unrepeated'), _gone(now, nights)):
        signatures = [
            (row['what'], row['subject'], row['signature']) for row in found[f'{name}_signatures']
        ]
        comparison.same('names', f'{where} {name}', sorted(signatures), sorted(expected))

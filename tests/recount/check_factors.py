"""Checks the sections `common_factors` and `sizes` of report.json, which count answers by factors. A
factor is a property that a family varies from query to query; `edge=2^-9` is a value of the factor
`edge`."""

import itertools
import re
from collections import Counter

from comparison import Near
from check_numbers import ROUNDING


def check_common_factors(comparison, where, report, answers):
    """A subject's misses may have values of factors in common. Checks how many of the misses, and
    how many of all collisions, have these values."""
    for found in report.get('common_factors', []):
        subject, kind, family = found['subject'], found['kind'], found['family']
        counts = _counts(answers, subject, kind, family)
        all_of, some = counts[''], counts[found['values']]
        expected = {
            'collisions': all_of['collisions'],
            'false_negatives': all_of['false_negatives'],
            'share': Near(some['false_negatives'] / all_of['false_negatives'], ROUNDING),
            'share_of_collisions': Near(some['collisions'] / all_of['collisions'], ROUNDING),
        }
        comparison.entries('common factors', f'{where} {subject} {kind}', found, expected)


def check_sizes(comparison, where, report, answers):
    """A row of `sizes` has the range of edge lengths and the range of distances in which a subject
    is right. Checks the counts of the subject's answers outside these ranges."""
    for row in report.get('sizes', []):
        subject = row['subject']
        kinds = answers.kinds(subject) if row['kind'] == 'all' else (row['kind'],)
        counts = {kind: _counts(answers, subject, kind) for kind in kinds}
        for factor in ('edge', 'distance'):
            if row[factor]:
                own = _outside(counts, factor, row[factor]['from'], row[factor]['to'])
                place = f'{where} {subject} {row["kind"]} {factor}'
                comparison.entries('sizes', place, row[factor]['elsewhere'], own)


def _outside(counts, factor, first, last):
    """Counts the answers to queries for which a factor has a value 2^x outside first <= x <= last.
    Leaves out kinds that have fewer than two collisions per value on average. If all kinds have so
    few, leaves out none."""
    of_kinds = []
    for of_kind in counts.values():
        powers = {}
        for value, own in of_kind.items():
            if found := re.fullmatch(f'{factor}=2\\^(-?[0-9]+)', value):
                powers[int(found[1])] = own
        collisions = sum(own['collisions'] for own in powers.values())
        if powers:
            of_kinds.append((collisions >= 2 * len(powers), powers))
    enough = [powers for has_enough, powers in of_kinds if has_enough]
    outside = Counter(dict.fromkeys(NAMES, 0))
    for powers in enough or [powers for _, powers in of_kinds]:
        for x, own in powers.items():
            if first is None or not first <= x <= last:
                outside.update(own)
    return dict(outside)


NAMES = ('collisions', 'false_negatives', 'others', 'false_positives')


def _counts(answers, subject, kind, family=None):
    """Counts the answers to the queries of a family, or of all families with factors. The result
    has a count for each value of a factor, a count for each pair of values, and a count for all
    these queries, whose key is ''."""
    asked = answers.asked[subject, kind]
    counts = {'': Counter()}
    for i, own in enumerate(answers.family[kind]):
        values = answers.factors[kind].get((own, answers.number[kind][i]))
        if values is None or family not in (None, own):
            continue
        collides, hit = asked.collision[i], asked.hit[i]
        answer = (collides, collides and not hit, not collides, not collides and hit)
        pairs = (' '.join(pair) for pair in itertools.combinations(values, 2))
        for each in ('', *values, *pairs):
            counts.setdefault(each, Counter()).update(dict(zip(NAMES, map(int, answer))))
    return counts

"""Checks which values of factors missed collisions have in common, and where subjects are right."""

import itertools
import re

import numpy as np
from scipy.stats import hypergeom
from asking import KINDS

POWER = re.compile('[a-z]+=2\\^-?[0-9]+')  # sizes, of which check_sizes() takes care


def check_common_factors(comparison, where, report, answers):
    """Checks the section common_factors of report.json."""
    found = report.get('common_factors', [])
    expected = [
        each
        for subject in answers.subjects
        for kind in answers.kinds(subject)
        for family in answers.families(kind)
        if (each := common_factors(answers, subject, kind, family))
    ]
    comparison.same('names', f'{where} number', len(found), len(expected))
    for own, other in zip(found, expected):
        at = f'{where} {other["subject"]} {other["kind"]} {other["family"]}'
        comparison.entries('common factors', at, own, other)


def common_factors(answers, subject, kind, family):
    """One or two values of factors: those with the largest lift, among those that at least half
    of the misses have. None if there are no misses or no factors."""
    asked = answers.asked[subject, kind]
    collisions, misses = {}, {}
    for i, own in enumerate(answers.family[kind]):
        values = answers.factors[kind].get((family, answers.number[kind][i]))
        if own != family or values is None or not asked.collision[i]:
            continue
        pairs = (' '.join(pair) for pair in itertools.combinations(values, 2))
        for each in ('', *values, *pairs):
            collisions[each] = collisions.get(each, 0) + 1
            misses[each] = misses.get(each, 0) + int(not asked.hit[i])
    if not misses.get(''):
        return None
    common = [
        each
        for each in sorted(misses)
        if each and misses[each] and 2 * misses[each] >= misses[''] and not POWER.fullmatch(each)
    ]
    if not common:
        return None
    best = max(
        common, key=lambda each: (misses[each] / collisions[each], misses[each], ' ' not in each)
    )
    share = misses[best] / misses['']
    share_of_collisions = collisions[best] / collisions['']
    return {
        'subject': subject,
        'kind': kind,
        'family': family,
        'collisions': collisions[''],
        'false_negatives': misses[''],
        'values': best,
        'share': share,
        'share_of_collisions': share_of_collisions,
        'text': f'{100 * share:.0f} % of the missed ones have {best}, '
        f'and {100 * share_of_collisions:.0f} % of all',
    }


def check_sizes(comparison, where, report, answers):
    """Checks the section sizes of report.json."""
    expected = [row for subject in answers.subjects for row in _sizes(answers, subject)]
    found = report.get('sizes', [])
    comparison.same('names', f'{where} number', len(found), len(expected))
    for own, other in zip(found, expected):
        comparison.entries('sizes', f'{where} {other["subject"]} {other["kind"]}', own, other)


def _sizes(answers, subject):
    """The rows of a subject: one, or one for each kind if the kinds differ."""
    ranges = {}
    for kind in answers.kinds(subject):
        for factor in ('edge', 'distance'):
            powers = _powers(answers, subject, kind, factor)
            if powers:
                ranges[factor, kind] = _right_range(powers)
    kinds = [kind for kind in KINDS if any(key[1] == kind for key in ranges)]
    common = {}
    for factor in ('edge', 'distance'):
        own = [each for key, each in ranges.items() if key[0] == factor]
        if not own:
            continue
        own = [each for each in own if each[0] != 'too few'] or own
        everywhere = all(
            isinstance(exponents, tuple) and not elsewhere.any() for exponents, elsewhere in own
        )
        if len({exponents for exponents, _ in own}) > 1 and not everywhere:
            return [
                {
                    'subject': subject,
                    'kind': kind,
                    'edge': _as_json(ranges.get(('edge', kind))),
                    'distance': _as_json(ranges.get(('distance', kind))),
                }
                for kind in kinds
            ]
        exponents = own[0][0]
        if everywhere:
            exponents = (min(ends[0] for ends, _ in own), max(ends[1] for ends, _ in own))
        common[factor] = (exponents, np.sum([elsewhere for _, elsewhere in own], axis=0))
    if not common:
        return []
    return [
        {
            'subject': subject,
            'kind': 'all',
            'edge': _as_json(common.get('edge')),
            'distance': _as_json(common.get('distance')),
        }
    ]


def _powers(answers, subject, kind, factor):
    """For each x of "factor=2^x": collisions, misses, other queries, false positives."""
    asked = answers.asked[subject, kind]
    powers = {}
    for i, family in enumerate(answers.family[kind]):
        for value in answers.factors[kind].get((family, answers.number[kind][i]), []):
            found = re.fullmatch(f'{factor}=2\\^(-?[0-9]+)', value)
            if not found:
                continue
            counts = powers.setdefault(int(found[1]), np.zeros(4, int))
            collides, hit = asked.collision[i], asked.hit[i]
            counts += [collides, collides and not hit, not collides, not collides and hit]
    return powers


def _right_range(powers):
    """The exponents of the longest run of powers at which nothing is wrong, "too few", or None; and
    the counts of all other powers."""
    order = sorted(powers)
    sound = [x for x in order if not powers[x][1]]
    windows = [sound[i : i + 5] for i in range(max(1, len(sound) - 4))]
    sums = (sum((powers[x] for x in window), np.zeros(4, int)) for window in windows)
    best = min(sums, key=_rate)
    wrong = {x: powers[x][1] > 0 or _reports_more(powers[x], best) for x in order}
    run, longest = [], []
    for x in order:
        run = [] if wrong[x] else [*run, x] if run and run[-1] == x - 1 else [x]
        longest = max(longest, run, key=len)
    total = sum(powers.values())
    if total[0] < 2 * len(order):
        return 'too few', total
    inside = sum((powers[x] for x in longest), np.zeros(4, int))
    below = [x for x in reversed(order) if longest and x < longest[0]]
    above = [x for x in order if longest and x > longest[-1]]
    is_chance = any(
        _may_be_chance(inside[0], [powers[x] for x in side]) for side in (below, above)
    )
    if not inside[0] or is_chance:
        return None, total
    return (longest[0], longest[-1]), total - inside


def _may_be_chance(collisions, outside):
    """Whether chance explains that none of the collisions is missed, at some rate outside."""
    if not outside or not outside[0][1]:
        return False
    sums = np.cumsum(outside, axis=0)
    return any(each[0] and (1 - each[1] / each[0]) ** collisions >= 1e-4 for each in sums)


def _rate(counts):
    """The rate of false positives."""
    return counts[3] / counts[2] if counts[2] else 0


def _reports_more(counts, best):
    """Whether most of the rest is reported, or more than 0.25 above the best rate, not by chance."""
    if counts[2] >= 4 and _rate(counts) > 0.75:
        return True
    if _rate(counts) <= _rate(best) + 0.25:
        return False
    of_both = counts[2:] + best[2:]
    return hypergeom.sf(counts[3] - 1, of_both[0], of_both[1], counts[2]) < 1e-4


def _as_json(found):
    if found is None:
        return None
    exponents, elsewhere = found
    collisions, misses, others, positives = map(int, elsewhere)
    is_range = isinstance(exponents, tuple)
    wrong = [f'misses {misses:,} of {collisions:,}'] if misses else []
    if 3 * positives > others:
        wrong.append(f'reports {100 * positives / others:.3g} % of the rest')
    values = {None: 'no range', 'too few': 'too few queries'}
    return {
        'from': exponents[0] if is_range else None,
        'to': exponents[1] if is_range else None,
        'elsewhere': {
            'collisions': collisions,
            'false_negatives': misses,
            'others': others,
            'false_positives': positives,
        },
        'values': f'2^{exponents[0]} to 2^{exponents[1]}' if is_range else values[exponents],
        'wrong': ', '.join(wrong),
    }

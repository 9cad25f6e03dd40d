"""Checks which values of factors missed collisions have in common, and where subjects are right."""

import itertools
import re

import numpy as np
from asking import KINDS


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
        each for each in sorted(misses) if each and misses[each] and 2 * misses[each] >= misses['']
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
        everywhere = all(exponents and not elsewhere.any() for exponents, elsewhere in own)
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
    """The exponents of the longest run of powers at which nothing is wrong, or None; and the counts
    of all other powers."""
    runs, run = [], []
    usual = sum((powers[x] for x in powers if abs(x) <= 2), np.zeros(4, int))
    highest = _rate(usual) + 0.25
    for x in sorted(powers):
        if powers[x][1] or _rate(powers[x]) > highest:
            run = []
            continue
        run = [*run, x]
        runs.append(run)
    longest = max(runs, key=len, default=[])
    total = sum(powers.values())
    inside = sum((powers[x] for x in longest), np.zeros(4, int))
    if total[1] and (1 - inside[0] / total[0]) ** total[1] >= 1e-4:
        longest, inside = [], np.zeros(4, int)
    return (longest[0], longest[-1]) if longest else None, total - inside


def _rate(counts):
    """The rate of false positives."""
    return counts[3] / counts[2] if counts[2] else 0


def _as_json(found):
    if found is None:
        return None
    exponents, elsewhere = found
    collisions, misses, others, positives = map(int, elsewhere)
    if misses:
        wrong = f'misses {misses:,} of {collisions:,}'
    elif positives and exponents:
        wrong = f'reports {100 * positives / others:.3g} % of the rest'
    else:
        wrong = ''
    return {
        'from': exponents[0] if exponents else None,
        'to': exponents[1] if exponents else None,
        'elsewhere': {
            'collisions': collisions,
            'false_negatives': misses,
            'others': others,
            'false_positives': positives,
        },
        'values': f'2^{exponents[0]} to 2^{exponents[1]}' if exponents else 'none',
        'wrong': wrong,
    }

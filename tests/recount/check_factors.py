"""Checks which values of factors the missed collisions of a family have in common."""

import itertools


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

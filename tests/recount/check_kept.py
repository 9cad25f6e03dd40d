"""Checks the kept extreme cases: the farthest false positives, the earliest and latest times."""

from check_numbers import check_query
from enclosed import PRECISION
from tally import Tally

# For each list in which the report keeps cases: the histogram of their numbers, and the field of a
# case that has its number.
KEPT = {
    'farthest': ('fp_distance', 'ratio'),
    'earliest': ('early', 'error'),
    'latest': ('after', 'error'),
}


def check_kept(comparison, where, found, tally, answers, kind):
    """Checks the numbers and the queries of the cases that are kept for a sum."""
    for name, (of, key) in KEPT.items():
        numbers = tally.enclosed[of]
        expected = (numbers if key == 'ratio' else numbers[numbers.hi > 0]).largest()
        comparison.same('kept', f'{where} number of {name}', len(found[name]), len(expected))
        for i, (case, ends) in enumerate(zip(found[name], expected)):
            own = f'{where} {name} {i}'
            comparison.within('kept', own, case[key], *ends)
            _check_case(comparison, own, case, answers, tally.subject, kind, of, key)


def _check_case(comparison, where, case, answers, subject, kind, of, key):
    """Checks a case by its provenance, its number and its query. Returns the index of the query."""
    place, asked = answers.place(kind, case['provenance']), answers.asked[subject, kind]
    if place is None or not asked.enclosed(of).lo[place] >= 0:
        comparison.fail('provenances', where, case['provenance'], f'a query with a number {of}')
        return None
    comparison.within('kept', f'{where} own', case[key], *asked.enclosed(of).reported(place))
    check_query(comparison, where, case['query'], asked.judged[place])
    return place


def check_extreme_times(comparison, where, report, answers):
    """Checks the earliest and the latest time of each subject and kind."""
    found = report['extreme_times']
    rows = [(each['subject'], each['kind'], each['side']) for each in found]
    expected = [
        (subject, kind, side)
        for subject in answers.subjects
        for kind in answers.kinds(subject)
        for side in ('early', 'after')
        if (Tally.of(answers, subject, [kind]).enclosed[side].hi > 0).any()
    ]
    comparison.same('names', where, rows, expected)
    for each in found:
        subject, kind, side = each['subject'], each['kind'], each['side']
        own = f'{where} {subject} {kind} {side}'
        most = report['subjects'][subject][kind][f'max_{side}']
        comparison.same('times', own, each['error'], most)
        place = _check_case(comparison, own, each, answers, subject, kind, side, 'error')
        if place is not None:
            asked = answers.asked[subject, kind]
            least, largest = answers.times[kind].of([asked.judged[place]])
            comparison.within('times', f'{own} t*', each['time'], least[0], largest[0])
            slack, given = PRECISION * each['error'] + 1e-16, asked.impact.time[place]
            comparison.within('times', f'{own} toi', each['toi'], given - slack, given + slack)


def check_farthest(comparison, where, report, answers):
    """Checks the farthest false positive of each subject, kind and family."""
    found = report['farthest']
    rows = [(far['subject'], far['kind'], far['family']) for far in found]
    expected = [
        (subject, kind, family)
        for subject in answers.subjects
        for kind in answers.kinds(subject)
        for family in answers.families(kind)
        if Tally.of(answers, subject, [kind], family).false_positives
    ]
    comparison.same('names', where, rows, expected)
    for far in found:
        subject, kind, family = far['subject'], far['kind'], far['family']
        own = f'{where} {subject} {kind} {family}'
        _check_case(comparison, own, far, answers, subject, kind, 'fp_distance', 'ratio')
        counts = report['subjects'][subject][kind]['families'][family]
        of_family = {
            'shown_family': family,
            'class': counts['class'],
            'ratio': counts['max_fp_distance_over_bound'],
            'bound_of_distances': counts['bound_of_distances'],
        }
        comparison.entries('kept', own, far, of_family)

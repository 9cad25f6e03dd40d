"""Checks the single queries in report.json: the findings with their certificates, and the extreme
cases, which are the farthest false positives, the earliest times and the latest times."""

import math
import sys
from pathlib import Path

from asking import VERTICES
from check_numbers import check_query
from enclosed import PRECISION
from tally import Tally

sys.path.append(str(Path(__file__).resolve().parents[2] / 'tools' / 'certificates'))
from check import Refused, Statement, check  # pylint: disable=wrong-import-position

# Maps each list of extreme cases to two names: the histogram that counts the extreme quantity, and
# the field of a case that holds this quantity.
KEPT = {
    'farthest': ('fp_distance', 'ratio'),
    'earliest': ('early', 'error'),
    'latest': ('after', 'error'),
}


def check_kept(comparison, where, found, tally, answers, kind):
    """Checks the quantities and the queries of the extreme cases that are kept with counters."""
    for name, (of, key) in KEPT.items():
        numbers = tally.enclosed[of]
        expected = (numbers if key == 'ratio' else numbers[numbers.hi > 0]).largest()
        comparison.same('kept', f'{where} number of {name}', len(found[name]), len(expected))
        for i, (case, ends) in enumerate(zip(found[name], expected)):
            own = f'{where} {name} {i}'
            comparison.within('kept', own, case[key], *ends)
            _check_case(comparison, own, case, answers, tally.subject, kind, of, key)


def _check_case(comparison, where, case, answers, subject, kind, of, key):
    """Checks the provenance, the quantity (in the field `key`) and the query of an extreme case.
    Returns the index of the query, or None if the campaign has no such query."""
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


def check_findings(comparison, where, report, answers):
    """Checks that each finding is a query of the campaign, on which the subject fails as recorded."""
    seen = {
        (each['what'], each['subject'], each['signature']): each['seen']
        for each in report['signatures']
    }
    for i, row in enumerate(report['findings']):
        own = f'{where} {i + 1}'
        signature = row['what'], row['subject'], row['signature']
        comparison.same('signatures', f'{own} seen', row['seen'], seen.get(signature))
        place = answers.place(row['kind'], row['provenance'])
        asked = answers.asked.get((row['subject'], row['kind']))
        if place is None or asked is None:
            comparison.fail('provenances', own, row['provenance'], 'a query of the campaign')
        else:
            check_query(comparison, own, row['original'], asked.judged[place])
            _check_failure(comparison, own, row, asked, place)


def _check_failure(comparison, where, found, asked, place):
    """Checks that the subject fails as a finding says, and checks the numbers of the finding."""
    what, after = found['what'], asked.impact.after
    ends = asked.ratios.reported(place) if what == 'refuted-bound' else (0, 0)
    comparison.within('largest ratios', where, found['ratio'], *ends)
    ends = after.reported(place) if what == 'late' else (0, 0)
    comparison.within('times', f'{where} late', found.get('late_by', 0), *ends)
    is_so = {
        'false-negative': asked.false_negative[place],
        'refuted-bound': asked.claims and asked.ratios.hi[place] > 1,
        'late': asked.impact.late[place],
        'committed': asked.impact.committed[place],
        'unsafe-step': asked.impact.unsafe_step[place],
    }
    comparison.same('provenances', f'{where} {what}', bool(is_so.get(what)), True)
    family = found['provenance'].rsplit(':', 2)[0]
    comparison.same('provenances', f'{where} family', found['family'], family)


def check_certificates(comparison, where, report, answers):
    """Checks that the certificate of each finding proves that the subject is wrong about its
    shrunk query."""
    for i, found in enumerate(report['findings']):
        own = f'{where} {i} certificate'
        if found['what'] == 'refuted-bound':
            claimed = answers.asked[found['subject'], found['kind']].claimed
            line = ' '.join(float(number).hex() for number in found['shrunk'])
            comparison.same('certificates', f'{own} bound', found['bound'], claimed(line))
        if found['certificate'] is None:
            if found['what'] != 'fault':  # a fault on a tie may have no proof
                comparison.fail('certificates', own, None, 'a proof')
            continue
        try:
            proven = check(found['certificate'])
        except Refused as reason:
            comparison.fail('certificates', own, reason, 'a proof')
        else:
            comparison.same('certificates', own, proven, _expected(found, proven))


def _expected(found, proven):
    """The statement that the certificate of a finding must prove."""
    count = 6 * VERTICES[found['kind']]
    x, h = tuple(found['shrunk'][:count]), (*found['shrunk'], 0)[count]
    if found['what'] == 'refuted-bound':
        beyond = found['bound'] if h == 0 else math.nextafter(h + found['bound'], math.inf)
        return Statement(found['kind'], x, beyond, 'apart', 0, 1, False, True)
    if found['what'] == 'late':
        to = proven.to if proven.to < found['toi'] else None
        return Statement(found['kind'], x, h, 'meets', 0, to, False, h > 0)
    if found['what'] in ('committed', 'unsafe-step'):
        step, to = tuple(found['step'][:count]), proven.to if proven.to < 1 else None
        return Statement(found['kind'], step, h, 'meets', 0, to, False, h > 0)
    if found['what'] == 'false-negative':
        return Statement(found['kind'], x, h, 'meets', 0, 1, False, h > 0)
    return Statement(found['kind'], x, h, proven.claim, 0, 1, False, proven.strict)

"""Checks the findings of report.json."""

from check_numbers import check_query


def check_findings(comparison, where, report, answers):
    """Checks that each finding is a query of the campaign that fails in the recorded way."""
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
    """Checks a missed collision, a late time or a refuted bound, and its numbers."""
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

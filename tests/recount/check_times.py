"""Checks times of impact in report.json, in the JSON of nearmiss fuzz, and in CSV files."""

from asking import KINDS
from check_numbers import check_histogram, check_quantile, check_query
from enclosed import PRECISION, reported
from tally import Tally


def check_times(comparison, where, found, tally):
    """Checks the counters of times, and the quantiles of their errors."""
    times = tally.times
    for name, value in counters(tally).items():
        comparison.same('times', f'{where} {name}', found[name], value)
    comparison.same('times', f'{where} time_sort', found['time_sort'], times.sort)
    for side, errors in (('early', times.early), ('after', times.after)):
        comparison.within('times', f'{where} {side}', found[f'max_{side}'], *_most(errors))
    for name, part in (('median', 0.5), ('q99', 0.99)):
        bins = times.early.quantile_bins(part)
        check_quantile(
            comparison, f'{where} {name}', found[f'{name}_early'], bins, found['max_early']
        )
    travelled = times.travelled.quantile_bins(0.99)
    check_quantile(
        comparison, f'{where} travelled', found['q99_travelled'], travelled, float('inf')
    )


def counters(tally):
    """The counters of times by name."""
    times = tally.times
    return {
        'times_given': times.given,
        'times_promised': times.promised,
        'late': times.late,
        'stuck': times.stuck,
        'unknown': tally.unknown,
    }


def _most(errors):
    """The range of the largest error."""
    return errors.largest()[0] if len(errors) else (0, 0)


def check_time_histograms(comparison, where, found, times):
    """Checks the histograms of early times, of times after t*, and of distances travelled."""
    for name in ('early', 'after', 'travelled'):
        own = getattr(times, name)
        check_histogram(comparison, f'{where} {name}', found[f'{name}_histogram'], own)


def check_extremes(comparison, where, found, times, answers, subject, kind):
    """Checks the errors and the queries of the earliest and latest times that are kept."""
    for name, side in (('earliest', 'early'), ('latest', 'after')):
        errors = getattr(times, side)
        expected = errors[errors.hi > 0].largest()
        comparison.same('times', f'{where} number of {name}', len(found[name]), len(expected))
        for i, (case, ends) in enumerate(zip(found[name], expected)):
            own = f'{where} {name} {i}'
            comparison.within('times', own, case['error'], *ends)
            _check_case(comparison, own, case, answers, subject, kind, side)


def _check_case(comparison, where, case, answers, subject, kind, side):
    """Checks a time with its provenance, its error, and its query. Returns the index of the query."""
    place = answers.place(kind, case['provenance'])
    impact = answers.asked[subject, kind].impact
    if place is None or not getattr(impact, side).lo[place] >= 0:
        comparison.fail('provenances', where, case['provenance'], f'a time on the side {side}')
        return None
    errors = getattr(impact, side)
    ends = reported(errors.lo[place], errors.hi[place])
    comparison.within('times', f'{where} own', case['error'], *ends)
    check_query(comparison, where, case['query'], answers.asked[subject, kind].judged[place])
    return place


def check_extreme_times(comparison, where, found, report, answers):
    """Checks the earliest and the latest time of each subject and kind."""
    rows = [(each['subject'], each['kind'], each['side']) for each in found]
    expected = [
        (subject, kind, side)
        for subject in answers.subjects
        for kind in KINDS
        for side in ('early', 'after')
        if (getattr(Tally.of(answers, subject, [kind]).times, side).hi > 0).any()
    ]
    comparison.same('names', where, rows, expected)
    for each in found:
        subject, kind, side = each['subject'], each['kind'], each['side']
        own = f'{where} {subject} {kind} {side}'
        most = report['subjects'][subject][kind][f'max_{side}']
        comparison.same('times', own, each['error'], most)
        place = _check_case(comparison, own, each, answers, subject, kind, side)
        if place is not None:
            impact = answers.asked[subject, kind].impact
            least, largest = answers.times[kind].of([answers.asked[subject, kind].judged[place]])
            comparison.within('times', f'{own} t*', each['time'], least[0], largest[0])
            slack = PRECISION * each['error'] + 1e-16
            given = impact.time[place]
            comparison.within('times', f'{own} toi', each['toi'], given - slack, given + slack)


def check_trade_off_times(comparison, where, found, times):
    """Checks the errors of times on both sides together."""
    errors = times.errors
    largest = found['max_time_error']
    comparison.within('times', f'{where} largest', largest, *_most(errors))
    for name, part in (('median', 0.5), ('q99', 0.99)):
        bins = errors.quantile_bins(part)
        check_quantile(comparison, f'{where} {name}', found[f'{name}_time_error'], bins, largest)

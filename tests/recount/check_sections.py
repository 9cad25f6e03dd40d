"""Checks the sections of report.json whose numbers are sums over kinds or families of queries."""

from asking import KINDS
from check_counts import check_rates
from check_numbers import quantile
from comparison import Within
from tally import ON_REQUEST, Tally, classes_of, failures_of

MESHES = KINDS[:2]  # the kinds whose bounds are multiples of B


def check_scorecard(comparison, where, report, answers):
    """Checks the failures of each subject, and its rates over all kinds, in total and class by
    class."""
    rows = report['verdicts']
    comparison.same('names', where, [row['subject'] for row in rows], answers.subjects)
    for row in rows:
        subject = row['subject']
        own = f'{where} {subject}'
        failed = failures_of(row['counts'])
        expected = {'faults': {}, 'failures': failed, 'clean': not set(failed) - ON_REQUEST}
        comparison.entries('verdicts', own, row, expected)
        check_rates(comparison, own, row['counts'], Tally.of(answers, subject, KINDS))
        families = {
            name: each['class']
            for of_kind in report['subjects'][subject].values()
            for name, each in of_kind['families'].items()
        }
        members = classes_of(families)
        comparison.same('names', f'{own} classes', list(row['classes']), list(members))
        for name, of_class in members.items():
            tally = Tally.of(answers, subject, KINDS, of_class)
            check_rates(comparison, f'{own} {name}', row['classes'][name], tally)


def check_trade_offs(comparison, where, report, answers):
    """Checks error against run time: sums over the kinds that all subjects were asked."""
    found = report['error_against_time']['subjects']
    comparison.same('names', where, sorted(found), answers.subjects)
    kinds_of = [set(answers.kinds(subject)) for subject in answers.subjects]
    shared = tuple(kind for kind in KINDS if all(kind in kinds for kinds in kinds_of))
    for subject, each in found.items():
        tally = Tally.of(answers, subject, shared)
        check_rates(comparison, f'{where} {subject}', each, tally)
        errors, most = tally.times.errors, each['max_time_error']
        expected = {
            'max_time_error': Within(*errors.most()),
            'median_time_error': quantile(errors, 0.5, most),
            'q99_time_error': quantile(errors, 0.99, most),
            'sound': not set(failures_of(each)) - ON_REQUEST,
        }
        comparison.entries('trade-offs', f'{where} {subject}', each, expected)


def check_ladder(comparison, where, report, answers):
    """Checks the rates of each rung of the ladder of precisions."""
    for rung in report.get('ladder', {'rungs': []})['rungs']:
        subject = rung['subject']
        check_rates(comparison, f'{where} {subject}', rung, Tally.of(answers, subject, MESHES))

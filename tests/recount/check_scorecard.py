"""Checks the section verdicts of report.json, which has the rows of the page's first table."""

from asking import KINDS
from check_counts import check_rates
from check_sections import places
from query_class import complexity, exoticness
from tally import ON_REQUEST, Tally, classes_of, failures_of


def check_scorecard(comparison, where, report, answers):
    """Checks the rates of each subject over all kinds, in total and class by class, and which
    of its findings is the simplest."""
    rows = report['verdicts']
    comparison.same('names', where, [row['subject'] for row in rows], answers.subjects)
    for row in rows:
        subject = row['subject']
        own = f'{where} {subject}'
        failed = failures_of(row['counts'], row['faults'])
        expected = {
            **places(subject),
            'faults': {},
            'failures': failed,
            'clean': not set(failed) - ON_REQUEST,
            'beyond_contract': subject.endswith(' (beyond contract)'),
        }
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
        _check_simplest(comparison, own, row['finding'], subject, report['findings'])


def _check_simplest(comparison, where, index, subject, findings):
    """Checks that the finding comes first: findings are ordered by the exoticness of the query,
    then misses before late times before other failures, then by simplicity."""
    ranks = {
        i: (
            exoticness(each['class'], each['kind'], each['shrunk']),
            each['what'] != 'false-negative',
            each['what'] != 'late',
            complexity(each['kind'], each['shrunk']),
        )
        for i, each in enumerate(findings)
        if each['subject'] == subject and each['what'] != 'committed'  # that is no failure
    }
    comparison.same('verdicts', f'{where} has a finding', index is not None, bool(ranks))
    if index is None:
        return
    comparison.same('verdicts', f'{where} finding', ranks.get(index), min(ranks.values()))

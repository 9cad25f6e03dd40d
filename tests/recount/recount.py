#!/usr/bin/python3 -B
"""Recomputes a report from single queries, and prints the differences.

It runs a campaign and writes its report. Then it asks the same executable about the same queries
one by one, with nearmiss family, oracle and verdict. From the answers, it recomputes everything
except run times, with NumPy and SciPy. Exit code 0: no difference; 1: a difference; 2: the
executable failed."""

import argparse
import sys
import tempfile
from pathlib import Path

import check_counts
import check_factors
import check_findings
from answers import ask
from asking import KINDS, Nearmiss
from comparison import Comparison
from tally import Tally

REPORT_CHECKS = {
    'report.json': check_counts.check_statistics,
    'verdicts': check_counts.check_scorecard,
    'error_against_time': check_counts.check_trade_offs,
    'ladder': check_counts.check_ladder,
    'findings': check_findings.check_findings,
    'certificates': check_findings.check_certificates,
    'extreme_times': check_findings.check_extreme_times,
    'farthest': check_findings.check_farthest,
    'common_factors': check_factors.check_common_factors,
    'sizes': check_factors.check_sizes,
    'versions': check_counts.check_versions,
}


def counts_of(report):
    """The number of queries of each kind and family, from the oracle's counters in the report."""
    families = report['oracle']['families']
    return {
        kind: {name: own['queries'] for name, own in families.get(kind, {}).items()}
        for kind in KINDS
    }


def check_all(comparison, report, answers):
    """Checks everything in a campaign's output and in its report that can be recomputed."""
    for name, check in REPORT_CHECKS.items():
        comparison.section(check, name, report.json, answers)
    comparison.section(check_counts.check_statistics, 'fuzz.json', report.of_fuzz, answers)


def check_cases(comparison, found, cases, counts, seed):
    """Checks that the campaign has the requested cases and seed."""
    queries = sum(sum(of_kind.values()) for of_kind in counts.values())
    comparison.same('cases', 'sum over families', queries, cases)
    comparison.same('cases', 'cases of the run', found['runs'][0]['cases_done'], cases)
    comparison.same('cases', 'seed of the run', found['runs'][0]['seed'], str(seed))


def note_either_way(comparison, answers):
    """Counts the cases in which two results are allowed, because an enclosure contains a bin's
    border or a distance bound. Also counts all false positives and all times, to show how rare
    these cases are."""
    for subject in answers.subjects:
        tally = Tally.of(answers, subject, KINDS)
        for name, enclosed in tally.enclosed.items():
            first, last = enclosed.bins
            comparison.allow(f'of {name} that may be in either of two bins', (first != last).sum())
        least, most = tally.refuted()
        comparison.allow('distances that may or may not refute a bound', most - least)
        comparison.allow('false positives', tally.false_positives)
        comparison.allow('times', tally.times.given)


def recount(nearmiss, folder, cases, seed, subjects, families):
    """Runs a campaign, recomputes its report, and compares."""
    comparison = Comparison()
    report = nearmiss.report(folder, cases, seed, subjects, families)
    counts = counts_of(report.json)
    check_cases(comparison, report.json, cases, counts, seed)
    kinds_of = {name: tuple(kinds) for name, kinds in report.json['subjects'].items()}
    answers = ask(nearmiss, seed, counts, subjects, kinds_of)
    check_all(comparison, report, answers)
    note_either_way(comparison, answers)
    return comparison, report.json


def main():
    """The command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument('nearmiss', type=Path, help='the executable')
    parser.add_argument(
        '--cases', type=int, default=4000, help='total number of queries (default: %(default)s)'
    )
    parser.add_argument(
        '--seed', type=int, default=1, help='seed of the queries (default: %(default)s)'
    )
    parser.add_argument(
        '--subject',
        default='basic,wang,wang:float,wang:p144',
        help='built-in subjects, and paths of shared objects with one subject, separated by commas',
    )
    parser.add_argument(
        '--family', default='all', help='families, as in nearmiss fuzz (default: %(default)s)'
    )
    options = parser.parse_args()
    try:
        with tempfile.TemporaryDirectory(prefix='nearmiss-recount-') as folder:
            comparison, _ = recount(
                Nearmiss(options.nearmiss.resolve()),
                Path(folder),
                options.cases,
                options.seed,
                options.subject.split(','),
                options.family,
            )
    except (OSError, RuntimeError) as error:
        print(f'recount: {error}', file=sys.stderr)
        return 2
    comparison.print()
    return 1 if comparison.differences else 0


if __name__ == '__main__':
    sys.exit(main())

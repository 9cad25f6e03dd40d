#!/usr/bin/python3 -B
"""Tests that a report agrees with its queries, and that recount notices a wrong report."""

import argparse
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from asking import Nearmiss
from recount import recount

# `basic` misses collisions; `wang` keeps its claim in three scalars; `adaptive` passes queries on to
# more exact stages; the claim of `defect:D2*10` is refuted; `exact` gives exact times. The plug-in
# `sampling` estimates times, and `promises` gives late lower bounds. v1 and v2 export a subject
# with the same name as that of `promises`, so the three count as versions of one subject.
SUBJECTS = 'adaptive,basic,wang,wang:float,wang:p144,defect:D2*10,exact'.split(',')
PLUGINS = ['sampling', 'promises']
VERSIONS = {'v1': 'v1', 'second': 'v2'}  # the plug-in of each subject, by name
CASES, SEED = 1500, 7


def plugin(name):
    """The path of a plug-in."""
    return EXECUTABLE.parent / 'plugins' / f'{name}.so'


class Recount(unittest.TestCase):
    """Campaigns and their reports."""

    def test_a_report_is_what_its_queries_say(self):
        subjects = [
            *SUBJECTS,
            *(str(plugin(name)) for name in PLUGINS),
            *(f'{name}={plugin(of)}' for name, of in VERSIONS.items()),
        ]
        with tempfile.TemporaryDirectory(prefix='nearmiss-recount-') as folder:
            comparison, report = recount(
                Nearmiss(EXECUTABLE), Path(folder), CASES, SEED, subjects, 'all'
            )
        self.assertEqual(comparison.differences, [])
        self.assertGreater(comparison.compared['histogram bins'], 1000)
        self.assertGreater(comparison.compared['certificates'], 20)
        self.assertGreater(comparison.compared['common factors'], 4)
        self.assertGreater(comparison.compared['sizes'], 4)
        subjects = report['error_against_time']['subjects']
        self.assertGreater(subjects['defect:D2*10']['refuted_bounds'], 0)
        self.assertGreater(subjects['basic']['false_negatives'], 0)
        self.assertGreater(subjects['always']['late'], 0)
        sorts = {'exact': 'lower-bound', 'sampling': 'estimate', 'always': 'lower-bound'}
        for name, sort in sorts.items():
            self.assertEqual(subjects[name]['time_sort'], sort)
            self.assertGreater(subjects[name]['times_given'], 0)
        pairs = {(each['before'], each['after']) for each in report['versions']}
        self.assertEqual(pairs, {('always', name) for name in VERSIONS})
        for name in ('fixed', 'broken', 'both', 'neither'):
            self.assertGreater(sum(each[name] for each in report['versions']), 0)
        self.assertTrue(any('broken_since' in each for each in report['findings']))

    def test_a_wrong_report_exits_with_one(self):
        with tempfile.TemporaryDirectory(prefix='nearmiss-recount-') as folder:
            liar = Path(folder) / 'liar'
            liar.write_text(
                f'#!/bin/sh\n"{EXECUTABLE}" "$@" || exit\nif [ "$1" = report ]; then\n'
                '  sed -i \'0,/"positives": /s//&1/\' "$4/report.json"\nfi\n'
            )
            liar.chmod(0o755)
            recount_py = Path(__file__).with_name('recount.py')
            options = '--cases 200 --family uniform,parallel --subject wang'.split()
            done = subprocess.run(
                [sys.executable, recount_py, liar, *options],
                stdout=subprocess.PIPE,
                text=True,
                check=False,
            )
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertIn('DIFFERENCE counters: report.json wang', done.stdout)


if __name__ == '__main__':
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('nearmiss', type=Path, help='the executable')
    EXECUTABLE = parser.parse_args().nearmiss.resolve()
    unittest.main(argv=sys.argv[:1])

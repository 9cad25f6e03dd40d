#!/usr/bin/python3 -B
"""Tests that a report agrees with its queries, and that recount notices changed values."""

import argparse
import copy
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from asking import KINDS, Nearmiss
from changes import changed, found, leaves, pattern, put
from check_baseline import check_baseline
from check_counts import check_statistics
from check_csv import CSV_CHECKS, number
from check_page import check_page
from check_sections import front
from check_text import check_text
from comparison import Comparison
from recount import check_report, recount

# The subjects: one that misses collisions, several with valid claims at various precisions, one
# that passes queries on, one whose claim is refuted, and one with exact times. Two plug-ins give
# times: estimates, and lower bounds that are late. The other plug-ins export the name of the second
# one, so they are its versions.
SUBJECTS = 'adaptive,basic,wang,wang:float,wang:p60,wang:p144,defect:D2*10,exact'.split(',')
PLUGINS = ['sampling', 'promises']
VERSIONS = {'v1': 'v1', 'second': 'v2'}  # the plug-in of each subject, by name
CASES, SEED = 2200, 7

# Values that recount cannot recompute: run times, facts about the machine of a run, the oracle's
# counters of its own work, and whether a query is the simplest. A separate test checks the headline and the texts of
# verdicts. The number of findings and the names of stages are compared with the CSV files.
UNCHECKED = [
    r'^findings_total$',
    r'^stages\b',
    r'\btimes\b',
    r'_ns$',
    r'ns_per_query$',
    r'^(findings|farthest)\b.*\.(time|toi)$',
    r'\.time_over\b',
    r'^runs',
    r'^oracle.*\.(near_bounds|compared.*|missed_by_parity|certified)$',
    r'^findings.*\.(new|is_shrunk|simplest.*|explanation|again|.*file)$',
    r'^farthest.*\.file$',
    r'^oracle\.complaint$',
    r'^headline\b|^verdicts.*\.text$',
]


def plugin(name):
    """The path of a plug-in."""
    return EXECUTABLE.parent / 'plugins' / f'{name}.so'


def _is_larger(leaf, other):
    return isinstance(leaf, (int, float)) and leaf > other


class Recount(unittest.TestCase):
    """One campaign, which all tests use."""

    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix='nearmiss-recount-'))
        subjects = [
            *SUBJECTS,
            *(str(plugin(name)) for name in PLUGINS),
            *(f'{name}={plugin(of)}' for name, of in VERSIONS.items()),
        ]
        cls.comparison, cls.report, cls.answers, cls.units = recount(
            Nearmiss(EXECUTABLE), cls.folder, CASES, SEED, subjects, 'all'
        )
        cls.json = cls.report.json()
        families = (family for kind in KINDS for family in cls.answers.families(kind))
        cls.names = {*cls.answers.subjects, *KINDS, *families}

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    @staticmethod
    def finds(check, where, *arguments):
        """Whether a check finds a difference in the campaign."""
        return found(lambda comparison: comparison.section(check, where, *arguments))

    def finds_in_report(self, path, value):
        """Whether a check finds a difference if report.json has this value at the path."""
        with put(self.json, path, value):
            return found(
                lambda comparison: check_report(
                    comparison, self.json, self.answers, self.units, first=path[0]
                )
            )

    def one_leaf_of_each_pattern(self, value):
        """The path of the largest value of each sort, whose change is the easiest to notice."""
        chosen = {}
        for path, leaf in leaves(value):
            of = pattern(path, self.names)
            if of not in chosen or chosen[of][1] is None or _is_larger(leaf, chosen[of][1]):
                chosen[of] = path, leaf
        return {
            of: each
            for of, each in chosen.items()
            if not any(re.search(name, of) for name in UNCHECKED)
        }

    def test_a_report_is_what_its_queries_say(self):
        self.assertEqual(self.comparison.differences, [])
        self.assertGreater(self.comparison.compared['fits'], 0)
        self.assertGreater(self.comparison.compared['deciders'], 1)
        self.assertGreater(self.comparison.compared['histogram bins'], 1000)
        self.assertGreater(self.comparison.compared['certificates'], 20)
        subjects = self.json['error_against_time']['subjects']
        self.assertGreater(subjects['defect:D2*10']['refuted_bounds'], 0)
        self.assertGreater(subjects['basic']['false_negatives'], 0)
        self.assertGreater(subjects['always']['late'], 0)
        sorts = {'exact': 'lower-bound', 'sampling': 'estimate', 'always': 'lower-bound'}
        for name, sort in sorts.items():
            self.assertEqual(subjects[name]['time_sort'], sort)
            self.assertGreater(subjects[name]['times_given'], 0)
        pairs = {(each['before'], each['after']) for each in self.json['versions']}
        self.assertEqual(pairs, {('always', name) for name in VERSIONS})
        for name in ('fixed', 'broken', 'both', 'neither'):
            self.assertGreater(sum(each[name] for each in self.json['versions']), 0)
        self.assertTrue(any('broken_since' in each for each in self.json['findings']))

    def test_a_change_of_any_sort_of_value_in_report_json_is_found(self):
        chosen = self.one_leaf_of_each_pattern(self.json)
        self.assertGreater(len(chosen), 100)
        for name, (path, leaf) in chosen.items():
            with self.subTest(name, seed=SEED, path=path, value=leaf):
                self.assertTrue(self.finds_in_report(path, changed(leaf)))

    def test_a_change_in_the_json_of_fuzz_is_found(self):
        path = ('subjects', 'wang', 'ee', 'families', 'parallel', 'false_positives')
        with put(self.report.fuzz_json, path, 1000):
            self.assertTrue(
                self.finds(check_statistics, 'changed', self.report.fuzz_json, self.answers)
            )

    def test_a_change_in_any_column_of_a_csv_file_is_found(self):
        for name in CSV_CHECKS:
            for column in (self.report.folder / name).read_text().splitlines()[0].split(','):
                if not re.search(r'_ns$|^shrunk$', column):
                    with self.subTest(name, column=column):
                        self.assertTrue(
                            self.finds_in_csv(name, self.copy_with_change(name, column))
                        )

    def test_a_change_of_a_value_that_is_compared_with_csv_files_is_found(self):
        for path, name in (('findings_total',), 'findings.csv'), (('stages', 0), 'statistics.csv'):
            value = self.json[path[0]] if len(path) == 1 else self.json[path[0]][path[1]]
            with self.subTest(path=path), put(self.json, path, changed(value)):
                self.assertTrue(self.finds_in_csv(name, self.report.folder))

    def finds_in_csv(self, name, folder):
        """Whether a check finds a difference in a CSV file of a folder."""
        return self.finds(CSV_CHECKS[name], name, folder, self.json, self.answers)

    def test_ties_on_a_front(self):
        costs = {'b': (1, 3), 'a': (1, 3), 'slow': (2, 3), 'wrong': (1, 4), 'better': (2, 1)}
        subjects = {name: {'ns_per_query': ns, 'error': e} for name, (ns, e) in costs.items()}
        self.assertEqual(front(subjects, 'error'), ['a', 'better'])

    def copy_with_change(self, name, column):
        """Copies the CSV files, with another value in one column of a row in the middle."""
        folder = self.folder / 'copy'
        folder.mkdir(exist_ok=True)
        for file in self.report.folder.glob('*.csv'):
            shutil.copy(file, folder)
        lines = (folder / name).read_text().splitlines()
        row = lines[len(lines) // 2].split(',')
        i = lines[0].split(',').index(column)
        value = number(row[i])
        row[i] = f'{row[i]} 0x1p+0' if isinstance(value, str) else f'{value * 1.01 + 1:.17g}'
        lines[len(lines) // 2] = ','.join(row)
        (folder / name).write_text('\n'.join(lines) + '\n')
        return folder

    def test_a_change_in_the_data_of_the_page_is_found(self):
        page = (self.report.folder / 'index.html').read_text(encoding='utf-8')
        start = page.index('"false_positives":', page.index('id="report"')) + len(
            '"false_positives":'
        )
        other = page[:start] + '1' + page[start:]
        self.assertTrue(self.finds(check_page, 'index.html', other, self.json))
        with put(self.json, ('histogram_borders', 3), 1.0):
            self.assertTrue(self.finds(check_page, 'index.html', page, self.json))

    def test_a_change_in_any_text_is_found(self):
        for path, leaf in leaves({name: self.json[name] for name in ('headline', 'verdicts')}):
            is_text = path[-1] == 'text' or 'alarms' in path
            if is_text or path[-1] in ('clean', 'subject'):
                others = [changed(leaf)]
                if is_text and re.search(r'\d', leaf):
                    others.append(self.with_other_digit(leaf))
                for other in others:
                    with self.subTest(path=path, other=other), put(self.json, path, other):
                        self.assertTrue(self.finds_in_text(self.report))
        for name in ('fuzz_text', 'report_text'):
            for line in self.checked_lines(getattr(self.report, name)):
                with self.subTest(name, line=line):
                    other = copy.copy(self.report)
                    text = getattr(self.report, name).replace(line, self.with_other_digit(line))
                    setattr(other, name, text)
                    self.assertTrue(self.finds_in_text(other))

    def finds_in_text(self, report):
        """Whether a check finds a difference in the texts of this report."""
        return self.finds(check_text, 'report.json', report, self.json)

    @staticmethod
    def checked_lines(text):
        """The compared lines: verdicts, rows, the oracle's counters, factors, versions, fits."""
        is_checked = re.compile(
            r'(FAIL| ok ) |oracle: |[a-z]\S* +(vt|ee|all|2\^)|[a-z]\S* against | *wang.* goes as '
        )
        return [line for line in text.splitlines() if is_checked.match(line)]

    @staticmethod
    def with_other_digit(line):
        """Changes the last digit of the line's last number that is not a run time."""
        end = line.rindex('  ') if re.search(r'  (vt|ee|2\^\S+) ', line) else len(line)
        if not any(c.isdigit() for c in line):
            return line + ' 1'  # "too few queries"
        i = max(i for i in range(end) if line[i].isdigit())
        return f'{line[:i]}{(int(line[i]) + 1) % 10}{line[i + 1:]}'

    def test_a_wrong_report_exits_with_one(self):
        liar = self.folder / 'liar'
        liar.write_text(
            f'#!/bin/sh\n"{EXECUTABLE}" "$@" || exit\nif [ "$1" = report ]; then\n'
            '  sed -i "3s/,1,/,2,/; 3s/,0,/,1,/" "$4/statistics.csv"\nfi\n'
        )
        liar.chmod(0o755)
        for executable, code in ((EXECUTABLE, 0), (liar, 1)):
            recount_py = Path(__file__).with_name('recount.py')
            options = '--cases 200 --family uniform,parallel --subject wang'.split()
            done = subprocess.run(
                [sys.executable, recount_py, executable, *options],
                stdout=subprocess.PIPE,
                text=True,
                check=False,
            )
            self.assertEqual(done.returncode, code, done.stdout)
            self.assertEqual(
                'DIFFERENCE CSV: statistics.csv' in done.stdout, code == 1, done.stdout
            )


class Baseline(unittest.TestCase):
    """A campaign, and two others as its baseline. In the campaign, a plug-in no longer fails as
    it did, and takes a hundred times as long for one family."""

    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix='nearmiss-recount-'))
        planted = EXECUTABLE.parent / 'plugins' / 'planted_in_wang.so'
        cls.stores = [cls.folder / f'{i}.db' for i in range(3)]
        for seed, store in enumerate(cls.stores):
            defect = {'NEARMISS_SLOWED': '100'} if seed == 2 else {'NEARMISS_PLANTED': '50'}
            families = 'uniform,kilometres,floats,decimals,parallel'
            command = f'fuzz --family {families} --cases 3000 --seed {seed} -q --db {store}'
            cls.run_nearmiss(*command.split(), '--subject', f'wang,{planted}', **defect)
        baseline = [part for each in cls.stores[:2] for part in ('--baseline', each)]
        cls.run_nearmiss('report', cls.stores[2], *baseline, '-o', cls.folder / 'report')
        cls.json = json.loads((cls.folder / 'report' / 'report.json').read_text())['baseline']

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    @staticmethod
    def run_nearmiss(*arguments, **environment):
        """Runs nearmiss in an environment, and returns its output. Exit code 1, for misses, is no
        error here."""
        done = subprocess.run(
            [EXECUTABLE, *arguments],
            env={**os.environ, **environment},
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode in (0, 1), done.stderr
        return done.stdout

    def check(self, comparison):
        check_baseline(comparison, 'baseline', self.json, self.stores[2], self.stores[:2])

    def test_changes_are_what_the_stores_say(self):
        comparison = Comparison()
        self.check(comparison)
        self.assertEqual(comparison.differences, [])
        slower = {(row['family'], row['kind']) for row in self.json['changed_times']}
        self.assertLessEqual({('kilometres', 'vt'), ('kilometres', 'ee')}, slower)
        self.assertGreater(len(self.json['gone_signatures']), 0)

    def test_a_change_of_any_value_is_found(self):
        checked = ('changed_times', 'compared_times', 'campaigns_with_times', 'gone_signatures')
        for path, leaf in leaves({name: self.json[name] for name in checked}):
            if re.search(r'_seen$|_code$|^campaigns$|^fixed$', str(path[-1])):
                continue
            with self.subTest(path=path), put(self.json, path, changed(leaf)):
                self.assertTrue(found(self.check))


if __name__ == '__main__':
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('nearmiss', type=Path, help='the executable')
    EXECUTABLE = parser.parse_args().nearmiss.resolve()
    unittest.main(argv=sys.argv[:1])

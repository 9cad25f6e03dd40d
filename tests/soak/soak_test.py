#!/usr/bin/python3 -B
"""Tests that the soak notices lost cases, changed counts, broken stores and processes left running."""

import argparse
import pathlib
import sqlite3
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import nights
from campaigns import Campaign, Failure
from nights import Machine


class Notices(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix='nearmiss-soak-')
        self.addCleanup(self.folder.cleanup)
        path = pathlib.Path(self.folder.name)
        self.machine = Machine(GIVEN.nearmiss.resolve(), GIVEN.plugins.resolve(), path)
        self.addCleanup(self.machine.clean)
        self.campaign = Campaign(1, 1, 0.2, self.machine)
        self.campaign.options[self.campaign.options.index('--subject') + 1] = 'wang,basic'
        self.campaign.left_out = None
        self.campaign.complete_it()

    def change(self, sql):
        with sqlite3.connect(self.campaign.store) as store:
            self.assertGreater(store.execute(sql).rowcount, 0)

    def test_nothing_where_nothing_is_lost(self):
        self.assertEqual(self.campaign.cases, self.campaign.size)
        self.assertGreater(self.campaign.compare(), 100)

    def test_a_count_that_changed(self):
        true_report = self.campaign.report

        def changed_report(store):
            values = true_report(store)
            path = next(path for path in values if path.endswith('.queries.') and 'basic' in path)
            if store == self.campaign.store:
                values[path] += 1
            return values

        with unittest.mock.patch.object(self.campaign, 'report', changed_report):
            with self.assertRaisesRegex(Failure, 'basic.* is .*, expected '):
                self.campaign.compare()

    def test_a_store_that_changed(self):
        self.change('UPDATE counts SET value = json_set(value, \'$.queries\', 1)')
        with self.assertRaisesRegex(Failure, 'damaged: some rows are not as they were saved'):
            self.campaign.compare()

    def test_lost_cases(self):
        self.change('UPDATE shard SET value = json_set(value, \'$.cases\', 1)')
        with self.assertRaisesRegex(Failure, 'cases were saved, now there are'):
            self.campaign.check_progress()

    def test_a_lost_store(self):
        self.campaign.store.unlink()
        with self.assertRaisesRegex(Failure, 'now there are 0'):
            self.campaign.check_progress()

    def test_a_process_that_is_left(self):
        left = subprocess.Popen(['sleep', '1000'], cwd=self.folder.name)
        self.assertEqual(self.machine.left(), [left.pid])
        with unittest.mock.patch.object(nights, 'PATIENCE', 0):
            with self.assertRaisesRegex(Failure, f'{left.pid}'):
                self.machine.wait_until_alone()
        left.kill()
        left.wait()
        self.machine.wait_until_alone()


if __name__ == '__main__':
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('nearmiss', type=pathlib.Path, help='the executable')
    parser.add_argument('plugins', type=pathlib.Path, help='the folder of plug-ins')
    GIVEN = parser.parse_args()
    unittest.main(argv=sys.argv[:1])

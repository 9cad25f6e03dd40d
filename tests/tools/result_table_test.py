"""Compares what tools/result_table prints with the report that it reads.
Usage: result_table_test.py NEARMISS
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

TABLE = pathlib.Path(__file__).parents[2] / "tools" / "result_table"
NEARMISS = sys.argv.pop()


def run(*command, cwd=None):
    return subprocess.run(command, cwd=cwd, capture_output=True, text=True, check=False)


def cells(line):
    return [cell.strip(" `") for cell in line.strip("|").split("|")]


class ResultTable(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        campaign = (
            "fuzz --subject basic,wang --family uniform,planted,scale --cases 2000 --db a.db"
        )
        run(NEARMISS, *campaign.split(), cwd=cls.folder.name)
        run(NEARMISS, "report", "a.db", "-o", "report", cwd=cls.folder.name)
        report = pathlib.Path(cls.folder.name) / "report"
        cls.report = json.loads((report / "report.json").read_text())
        cls.said = run(TABLE, report)
        totals, queries, _ = cls.said.stdout.split("\n\n")
        rows = [cells(line) for line in totals.splitlines() + queries.splitlines()]
        cls.rows = {tuple(row[:2]): row for row in rows}

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_shares_are_those_of_the_report(self):
        self.assertEqual(self.said.returncode, 0, self.said.stderr)
        head, row = self.rows["subject", "kinds"], self.rows["basic", "vt ee"]
        for of in ("ordinary", "degenerate", "extreme"):
            basic = self.report["subjects"]["basic"]
            counts = [basic[kind]["classes"][of] for kind in ("vt", "ee")]
            missed = sum(each["false_negatives"] for each in counts)
            share = 100 * missed / sum(each["collisions"] for each in counts)
            shown = row[head.index(f"missed, {of}")]
            most = max(0.005, 0.06 * share)
            self.assertAlmostEqual(float(shown.rstrip(" %")), share, delta=most)
            self.assertEqual(shown == "0", missed == 0)

    def test_the_shortest_query_is_one_that_was_found(self):
        self.assertNotIn(("wang", "vt"), self.rows)  # wang misses nothing
        numbers = self.rows["basic", "vt"][2].split()
        shown = [float.fromhex(x) if "x" in x else float(x) for x in numbers]
        of_basic = [each for each in self.report["findings"] if each["subject"] == "basic"]
        self.assertIn(shown, [each["shrunk"] for each in of_basic if each["kind"] == "vt"])

    def test_the_shortest_query_has_its_separation(self):
        with tempfile.TemporaryDirectory() as folder:
            found = {
                "what": "false-negative",
                "subject": "a",
                "kind": "vt",
                "shrunk": [0] * 24 + [0.5],
            }
            report = {"subjects": {}, "findings": [found]}
            (pathlib.Path(folder) / "report.json").write_text(json.dumps(report))
            said = run(TABLE, folder)
        self.assertIn(
            "| `a` | vt | `" + "0 0 0  " * 3 + "0 0 0   " + "0 0 0  " * 3 + "0 0 0   0.5` |",
            said.stdout,
        )

    def test_a_folder_without_a_report_is_refused(self):
        said = run(TABLE, self.folder.name)
        self.assertEqual(said.returncode, 2)
        self.assertIn("expected the report.json of a report", said.stderr)
        self.assertEqual(len(said.stderr.splitlines()), 1)


if __name__ == "__main__":
    unittest.main()

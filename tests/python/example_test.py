"""Runs the example of the Python package.
Usage: example_test.py
"""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

EXAMPLE = pathlib.Path(__file__).resolve().parents[2] / 'tools/python/example.py'


class Example(unittest.TestCase):
    def test_prints_a_table_and_draws_a_picture(self):
        with tempfile.TemporaryDirectory() as folder:
            picture = pathlib.Path(folder) / 'picture.png'
            command = [sys.executable, EXAMPLE, picture]
            run = subprocess.run(command, capture_output=True, text=True, check=True)
            self.assertTrue(picture.read_bytes().startswith(b'\x89PNG'))
        self.assertEqual(run.stderr, '')
        self.assertRegex(run.stdout, r'sampled +20,000 +[\d,]+ +[1-9]')
        self.assertRegex(run.stdout, r'wang +20,000 +[\d,]+ +0 ')
        self.assertTrue(re.search(r'A miss \((vt|ee) ', run.stdout))


if __name__ == '__main__':
    unittest.main()

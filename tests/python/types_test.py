"""Checks the types of the Python package and of a program that uses it, and that the package's stubs
describe its compiled modules.
Usage: types_test.py PYTHON_FOLDER, which contains the package
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

FOLDER = sys.argv.pop()
USER = pathlib.Path(__file__).with_name('user.py')


class Types(unittest.TestCase):
    def check(self, *command):
        with tempfile.TemporaryDirectory() as folder:
            run = subprocess.run(
                [sys.executable, '-m', *command], cwd=folder, capture_output=True, text=True,
                env=os.environ | {'MYPYPATH': f'{FOLDER}:{USER.parent}', 'PYTHONPATH': FOLDER},
            )  # fmt: skip
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)

    def test_of_the_package_and_of_a_program_that_uses_it(self):
        self.check('mypy', '--strict', '-p', 'nearmiss', '-m', USER.stem)

    def test_of_stubs_are_those_of_the_modules(self):
        self.check(
            'mypy.stubtest', 'nearmiss', '--allowlist', USER.with_name('stubtest.allowlist')
        )


if __name__ == '__main__':
    unittest.main()

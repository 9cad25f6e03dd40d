"""Packs the modules of a build folder as a wheel, installs the wheel in a new virtual environment,
and uses it there. No step needs a network.
Usage: wheel_test.py BUILD
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import zipfile

BUILD = pathlib.Path(sys.argv.pop()).resolve()
PACKAGE = pathlib.Path(__file__).resolve().parents[2] / 'tools/python'
USE = '''
import nearmiss
assert nearmiss.__file__.startswith(%r), nearmiss.__file__
x, separation = nearmiss.queries('uniform', 'vt', 1000)
hits = nearmiss.collides('vt', x, separation)
assert 0 < hits.sum() < 1000
assert nearmiss.trial('basic', 500).counts('basic').missed > 0
'''


def run(*command):
    environment = {key: value for key, value in os.environ.items() if key != 'PYTHONPATH'}
    environment['NEARMISS_BUILD'] = str(BUILD)
    done = subprocess.run(command, cwd='/', capture_output=True, text=True, env=environment)
    if done.returncode != 0:
        raise AssertionError(done.stdout + done.stderr)
    return done.stdout


class Wheel(unittest.TestCase):
    def test_works_in_another_environment(self):
        with tempfile.TemporaryDirectory() as folder:
            pip = ('-m', 'pip', '--disable-pip-version-check')
            options = ('--no-index', '--no-deps')
            run(
                sys.executable, *pip, 'wheel', *options, '--no-build-isolation', '-w', folder, str(PACKAGE)
            )  # fmt: skip
            (wheel,) = pathlib.Path(folder).glob('nearmiss-*.whl')
            without = ('--without-pip', '--system-site-packages')  # the system has pip
            run(sys.executable, '-m', 'venv', *without, f'{folder}/venv')
            python = f'{folder}/venv/bin/python'
            run(python, *pip, 'install', *options, str(wheel))
            run(python, '-c', USE % folder)
            names = zipfile.ZipFile(wheel).namelist()
            self.assertTrue({'nearmiss/LICENSE', 'nearmiss/copyright'} <= set(names), names)

    def test_needs_no_package_of_npm(self):
        inputs = run('ninja', '-C', str(BUILD), '-t', 'inputs', 'nearmiss_python')
        self.assertIn('/nearmiss_fuzz.dir/', inputs)
        self.assertNotIn('reports/page/', inputs)


class Modules(unittest.TestCase):
    def test_show_nothing_but_their_initialisation(self):
        for module in (BUILD / 'python/nearmiss').glob('*.so'):
            symbols = run('nm', '-D', '--defined-only', str(module)).split()[2::3]
            self.assertEqual(symbols, ['PyInit_' + module.name.split('.')[0]])

    def test_need_no_library_of_nearmiss(self):
        for module in (BUILD / 'python/nearmiss').glob('*.so'):
            self.assertNotIn('nearmiss.so', run('ldd', str(module)))


if __name__ == '__main__':
    unittest.main()

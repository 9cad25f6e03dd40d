"""Imports the package without some of its modules."""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import nearmiss


class WithoutModules(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.build = pathlib.Path(folder.name).resolve()
        self.package = self.build / 'python/nearmiss'

    def use(self, without):
        """Imports a copy of the package without some files, and starts a trial. Returns the output and the
        last line of the error."""
        package = pathlib.Path(nearmiss.__file__).parent
        ignored = shutil.ignore_patterns(without)
        shutil.copytree(package, self.package, ignore=ignored, dirs_exist_ok=True)
        program = 'import nearmiss; print(nearmiss.__version__); nearmiss.trial("wang")'
        run = subprocess.run(
            [sys.executable, '-c', program], cwd=self.build, capture_output=True, text=True,
            env={'PYTHONPATH': str(self.package.parent)},
        )  # fmt: skip
        return run.stdout.strip(), run.stderr.splitlines()[-1]

    def test_an_import_error_says_why_there_are_no_trials(self):
        message = 'this nearmiss has no trials, because it was built without the component tools'
        expected = nearmiss.__version__, f'ImportError: {message}'
        self.assertEqual(self.use(without='_trial.cpython*'), expected)

    def test_an_import_error_names_the_command_that_builds_them(self):
        said = self.use(without='*.so')[1]
        self.assertTrue(said.startswith('ImportError: nearmiss._interface is not built in '), said)
        self.assertTrue(said.endswith(f' ({sys.executable}): run tools/setup'), said)
        (self.build / 'CMakeCache.txt').touch()
        said = self.use(without='*.so')[1]
        command = f'cmake --build {self.build} --target nearmiss_python'
        self.assertTrue(said.endswith(command), said)

    def test_an_import_error_says_that_they_are_for_another_python(self):
        self.use(without='*.so')
        other = '_interface.cpython-27-x86_64-linux-gnu.so'
        (self.package / other).touch()
        self.assertIn(f'has {other}, which is for another Python', self.use(without='*.so')[1])


if __name__ == '__main__':
    unittest.main()

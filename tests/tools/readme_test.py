"""Runs the commands in README.md and tools/README.md. Compares the output of the first example of
README.md with the output that README.md shows.
Usage: readme_test.py NEARMISS

Changes some options so that a command takes less time. Apart from that, runs each command as it is
printed, in a folder that has the files that the commands name.
"""

import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(sys.argv.pop()).resolve().parent
# Replacements that make a command take less time, or use only subjects that this test has.
SHORTER = (
    (r'--cases \d+', '--cases 1000'),
    (r'--time \w+', '--time 1s'),
    (r'^(nearmiss \w+) .* (--db|-o|--json) (\S+)', r'rm -rf \3; \g<0>'),
    (r'--queries \d+', '--queries 1000 --runs 1'),
    (r'nearmiss power', "nearmiss power --subject 'defect:delta*0' --way uniform --time 1s"),
    (r'^nearmiss paper$', 'nearmiss paper --list'),
    (r'\bsimulate cloths\b', 'simulate cloths --steps 2'),
    (r'\bsim:knot,sim:hair\b', 'sim:hair'),
    (r'tightness --db', 'tightness --tolerance psi --time 1s --db'),
    (r"'./yours.so:KEY=\*'", "'./yours.so:tolerance=*' --cases 500"),
    (
        r'^nearmiss (distance|step) --subject ./yours.so',
        r'nearmiss \1 --subject ./\1s.so --time 1s',
    ),
    (r'pipe:python3 ', f'pipe:{sys.executable} '),
    (',safeccd,tight-inclusion:tolerance=1e-3', ''),  # Debian does not have these
    (r'bench corpus', 'bench few.vt --runs 1'),
    (r'replay corpus$', 'replay few.vt'),
    (r'\$\(nearmiss subjects --peers \| paste -sd,\)', 'bullet'),
)


def commands_of(text):
    """Yields the commands in indented blocks, and the commands in the first column of tables."""
    for line in text.splitlines():
        block = re.match(r'    (?:\$ )?(nearmiss .*)', line)
        row = re.match(r'\| `(nearmiss [^`]*)`', line)
        if block or row:
            yield re.sub(r'  +#.*', '', (block or row)[1]).split('; ')[0]


class Commands(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.make_files()

    @classmethod
    def bash(cls, command):
        sourced = f'source {shlex.quote(str(BUILD / "env"))}; {command}'
        return subprocess.run(
            ['bash', '-c', sourced], cwd=cls.folder, capture_output=True, text=True, check=False
        )

    @classmethod
    def make_files(cls):
        """Makes the files that the commands name."""
        for name in ('yours', 'mine', 'boxes', 'v1', 'v2'):
            shutil.copy(BUILD / 'plugins/sampling.so', cls.folder / f'{name}.so')
        for name in ('distances', 'steps'):
            shutil.copy(BUILD / f'plugins/{name}.so', cls.folder)
        for name in ('corpus', 'tests'):
            (cls.folder / name).symlink_to(ROOT / name)
        (cls.folder / 'start.obj').write_text(
            'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.2 0.2 1\nv 1.2 0.2 1\nv 0.2 1.2 1\nf 1 2 3\nf 4 5 6\n'
        )
        (cls.folder / 'end.obj').write_text(
            (cls.folder / 'start.obj').read_text().replace(' 1\n', ' -1\n')
        )
        # The order matters: a command may use files that earlier commands made.
        for command in (
            'nearmiss family uniform --kind vt --count 50 >file; cp file few.vt',
            f'NEARMISS_RECORD=run.nmq {BUILD}/plugins/recording 100',
            'for i in a.1 b.2 mine.3; do nearmiss fuzz --subject basic,yours=./yours.so --family grazing,uniform --cases 600 --seed ${i#*.} --db ${i%.*}.db; done',
            'nearmiss simulate cloths --steps 2 --subject basic --db c.db',
            'nearmiss report mine.db -o report',
            'cp report/cases/false-negative-basic-001.case file.case',
        ):
            cls.bash(command)

    def test_run_as_they_are_printed(self):
        found = [
            command
            for readme in ('README.md', 'tools/README.md')
            for command in commands_of((ROOT / readme).read_text())
            if 'build/nightly' not in command and '...' not in command
        ]
        self.assertGreater(len(found), 40)
        for command in found:
            short = command
            for pattern, shorter in SHORTER:
                short = re.sub(pattern, shorter, short)
            with self.subTest(command):
                run = self.bash(short)
                self.assertIn(run.returncode, (0, 1), f'{short}\n{run.stderr}')

    def test_the_first_prints_what_it_says(self):
        lines = (ROOT / 'README.md').read_text().split('\n    $ ', 1)[1].split('\n')
        expected = ' '.join(lines[1 : lines.index('')]).split()  # a terminal wraps the lines
        self.assertGreater(len(expected), 50)
        run = self.bash(lines[0])
        self.assertEqual(run.stdout.split()[: len(expected)], expected)


if __name__ == '__main__':
    unittest.main()

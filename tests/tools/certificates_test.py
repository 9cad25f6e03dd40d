"""Tests that both checkers of certificates accept what `nearmiss certify` prints, and agree on
which changed certificates are wrong. Usage: certificates_test.py NEARMISS CHECKER_IN_CPP"""

import json
import random
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

CERTIFICATES = Path(__file__).resolve().parents[2] / 'tools' / 'certificates'
FAMILIES = (
    'uniform planted planted-ulp planar even-roots crossed decimals mixed-scale overflow'
    ' near-separation slow-approach'
).split()
NEARMISS, IN_CPP = sys.argv.pop(1), sys.argv.pop(1)
CHECKERS = [[sys.executable, '-B', str(CERTIFICATES / 'check.py')], [IN_CPP]]


def run(command, text=''):
    return subprocess.run(command, input=text, capture_output=True, text=True)


def certificates(family, kind, *options, first=0, count=10):
    """Runs `nearmiss certify` on `count` queries of a family, from query number `first` on."""
    numbers = [f'--first={first}', f'--count={count}']
    queries = run([NEARMISS, 'family', family, '--kind', kind, *numbers])
    return run([NEARMISS, 'certify', '--kind', kind, *options, '-'], queries.stdout)


def refused(checker, lines):
    """Returns the numbers of the lines that a checker refuses."""
    output = run(checker, ''.join(line + '\n' for line in lines)).stdout.splitlines()
    if not output or not output[-1].startswith('accepted '):
        raise AssertionError(output[-1:])
    return {int(line.split(':')[1]) for line in output[:-1]}


def set_key(key, value):
    return lambda certificate: {**certificate, key: value}


def without(key):
    return lambda certificate: {k: v for k, v in certificate.items() if k != key}


def in_list(key, change):
    """Returns a function that changes the list `key` of a certificate that has this list."""
    return lambda c: {**c, key: change(list(c[key]))} if key in c else c


CHANGES = [
    *(without(key) for key in 'kind x h claim from to times normals at weights bracket'.split()),
    *(set_key('claim', value) for value in ('apart', 'meets', 'none', None, 1)),
    *(set_key('kind', value) for value in ('vt', 'ee', 'vv', 've', 'VT', '')),
    *(
        set_key('h', value)
        for value in '-1 1 1e3 nan 1/3 1/0 0x1p-999999999 0x1p00001 0x0p1090 0x0p01074'.split()
        + [0]
    ),
    *(set_key('from', value) for value in ('1/2', '-1', '2')),
    *(set_key('to', value) for value in ('1/2', '0', '2')),
    *(set_key('open', value) for value in (True, False, 'true')),
    *(set_key('strict', value) for value in (True, False)),
    set_key('more', '1'),
    set_key('edge', ['0', '1', '2']),
    *(
        in_list('x', change)
        for change in (lambda x: x[1:], lambda x: x[3:] + x[:3], lambda x: x[::-1])
    ),
    *(
        in_list('times', change)
        for change in (lambda t: t[:-1], lambda t: t[::-1], lambda t: t * 20000)
    ),
    *(
        in_list('normals', change)
        for change in (lambda n: n[1:], lambda n: [], lambda n: n[:1] * len(n))
    ),
    *(
        in_list('weights', change)
        for change in (lambda w: [], lambda w: w[::-1], lambda w: ['1'] * 4)
    ),
    in_list('bracket', lambda ends: ends[::-1]),
]
BROKEN = [
    '{"claim":null,"why":"a\\nb"}',
    '{"kind":"vt","kind":"vt"}',
    '[' * 100000 + ']' * 100000,
    '{"kind":' * 5000 + '1' + '}' * 5000,
]


def with_one_character_changed(line, dice):
    at = dice.randrange(len(line))
    return line[:at] + dice.choice('0123456789abcdefpx-/') + line[at + 1 :]


class Certificates(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.lines = [
            line
            for family in FAMILIES
            for kind in ('vt', 'ee')
            for line in certificates(family, kind, '--toi', '--distance').stdout.splitlines()
        ]

    def test_both_checkers_accept_what_certify_prints(self):
        self.assertGreater(len(self.lines), 500)
        for checker in CHECKERS:
            with self.subTest(checker=checker):
                self.assertEqual(refused(checker, self.lines), set())

    def test_they_agree_about_changed_ones(self):
        dice = random.Random(1)
        changed = [
            json.dumps(change(json.loads(line))) for line in self.lines[::11] for change in CHANGES
        ]
        changed += [
            with_one_character_changed(line, dice) for line in self.lines[::2] for _ in range(5)
        ]
        changed = [line for line in changed + BROKEN if is_object(line)]
        in_python, in_cpp = (refused(checker, changed) for checker in CHECKERS)
        self.assertEqual([changed[i - 1][:300] for i in in_python ^ in_cpp], [])
        self.assertGreater(len(in_python), len(changed) / 2)
        self.assertLess(len(in_python), len(changed))

    def test_exit_codes(self):
        good = self.lines[0] + '\n'
        for checker in CHECKERS:
            for text, code in [
                (good, 0),
                (good.replace('"to":"1"', '"to":"2"'), 1),
                ('{"kind":\n', 2),
                ('', 2),
            ]:
                with self.subTest(checker=checker, code=code):
                    self.assertEqual(run([*checker, '-q', '-'], text).returncode, code)
            for arguments in (['/absent'], ['--nonsense']):
                self.assertEqual(run([*checker, *arguments]).returncode, 2)
            self.assertEqual(run([*checker, '--help']).returncode, 0)
            full = run(['sh', '-c', 'exec "$@" >/dev/full', 'sh', *checker], good)
            self.assertEqual((full.returncode, full.stderr.count('\n')), (2, 1))

    def test_no_more_is_read_than_a_line_may_have(self):
        longest = self.lines[0].ljust(1 << 19)
        limited = ['sh', '-c', 'ulimit -v 1000000; exec "$@"', 'sh']
        for checker in CHECKERS:
            with self.subTest(checker=checker):
                self.assertEqual(run([*checker, '-q'], f'{longest}\n{longest}').returncode, 0)
                self.assertEqual(run([*checker, '-q'], longest + ' ').returncode, 2)
                endless = run([*limited, *checker, '/dev/zero'])
                self.assertEqual(endless.returncode, 2)
                self.assertIn('/dev/zero:1: ', endless.stderr)

    def test_messages_name_file_and_line(self):
        with tempfile.TemporaryDirectory() as folder:
            names = [str(Path(folder, name)) for name in ('one', 'two')]
            good, bad = self.lines[0], self.lines[0].replace('"claim":', '"claims":')
            for name in names:
                Path(name).write_text(f'{good}\n{bad}\n')
            for checker in CHECKERS:
                output = run([*checker, *names]).stdout.splitlines()
                self.assertTrue(output[-2].startswith(f'{names[1]}:2: refused: '), output)
                self.assertEqual(output[-1], 'accepted 2 of 4')
                error = run([*checker, names[0], '-'], '{\n').stderr
                self.assertTrue(error.startswith('check: -:1: '), error)

    def test_a_touch_at_an_irrational_time_has_none(self):
        query = '0 -.5 1 -1 0 0 1 0 0 0 0 -1000  -1 -.5 1 -1 -1 0 1 1 0 -1 -.5 1'
        command = [NEARMISS, 'certify', '--kind=vt', '--separation=1', '--toi', '-']
        missing = run(command, query)
        self.assertEqual(missing.returncode, 1)
        self.assertIn('"claim":null,"why":"no proof was found: perhaps', missing.stdout)
        for checker in CHECKERS:
            self.assertEqual(refused(checker, missing.stdout.splitlines()), {2})

    def test_a_tie_that_lasts_has_one(self):
        self.assertEqual(certificates('tied-separation', 'vt', first=194, count=1).returncode, 0)


def is_object(line):
    """Whether a line is a JSON object that the checkers can read. The checkers stop at other
    lines."""
    if len(line) > 1 << 19:
        return False
    try:
        return line.isascii() and '\\' not in line and isinstance(json.loads(line), dict)
    except (RecursionError, ValueError):
        return False


if __name__ == '__main__':
    unittest.main()

"""Lists the tests as steps, and measures how long each step takes without a mutant."""

import hashlib
import json
import re
import tempfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path

from copied import BUILD, COPY, before
from processes import run
from sources import WORK

BASELINE = WORK / 'baseline.json'
EXECUTABLES = ['ccd', 'corpus', 'reports', 'oracle', 'fuzz', 'tools', 'proofs']
MOST_SECONDS = 150  # tests that take longer without a mutant are left out
MEMORY = 6 << 30  # bytes of address space for each process


@dataclass
class Step:
    """A GoogleTest of the executable `group`; or the command `group`, with the argument `test`
    unless `test` is empty."""

    group: str
    test: str
    cpu: float = 0
    wall: float = 0
    fine: bool = True

    @property
    def name(self):
        return f'{self.group}.{self.test}' if self.test else self.group


def executable(group):
    """The executable of a group of GoogleTests."""
    folder = BUILD / 'tests' / 'proofs' if group == 'proofs' else BUILD / 'tests'
    return folder / f'{group}_tests'


def commands():
    """The commands of the groups of tests that are not GoogleTests."""
    recount = COPY / 'tests/recount/recount_test.py'
    return {
        'recount': ['/usr/bin/python3', '-B', recount, BUILD / 'nearmiss'],
    }


def run_tests(group, tests, seconds, layer=None):
    """Runs tests of a group until one fails. If `layer` is given, the tests run with its mutant.
    The tests cannot affect other processes. Removes the tests' files afterwards."""
    with tempfile.TemporaryDirectory(prefix='test-', dir=WORK) as folder:
        if group in commands():
            words = [*commands()[group], *filter(None, tests)]
        else:
            flags = Path(folder) / 'flags'
            flags.write_text(f'--gtest_filter={":".join(tests)}\n')
            words = [executable(group), '--gtest_fail_fast', f'--gtest_flagfile={flags}']
        return run(words, BUILD, {'TMPDIR': folder}, seconds, before=before(layer, MEMORY))


def tests_of(group):
    """The names of the tests of an executable, except disabled ones."""
    listed = run([executable(group), '--gtest_list_tests'], cwd=BUILD).output
    suite, names = '', []
    for line in listed.splitlines():
        word = line.split('#')[0].strip()
        if line.startswith('  ') and 'DISABLED_' not in suite + word:
            names.append(suite + word)
        elif re.match(r'\S+\.(\s|$)', line):
            suite = word
    return names


def steps_of(group):
    """The steps of a group."""
    return [Step(group, test) for test in (tests_of(group) if group in EXECUTABLES else [''])]


def all_steps():
    return [step for group in [*EXECUTABLES, *commands()] for step in steps_of(group)]


def measured(step):
    """Runs a step without a mutant. Stores in the step how long it took and whether it passed.
    Returns the step."""
    ended = run_tests(step.group, [step.test], MOST_SECONDS)
    step.cpu, step.wall = round(ended.cpu, 3), round(ended.wall, 3)
    step.fine = ended.code == 0 and not ended.late
    return step


def state():
    """A hash of those executables and plug-ins that the tests use and that are built."""
    digest = hashlib.sha256()
    files = [executable(group) for group in EXECUTABLES]
    files += [BUILD / 'nearmiss', BUILD / 'nearmiss-worker']
    for file in filter(Path.exists, files + sorted((BUILD / 'plugins').glob('*'))):
        digest.update(file.read_bytes())
    return digest.hexdigest()


def baseline(steps, jobs, say):
    """Returns the steps with their times. Measures only those times that no earlier call has saved for
    this build. Prints which steps fail or take too long without a mutant."""
    built = state()
    kept = json.loads(BASELINE.read_text()) if BASELINE.exists() else {}
    known = kept.get('steps', {}) if kept.get('built') == built else {}
    todo = [step for step in steps if step.name not in known]
    with ThreadPoolExecutor(jobs) as pool:
        done = pool.map(measured, todo)
        for count, step in enumerate(done, 1):
            known[step.name] = asdict(step)
            if count % 50 == 0 or step.cpu > 5 or count == len(todo):
                say(f'without a mutant: {count} of {len(todo)} tests')
                BASELINE.write_text(json.dumps({'built': built, 'steps': known}))
    found = [Step(**known[step.name]) for step in steps]
    for step in found:
        if not step.fine:
            say(f'left out, because it fails or takes too long without a mutant: {step.name}')
    return found

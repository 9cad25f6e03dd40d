"""Campaigns that take several runs. Checks that their results are the same as in a single run."""

import json
import pathlib
import random
import shlex
import shutil
import sqlite3

FAMILIES = ['uniform', 'sliver', 'parallel', 'needle', 'stiff', 'near-underflow-planted']
SWEEPS = ['stiff', 'needle', 'aspect', 'offset']

# Plug-ins that misbehave at queries with certain coordinates, and the names of their subjects.
CHOSEN_BY_QUERY = {
    'crash': 'misbehaving',
    'leave': 'misbehaving',
    'eat': 'misbehaving',
    'fail': 'misbehaving',
    'print': 'misbehaving',
    'throwing': 'throwing',
}
# Plug-ins whose faults depend on the clock, or on the queries that the same process was asked
# before.
CHOSEN_BY_CHANCE = {
    'hang': 'misbehaving',
    'sleep': 'misbehaving',
    'intruding_write': 'intruding',
    'intruding_truncate': 'intruding',
    'intruding_close': 'intruding',
    'intruding_move_on': 'intruding',
    'intruding_fork': 'intruding',
}
# Values of a report that depend on the clock.
TIMES = {'started', 'seconds', 'ns_per_query', 'times', 'front_by_distance', 'front_by_rate'}


class Failure(Exception):
    """A check has failed."""


def without(value, subject):
    """A report without times. If `subject` is not None, leaves out everything about this subject,
    too."""
    if isinstance(value, dict):
        return {
            key: without(each, subject)
            for key, each in value.items()
            if key not in TIMES and key != subject
        }
    if isinstance(value, list):
        return [
            without(each, subject)
            for each in value
            if not (isinstance(each, dict) and subject and each.get('subject') == subject)
        ]
    return value


def leaves(value):
    """The values in a report, by their paths, such as 'subjects.0.name.'."""
    if isinstance(value, (dict, list)):
        pairs = value.items() if isinstance(value, dict) else enumerate(value)
        return {
            f'{key}.{path}': leaf for key, each in pairs for path, leaf in leaves(each).items()
        }
    return {'': value}


class Campaign:
    """A campaign, and its store."""

    def __init__(self, number, seed, seconds, machine):
        draw = random.Random(f'{seed} campaign {number}')
        self.number, self.machine = number, machine
        plugin = draw.choice([*CHOSEN_BY_QUERY, *CHOSEN_BY_CHANCE])
        rate = 200 if plugin in CHOSEN_BY_CHANCE else 2000  # 200: each query may time out
        self.size = int(draw.uniform(0.2, 1) * rate * seconds)
        self.left_out = CHOSEN_BY_CHANCE.get(plugin)
        self.options = ['--cases', str(self.size), '--seed', str(draw.randrange(1 << 32))]
        self.options += ['--subject', f'wang,basic,{machine.plugins / plugin}.so']
        # If the plug-in's results are compared, none of its queries may exceed the time limit,
        # even on a busy machine.
        limit = '100ms' if plugin in CHOSEN_BY_CHANCE else '30s'
        self.options += ['--query-time', limit, '--query-memory', '32M', '--compare', '64']
        if draw.random() < 0.25:
            self.options += ['--sweep', ','.join(draw.sample(SWEEPS, 2)), '--steps', '3']
        else:
            self.options += ['--family', ','.join(draw.sample(FAMILIES, 3))]
        self.store = machine.folder / f'{number}.db'
        self.cases = self.faults = 0
        self.complete = False

    def __str__(self):
        return f'campaign {self.number}: nearmiss fuzz {shlex.join(self.options)}'

    def command(self, store, jobs):
        how = ['--jobs', str(jobs), '--db', str(store), '--quiet', '--resume']
        return ['fuzz', *self.options, *how]

    def exists(self):
        return self.store.exists()

    def files(self, store=None):
        """The existing files of a store."""
        store = store or self.store
        names = [f'{store.name}{end}' for end in ('', '-wal', '-shm', '-journal', '.lock')]
        return [store.with_name(name) for name in names if store.with_name(name).exists()]

    def check_progress(self):
        """Copies the store, and checks that the copy is sound and has all cases that were saved
        before."""
        copy = self.machine.folder / 'copy'
        shutil.rmtree(copy, ignore_errors=True)
        copy.mkdir()
        for file in self.files():
            shutil.copy2(file, copy)
        cases = self.read(copy / self.store.name)
        if cases < self.cases:
            raise Failure(f'{self}: {self.cases} cases were saved, now there are {cases}')
        self.cases = cases

    def read(self, store):
        """The number of cases in a store; 0 if the run ended before its first save."""
        if not store.exists():
            return 0
        with sqlite3.connect(store) as database:
            sound = database.execute('PRAGMA integrity_check').fetchone()[0]
            if sound != 'ok':
                raise Failure(f'{self}: {store.name} is broken: {sound}')
            tables = {name for name, in database.execute('SELECT name FROM sqlite_master')}
            row = None
            if 'shard' in tables:
                row = database.execute('SELECT value FROM shard').fetchone()
        shard = json.loads(row[0]) if row else {'cases': 0, 'complete': False}
        self.complete = shard['complete']
        return shard['cases']

    def complete_it(self):
        """Runs the rest of the campaign without disturbance."""
        self.machine.call(self.command(self.store, 2), self)
        self.check_progress()
        if not self.complete:
            raise Failure(f'{self}: it ends by itself, but is not complete')

    def compare(self):
        """Compares the report with that of an undisturbed run. Returns how many values were compared."""
        undisturbed = self.machine.folder / 'undisturbed.db'
        self.machine.call(self.command(undisturbed, 2), self)
        expected, found = (self.report(store) for store in (undisturbed, self.store))
        for path in sorted({*expected, *found}):
            if expected.get(path) != found.get(path):
                raise Failure(
                    f'{self}: {path} is {found.get(path)}, expected {expected.get(path)}'
                )
        for file in [*self.files(), *self.files(undisturbed)]:
            file.unlink()
        return len(found)

    def report(self, store):
        folder = self.machine.folder / f'{store.stem}.report'
        self.machine.call(['report', str(store), '-o', str(folder)], self)
        report = json.loads(pathlib.Path(folder / 'report.json').read_text(encoding='utf-8'))
        shutil.rmtree(folder)
        self.faults = sum(each['seen'] for each in report['signatures'] if each['what'] == 'fault')
        for verdict in report['verdicts']:  # the index depends on what is left out
            place = verdict.pop('finding')
            verdict['shown'] = None if place is None else report['findings'][place]['provenance']
        if self.left_out:
            del report['headline'], report['findings_total']  # texts and sums over all subjects
        return leaves(without(report, self.left_out))

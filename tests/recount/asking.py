"""Runs the executable, for campaigns and reports, and for single queries."""

import json
import math
import subprocess
from dataclasses import dataclass

import numpy as np

VERTICES = {'vt': 4, 'ee': 4, 'vv': 2, 've': 3}  # of both primitives together
KINDS = tuple(VERTICES)


def coordinates(kind, line):
    """The coordinates in the line that holds a query, as words."""
    return line.split()[: 6 * VERTICES[kind]]


def separation(kind, line):
    """The separation in the line of a query; 0 if the line has no separation."""
    words = line.split()[6 * VERTICES[kind] :]
    return float.fromhex(words[0]) if words else 0.0


def with_separation(kind, line, h):
    """The query with another separation."""
    return ' '.join([*coordinates(kind, line), float(h).hex()])


@dataclass
class Report:
    """The JSON of a campaign and of its report."""

    of_fuzz: dict
    json: dict


class Nearmiss:
    """Calls of the executable."""

    def __init__(self, path):
        self.path = str(path)

    def run(self, *arguments, text=None, codes=(0,)):
        """Returns the standard output. Raises an error if the exit code is not in `codes`."""
        done = subprocess.run(
            [self.path, *map(str, arguments)],
            input=text,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )
        if done.returncode not in codes:
            command = ' '.join(map(str, arguments))
            raise RuntimeError(f'nearmiss {command}: exit code {done.returncode}: {done.stderr}')
        return done.stdout

    def report(self, folder, cases, seed, subjects, families):
        """Runs a campaign and writes its report into folder/report. Exit code 1, for misses, is no
        error here."""
        store, fuzz_json = folder / 'campaign.db', folder / 'fuzz.json'
        command = f'fuzz --family {families} --cases {cases} --seed {seed} -q'
        options = '--subject', ','.join(subjects), '--db', store, '--json', fuzz_json
        self.run(*command.split(), *options, codes=(0, 1))
        self.run('report', store, '-o', folder / 'report', codes=(0, 1))
        files = fuzz_json, folder / 'report' / 'report.json'
        return Report(*(json.loads(file.read_text()) for file in files))

    def family(self, name, seed, kind, count):
        """The first `count` queries of one kind in a family, as lines."""
        options = '--seed', seed, '--kind', kind, '--count', count
        return self.run('family', name, *options).splitlines()

    def factors(self, name, seed, kind, count):
        """The values of the factors of each query that family() returns, such as 'edge=2^-9'."""
        options = '--seed', seed, '--kind', kind, '--count', count
        return [
            line.split() for line in self.run('family', name, '--factors', *options).splitlines()
        ]

    def within(self, kind, queries):
        """Whether the distance of each query's primitives becomes as small as the separation."""
        lines = self._ask('oracle', kind, queries)
        return np.array([line == '1' for line in lines], dtype=bool)

    def collisions(self, kind, queries):
        """Whether each query is a collision. A tie is no collision: its smallest distance is
        exactly the separation, so its certificate is missing or not strict."""
        found = self.within(kind, queries)
        some = [i for i in np.flatnonzero(found) if separation(kind, queries[i]) > 0]
        nearer = [
            with_separation(kind, queries[i], math.nextafter(separation(kind, queries[i]), 0))
            for i in some
        ]
        unsure = [i for i, is_nearer in zip(some, self.within(kind, nearer)) if not is_nearer]
        lines = self._ask('certify', kind, [queries[i] for i in unsure], codes=(0, 1))
        for i, certificate in zip(unsure, map(json.loads, lines)):
            found[i] = certificate['claim'] == 'meets' and certificate.get('strict', False)
        return found

    def distances(self, kind, queries):
        """Lower and upper ends of the smallest distances, in the queries' unit of length."""
        return self._ends(kind, queries, '--distance')

    def times(self, kind, queries):
        """Lower and upper ends of the earliest times: equal or neighbouring doubles."""
        return self._ends(kind, queries, '--toi')

    def _ends(self, kind, queries, of):
        lines = self._ask('oracle', kind, queries, of)
        ends = [[float.fromhex(number) for number in line.split()[1:]] for line in lines]
        return np.array(ends, dtype=float).reshape(-1, 2).T

    def plugin(self, path):
        """The name and the description of the only subject in a shared object."""
        text = self.run('subjects', path)
        return text.split()[0], text

    def verdicts(self, kind, queries, subject):
        """The answers of a subject."""
        lines = self._ask(
            'verdict', kind, queries, '--subject', subject, '--distance-bound', '--rounded'
        )
        return Verdicts.parsed(lines)

    def _ask(self, command, kind, queries, *options, codes=(0,)):
        if not queries:
            return []
        text = '\n'.join(queries) + '\n'
        output = self.run(command, '--kind', kind, *options, '-', text=text, codes=codes)
        lines = output.splitlines()
        if len(lines) != len(queries):
            raise RuntimeError(
                f'nearmiss {command}: found {len(lines)} answers, expected {len(queries)}'
            )
        return lines


@dataclass
class Verdicts:
    """A subject's answers. Arrays have one element for each query."""

    hit: np.ndarray  # bool
    stage: np.ndarray  # names of the accepting stages; 'none' if the subject reports no collision
    time: np.ndarray  # NaN if the subject reports no collision, or gives no time
    bound: np.ndarray  # bound on distances of false positives, in the queries' unit of length
    claims: bool  # whether the subject claims `bound`
    rounded: list  # the queries by which the subject is judged, as lines

    @classmethod
    def parsed(cls, lines):
        hit, stage, time, bound, whose, rounded = [], [], [], [], set(), []
        for line in lines:
            is_hit = line.startswith('1 ')
            words = line.split(' ', 5 if is_hit else 3)
            hit.append(is_hit)
            stage.append(words[1] if is_hit else 'none')
            time.append(float.fromhex(words[2]) if is_hit else np.nan)
            bound.append(float.fromhex(words[-3]))
            whose.add(words[-2])
            rounded.append(words[-1])
        return cls(
            np.array(hit, dtype=bool),
            np.array(stage),
            np.array(time),
            np.array(bound),
            whose == {'claimed'},
            rounded,
        )

"""Checks what a report says about run times and ways to fail since its baseline, from the stores."""

import json
import math
import sqlite3
from collections import defaultdict
from dataclasses import dataclass, field
from statistics import mean, stdev

from scipy.stats import hypergeom, t

RISK = 1e-3
FEWEST_FAMILIES = 8
FAMILY, SUBJECT, MACHINE = 0.04, 0.08, 0.15
DEGREES_OF_FREEDOM = 20
ALL = 'all families'


@dataclass
class Night:
    """What a store says about a campaign."""

    times: dict = field(default_factory=dict)
    counts: dict = field(default_factory=dict)
    seen: dict = field(default_factory=dict)
    processors: set = field(default_factory=set)
    facts: list = field(default_factory=list)

    @classmethod
    def of(cls, store):
        """Reads a store."""
        night = cls()
        database = sqlite3.connect(f'file:{store}?mode=ro', uri=True)
        database.row_factory = sqlite3.Row
        for row in database.execute('SELECT * FROM counts'):
            key = row['subject'], row['kind'], row['family']
            night.counts[key] = dict(row)
            batches = json.loads(row['times_batches'])
            if batches:
                night.times[key] = math.log(median_ns(batches[0][2]))
        for row in database.execute('SELECT * FROM seen'):
            night.seen[row['what'], row['subject'], row['signature']] = row['times']
        for (environment,) in database.execute('SELECT environment FROM shard'):
            night.processors.add(json.loads(environment).get('cpu'))
        night.facts = [json.loads(info) for (info,) in database.execute('SELECT info FROM run')]
        database.close()
        return night


def median_ns(bins):
    """The median of times in ps, each with its number of queries."""
    queries = 0
    for time, count in sorted(bins):
        queries += count
        if 2 * queries >= sum(count for _, count in bins):
            return time / 1000
    raise ValueError('no query was timed')


def median(values):
    """The median; between two, the one nearer to 0."""
    values = sorted(values)
    return min(values[(len(values) - 1) // 2], values[len(values) // 2], key=abs)


def is_random(family):
    return not family.endswith('/') and not family.startswith('scene:')

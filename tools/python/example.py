"""Puts a naive CCD on trial, and draws what it misses and how near its queries are.

Usage: PYTHONPATH=build/release/python python3 tools/python/example.py PICTURE.png
"""

import sys

import matplotlib

matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np

import nearmiss

# %% A CCD in a few lines. It looks at 17 times of the step, and reports a pair if, from one time to the next,
# the four vertices change their orientation and the boxes of the primitives meet at one of the two times.


def sampled(kind, x, separation):
    t = np.linspace(0, 1, 17)[:, np.newaxis, np.newaxis, np.newaxis]
    with np.errstate(all='ignore'):  # some queries have coordinates near the largest double
        moving = (1 - t) * x[:, 0] + t * x[:, 1]  # time, query, vertex, coordinate
        a, b, c = (moving[:, :, i] - moving[:, :, 0] for i in (1, 2, 3))
        volume = (a * np.cross(b, c)).sum(-1)
        turns = volume[:-1] * volume[1:] <= 0
    first, second = np.split(moving, [1 if kind == 'vt' else 2], axis=2)
    meet = ((first.max(2) >= second.min(2)) & (second.max(2) >= first.min(2))).all(-1)
    return (turns & (meet[:-1] | meet[1:])).any(0)


# %% The trial: the same hard queries for this CCD and for the failure-proof one of Wang.
result = nearmiss.trial([sampled, 'wang'], cases=20000, shrunk=0)
print(result)
of_family = {family: result.counts('sampled', family=family) for family in result.families}
missed = {family: each.missed / max(each.collisions, 1) for family, each in of_family.items()}
worst = sorted(missed, key=missed.__getitem__)[-20:]

# %% The simplest of the missed queries in the ordinary family `stiff`.
findings = nearmiss.trial(sampled, 2000, ['stiff']).findings
shrunk = findings[findings.is_shrunk]
simplest = np.argmax((shrunk.shrunk == 0).sum((1, 2, 3)))
print(f'\nA miss ({shrunk.signature[simplest]}), at t = 0 and at t = 1:')
print(shrunk.shrunk[simplest])

# %% How far from contact are queries without a collision, and those among them that are reported? Wang's CCD
# promises a bound.
x, _ = nearmiss.queries('sliver', 'ee', 50000)
apart = x[~nearmiss.collides('ee', x)]
distance = nearmiss.smallest_distance('ee', apart).lo / nearmiss.wang_bound('ee', apart)
reported = {
    'all': np.ones(len(apart), bool),
    'reported by sampled': sampled('ee', apart, None),
    'reported by wang': nearmiss.wang('ee', apart),
}

# %% The picture.
figure, (left, right) = plt.subplots(1, 2, figsize=(11, 5), layout='constrained')
left.barh(worst, [100 * missed[family] for family in worst], color='firebrick')
left.set(xlabel='collisions missed, %', title='What sampled misses, by family')
bins = np.geomspace(1e-6, 1e2, 49)
for (label, mask), color in zip(reported.items(), ('black', 'firebrick', 'steelblue')):
    label = f'{label}: {mask.sum():,}'
    right.hist(distance[mask], bins, histtype='step', color=color, linewidth=1.5, label=label)
right.axvline(1, color='grey', linestyle='--', linewidth=1)
right.set(xscale='log', xlabel="smallest distance / wang's bound", ylabel='queries')
right.set_title('Slivers that do not collide, by distance')
right.legend(loc='upper left')
figure.savefig(sys.argv[1])

"""Parses names of subjects: algorithm, scalar, and the claimed distance bound in units of B."""

import math

import numpy as np

ALGORITHMS = ('wang', 'wang-tight')  # algorithms of the ladder of precisions
EPSILONS = {'': -52, 'double': -52, 'float': -23, 'dd': -102}
AS_WANG = (
    'basic',
    'basic-plain',
    'wang',
    'wang-scalar',
    'wang-eps',
    'wang-no-planes',
    'wang-plain',
)


def exponent(scalar):
    """The binary exponent of a scalar's machine epsilon. None if the name is not a scalar."""
    if scalar.startswith('p') and scalar[1:].isdigit():
        return 1 - int(scalar[1:])
    return EPSILONS.get(scalar)


def place(subject):
    """The algorithm, the scalar and the exponent of epsilon, by a subject's name. If the name
    has no scalar, the algorithm is the whole name."""
    algorithm, _, scalar = subject.partition(':')
    if exponent(scalar) is None:
        return subject, 'double', EPSILONS['double']
    return algorithm, scalar or 'double', exponent(scalar)


def paper_bound(epsilon):
    """The largest distance of a false positive by the paper, in units of B.

    It is sqrt(D^2 + 2 delta) with D^2 = 1678 eps^(1/2) and delta = 311 eps (sections 4.2 and
    4.5)."""
    return math.sqrt(1678 * math.sqrt(epsilon) + 2 * 311 * epsilon)


class Units:
    """The distance bounds of subjects in units of B."""

    def __init__(self, nearmiss, seed):
        self._nearmiss, self._seed, self._known = nearmiss, seed, {}

    def claimed(self, subject):
        """The bound that a subject claims. None if it claims no bound proportional to B.

        It is computed as wang's bound, times the quotient of the subject's and wang's bounds for
        the same queries."""
        if subject not in self._known:
            self._known[subject] = self._measured(subject)
        return self._known[subject]

    def of_distances(self, subject):
        """The bound by which a subject's distances are divided: its claim, or wang's bound
        for `basic` and `bridson`."""
        algorithm, _, _ = place(subject)
        if '@' not in algorithm:
            algorithm = algorithm.partition(':')[0]  # without options
        if algorithm in ('basic', 'basic-plain', 'bridson'):
            return paper_bound(2.0 ** EPSILONS['double'])
        return self.claimed(subject) if algorithm in AS_WANG + ALGORITHMS else None

    def _measured(self, subject):
        queries = self._nearmiss.family('uniform', self._seed, 'vt', 200)
        own = self._nearmiss.verdicts('vt', queries, subject)
        wangs = self._nearmiss.verdicts('vt', own.rounded, 'wang')
        quotients = own.bound / wangs.bound
        if not own.claims or np.ptp(quotients) > 1e-12 * quotients[0]:
            return None
        return float(quotients[0]) * paper_bound(2.0 ** EPSILONS['double'])

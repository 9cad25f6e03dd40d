"""Checks certificates of the Python package with tools/certificates/check.py. Each certificate
must state exactly what was asked.
"""

import pathlib
import sys
import unittest

import numpy as np
from harness import processor_mode

import nearmiss

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / 'tools/certificates'))
from check import Refused, Statement, check  # noqa: E402

FAMILIES = 'uniform planted near-separation mixed-scale'.split()

# The distance of the primitives is 1 at the irrational time sqrt(1/2), and above 1 at all other
# times.
TIED = [[0, 0.5, 1], [0, 0, 0], [1, 0, 0], [0, 0, 0], [1, 0.5, 1], [0, 0, 0], [1, 1, 0], [0, 0, 0]]


def proved(text):
    return [check(line) for line in text.split('\n')]


def about(kind, x, h, claim, strict, from_=0, to=1, is_open=False):
    return Statement(kind, tuple(np.ravel(x)), h, claim, from_, to, is_open, strict)


class Certificates(unittest.TestCase):
    def for_queries(self, function):
        """Calls function(kind, x, h) for queries of several families. In no query is the smallest
        distance exactly h."""
        for family in FAMILIES:
            for kind in ('vt', 'ee'):
                for x, h in zip(*nearmiss.queries(family, kind, 12)):
                    with self.subTest(family=family, kind=kind, x=x, h=h):
                        function(kind, x, h)

    def test_prove_the_decision(self):
        def prove(kind, x, h):
            hit = nearmiss.collides(kind, x, h)
            expected = about(kind, x, h, 'meets' if hit else 'apart', not hit or h > 0)
            self.assertEqual(proved(nearmiss.certificate(kind, x, h)), [expected])

        self.for_queries(prove)

    def test_prove_the_earliest_time(self):
        def prove(kind, x, h):
            lo, hi = nearmiss.earliest_time(kind, x, h)
            if np.isinf(lo):
                expected = [about(kind, x, h, 'apart', True)]
            else:
                expected = [about(kind, x, h, 'apart', True, 0, lo, True)] * bool(lo > 0)
                expected.append(about(kind, x, h, 'meets', False, lo, hi))
            self.assertEqual(proved(nearmiss.certificate(kind, x, h, prove='time')), expected)

        self.for_queries(prove)

    def test_prove_the_smallest_distance(self):
        def prove(kind, x, h):
            lo, hi = nearmiss.smallest_distance(kind, x)
            expected = [about(kind, x, lo, 'apart', False)] * bool(lo > 0)
            expected.append(about(kind, x, hi, 'meets', False))
            self.assertEqual(proved(nearmiss.certificate(kind, x, -1, prove='distance')), expected)

        self.for_queries(prove)

    def test_of_several_queries_are_an_array(self):
        x, h = nearmiss.queries('near-separation', 'vt', 5)
        each = [nearmiss.certificate('vt', *query) for query in zip(x, h)]
        for found in (
            nearmiss.certificate('vt', x, h),
            nearmiss.certificate('vt', np.asfortranarray(x.reshape(5, 8, 3)), h),
            nearmiss.certificate(
                'vt',
                nearmiss.MeshPairs(
                    np.arange(20).reshape(5, 4), x[:, 0].reshape(-1, 3), x[:, 1].reshape(-1, 3)
                ),
                h,
            ),
        ):
            self.assertEqual((found.shape, found.dtype), ((5,), object))
            self.assertEqual(found.tolist(), each)
        self.assertEqual(nearmiss.certificate('ee', np.empty((0, 8, 3))).shape, (0,))

    def test_are_none_if_nothing_can_be_proved(self):
        self.assertIsNone(nearmiss.certificate('vt', TIED, 1))
        both = nearmiss.certificate('vt', [TIED, TIED], [1, 0.5])
        self.assertIsNone(both[0])
        self.assertEqual(proved(both[1]), [about('vt', TIED, 0.5, 'apart', True)])
        lo, _ = nearmiss.earliest_time('vt', TIED, 1)
        self.assertEqual(
            proved(nearmiss.certificate('vt', TIED, 1, prove='time')),
            [about('vt', TIED, 1, 'apart', True, 0, lo, True)],
        )

    def test_do_not_depend_on_the_processors_mode(self):
        x = nearmiss.queries('near-underflow', 'vt', 50)[0]
        plain = nearmiss.certificate('vt', x, prove='time')
        self.assertNotIn(None, plain)
        for mode in (0x8040, 0x2000, 0x4000, 0x6000):  # flush to zero, or another rounding mode
            with processor_mode(mode):
                found = nearmiss.certificate('vt', x, prove='time')
            self.assertEqual(found.tolist(), plain.tolist())

    def test_are_refused_if_they_are_changed(self):
        text = nearmiss.certificate('vt', TIED, 0.5)
        with self.assertRaises(Refused):
            check(text.replace('"h":"0x1p-1"', '"h":"1"'))


if __name__ == '__main__':
    unittest.main()

"""Compares the answers of the Python package, for queries in all layouts, with those of answered_queries.
Usage: answers_test.py ANSWERED_QUERIES
"""

import sys
import unittest

import numpy as np
from harness import answered_queries, processor_mode

import nearmiss

COUNT = 6000
BLOCKS = answered_queries(sys.argv.pop(), COUNT, 1)
TIMED = [block for block in BLOCKS if block.times is not None]

same = np.testing.assert_array_equal


def layouts(x):
    """The queries x (n, 2, 4, 3) in other layouts in memory, by name."""
    padded = np.zeros((len(x), 2, 4, 5))
    padded[..., 1:4] = x
    packed = np.zeros(len(x), [('number', np.int8), ('x', float, (2, 4, 3))])
    packed['x'] = x
    return {
        'flat': x.reshape(-1, 8, 3),
        'list': x.tolist(),
        'backwards': x[::-1].copy()[::-1],
        'every second': np.repeat(x, 2, axis=0)[::2],
        'structure of arrays': np.ascontiguousarray(x.transpose(1, 2, 3, 0)).transpose(3, 0, 1, 2),
        'Fortran': np.asfortranarray(x),
        'coordinates in reverse': np.ascontiguousarray(x[..., ::-1])[..., ::-1],
        'padded': padded[..., 1:4],
        'not aligned': packed['x'],
        'of the other byte order': x.astype('>f8'),
        'read-only': np.frombuffer(x.tobytes()).reshape(x.shape),
    }


class Answers(unittest.TestCase):
    def test_are_those_of_the_harness(self):
        self.assertEqual(sum(len(block.x) for block in BLOCKS), COUNT)
        for block in BLOCKS:
            same(nearmiss.collides(block.kind, block.x, block.separation), block.collides)
            same(nearmiss.wang(block.kind, block.x), block.wang)
            same(nearmiss.wang_bound(block.kind, block.x), block.bound)

    def test_about_times_and_distances_are_those_of_the_harness(self):
        self.assertTrue(TIMED)
        for block in TIMED:
            same(nearmiss.earliest_time(block.kind, block.x, block.separation), block.times)
            same(nearmiss.smallest_distance(block.kind, block.x), block.distances)
            hits, toi = nearmiss.time_of_impact(block.kind, block.x, block.separation)
            same(hits, block.collides)
            same(toi, block.times[0])

    def test_about_single_queries_are_scalars(self):
        for block in TIMED:
            for q in range(0, len(block.x), 50):
                x, h = block.x[q], block.separation[q]
                hit = nearmiss.collides(block.kind, x, h)
                self.assertIsInstance(hit, np.bool_)
                self.assertEqual(hit, block.collides[q])
                self.assertEqual(nearmiss.wang(block.kind, x.reshape(8, 3)), block.wang[q])
                lo, hi = nearmiss.earliest_time(block.kind, x.tolist(), h)
                self.assertIsInstance(lo, float)
                self.assertEqual((lo, hi), tuple(block.times[:, q]))

    def test_do_not_depend_on_the_layout(self):
        for block in BLOCKS[:4]:
            for name, x in layouts(block.x).items():
                with self.subTest(layout=name):
                    same(nearmiss.collides(block.kind, x, block.separation), block.collides)
                    same(nearmiss.wang(block.kind, x), block.wang)
            kind, every_third = nearmiss.Kind(block.kind), block.separation.repeat(3)[::3]
            same(nearmiss.collides(kind, block.x, every_third), block.collides)

    def test_about_floats_are_those_about_the_same_doubles(self):
        for block in BLOCKS[:4]:
            single = block.x[np.abs(block.x).max((1, 2, 3)) < 1e38].astype(np.float32)
            for x in (single, np.asfortranarray(single), single[::-1]):
                double = x.astype(float)
                same(nearmiss.collides(block.kind, x), nearmiss.collides(block.kind, double))
                same(nearmiss.wang_bound(block.kind, x), nearmiss.wang_bound(block.kind, double))

    def test_about_integers_are_those_about_the_same_doubles(self):
        x = np.random.default_rng(1).integers(-3, 4, (1000, 8, 3))
        for dtype in (np.int8, np.int64, np.float16):
            expected = nearmiss.collides('vt', x.astype(float))
            same(nearmiss.collides('vt', x.astype(dtype)), expected)

    def test_about_a_mesh_are_those_about_its_pairs(self):
        for block in BLOCKS[:4]:
            vertices = block.x.transpose(1, 0, 2, 3).reshape(2, -1, 3)
            order = np.random.default_rng(1).permutation(vertices.shape[1])
            place = np.empty_like(order)
            place[order] = np.arange(len(order))
            start, end = vertices[:, order]
            pairs = place.reshape(-1, 4)
            for mesh in (
                nearmiss.MeshPairs(pairs, start, end),
                nearmiss.MeshPairs(pairs.astype(np.uint32), start, np.asfortranarray(end)),
                nearmiss.MeshPairs(pairs.T.copy().T, start[::-1].copy()[::-1], end),
            ):
                same(nearmiss.collides(block.kind, mesh, block.separation), block.collides)
                same(nearmiss.wang(block.kind, mesh), block.wang)

    def test_about_a_mesh_of_different_types_are_those_about_doubles(self):
        start = np.random.default_rng(1).integers(0, 9, (300, 3))
        end = np.random.default_rng(2).random((300, 3), np.float32)
        pairs = np.arange(300)[::-1].reshape(-1, 4)
        mixed = nearmiss.MeshPairs(pairs, start, end)
        doubles = nearmiss.MeshPairs(pairs, start.astype(float), end.astype(float))
        same(nearmiss.wang_bound('ee', mixed), nearmiss.wang_bound('ee', doubles))

    def test_about_vertices_and_edges_are_those_about_triangles_of_no_area(self):
        for kind, vertices in (('vv', [0, 1, 1, 1]), ('ve', [0, 1, 2, 2])):
            x, h = nearmiss.queries('v-uniform~drawn', kind, 500)
            v = max(vertices) + 1
            self.assertEqual(x.shape, (500, 2, v, 3))
            triangles = x[:, :, vertices]
            expected = nearmiss.collides('vt', triangles, h)
            self.assertTrue(expected.any() and not expected.all())
            mesh = nearmiss.MeshPairs(
                np.arange(500 * v).reshape(-1, v), *x.transpose(1, 0, 2, 3).reshape(2, -1, 3)
            )
            for same_x in (x, x.reshape(-1, 2 * v, 3), mesh):
                same(nearmiss.collides(kind, same_x, h), expected)
                self.assertTrue(nearmiss.wang(kind, same_x, h)[expected].all())
            times = nearmiss.earliest_time(kind, x, h), nearmiss.earliest_time('vt', triangles, h)
            same(times[0].lo, times[1].lo)
            self.assertEqual(nearmiss.collides(kind, x[7], h[7]), expected[7])

    def test_of_no_queries_are_none(self):
        for x in (np.empty((0, 2, 4, 3)), np.empty((0, 8, 3), np.float32)):
            for function in (nearmiss.collides, nearmiss.wang, nearmiss.wang_bound):
                self.assertEqual(function('ee', x).shape, (0,))
            self.assertEqual(nearmiss.smallest_distance('ee', x).lo.shape, (0,))
        mesh = nearmiss.MeshPairs(np.empty((0, 4), int), np.empty((0, 3)), np.empty((0, 3)))
        self.assertEqual(nearmiss.collides('ee', mesh).shape, (0,))

    def test_of_arrays_are_read_where_they_are(self):
        x = BLOCKS[0].x
        huge = np.broadcast_to(x[0], (10**8, 2, 4, 3))  # a copy would need 19 GB
        with self.assertRaisesRegex(ValueError, 'query 0 has the separation -1.0'):
            nearmiss.collides(BLOCKS[0].kind, huge, -1)


class Options(unittest.TestCase):
    falls = np.array([[[0.25, 0.25, 1], [0, 0, 0], [1, 0, 0], [0, 1, 0]]] * 2)
    falls[1, 0, 2] = -2

    def test_decided_by_says_what_decided(self):
        x = nearmiss.queries('uniform', 'ee', 1000)[0]
        hits, decided_by = nearmiss.collides('ee', x, decided_by=True)
        same(hits, nearmiss.collides('ee', x))
        a, b = x[:, :, :2], x[:, :, 2:]
        apart = (a.max((1, 2)) < b.min((1, 2))) | (b.max((1, 2)) < a.min((1, 2)))
        same(decided_by == nearmiss.DecidedBy.BOXES, apart.any(1))
        self.assertLessEqual(set(decided_by), set(nearmiss.DecidedBy))

    def test_tmax_ends_the_step(self):
        third = np.nextafter(1 / 3, 1)
        self.assertEqual(nearmiss.time_of_impact('vt', self.falls, tmax=third), (True, 1 / 3))
        self.assertEqual(nearmiss.time_of_impact('vt', self.falls, 0.0, 1 / 3), (False, np.inf))

    def test_width_is_that_of_times(self):
        lo, hi = nearmiss.earliest_time('vt', self.falls)
        self.assertEqual(hi, np.nextafter(lo, 1))
        lo, hi = nearmiss.earliest_time('vt', self.falls, width=0.25)
        self.assertTrue(lo <= 1 / 3 <= hi <= lo + 0.25)

    def test_relative_width_is_that_of_distances(self):
        x = np.random.default_rng(1).random((100, 2, 4, 3))
        for width in (0.1, 1e-9, 0):
            lo, hi = nearmiss.smallest_distance('ee', x, relative_width=width)
            self.assertTrue((hi - lo <= np.maximum(width * hi, np.spacing(lo))).all())

    def test_one_separation_is_that_of_all_queries(self):
        x = np.stack([self.falls, self.falls - [[[0, 0, 0]], [[0, 0, -2.5]]]])
        same(nearmiss.collides('vt', x, 0.5), nearmiss.collides('vt', x, [0.5, 0.5]))
        self.assertEqual(nearmiss.earliest_time('vt', self.falls, 0.25).lo, 0.25)

    def test_do_not_depend_on_the_processors_mode(self):
        near, far = np.zeros((2, 2, 4, 3))
        for x, z in ((near, 2e-40), (far, 1e-39)):
            x[:] = [[0, 0, z], [-1, -1, 0], [1, -1, 0], [0, 1, 0]]
        h = np.float32(3e-40)
        swapped = near.astype('>f4')
        ends = [near[0].astype(np.float32), near[0]]
        plain = nearmiss.queries('near-underflow', 'vt', 50)[0]
        for mode in (0x8040, 0x2000, 0x4000, 0x6000):  # flush to zero, or another rounding mode
            with processor_mode(mode):
                hits = [
                    nearmiss.collides('vt', near, h),
                    nearmiss.collides('vt', far, h),
                    nearmiss.collides('vt', swapped),
                    nearmiss.collides('vt', nearmiss.MeshPairs([[0, 1, 2, 3]], *ends))[0],
                ]
                x = nearmiss.queries('near-underflow', 'vt', 50)[0]
            self.assertEqual([bool(hit) for hit in hits], [True, False, False, False])
            same(x, plain)
            with processor_mode(mode), self.assertRaisesRegex(ValueError, 'separation -5e-324'):
                nearmiss.collides('vt', near, -5e-324)
            with processor_mode(mode), self.assertRaisesRegex(ValueError, 'width is -5e-324'):
                nearmiss.earliest_time('vt', near, width=-5e-324)


if __name__ == '__main__':
    unittest.main()

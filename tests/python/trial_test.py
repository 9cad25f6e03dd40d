"""Puts Python functions on trial.
Usage: trial_test.py NEARMISS PLUGINS
"""

import contextlib
import io
import json
import signal
import subprocess
import sys
import tempfile
import unittest

import numpy as np
from harness import run_python

import nearmiss

PLUGINS = sys.argv.pop()
NEARMISS = sys.argv.pop()


def sampled(kind, x, separation):
    """A CCD that reports a query if the boxes of the primitives meet at one of 16 times."""
    split = 1 if kind == 'vt' else 2
    hits = np.zeros(len(x), bool)
    for t in np.linspace(0, 1, 16):
        now = (1 - t) * x[:, 0] + t * x[:, 1]
        a, b = now[:, :split], now[:, split:]
        hits |= ((a.max(1) >= b.min(1)) & (b.max(1) >= a.min(1))).all(1)
    return hits


def exact(kind, x, separation):
    return nearmiss.collides(kind, x, separation)


def exact_times(kind, x, separation):
    return nearmiss.time_of_impact(kind, x, separation)


def never(kind, x, separation):
    return np.zeros(len(x), bool)


class Trial(unittest.TestCase):
    def test_finds_the_misses_of_a_naive_function(self):
        result = nearmiss.trial(sampled, 3000)
        counts = result.counts('sampled')
        self.assertEqual(counts.queries, 3000)
        self.assertGreater(counts.missed, 100)
        self.assertGreater(counts.false_positives, 100)
        misses = result.findings[result.findings.what == 'false-negative']
        self.assertEqual(len(misses), counts.missed)
        for kind in ('vt', 'ee'):
            of_kind = misses[misses.kind == kind]
            self.assertTrue(nearmiss.collides(kind, of_kind.x, of_kind.separation).all())
            self.assertFalse(sampled(kind, of_kind.x, of_kind.separation).any())

    def test_shrinks_findings_to_simple_queries_that_still_fail(self):
        findings = nearmiss.trial(sampled, 1000, shrunk=2).findings
        self.assertTrue(findings.is_shrunk.any())
        for signature, class_ in set(zip(findings.signature, findings.class_)):
            of_way = (findings.signature == signature) & (findings.class_ == class_)
            self.assertEqual(findings[of_way].is_shrunk.sum(), min(2, of_way.sum()))
        for kind in ('vt', 'ee'):
            shrunk = findings[findings.is_shrunk & (findings.kind == kind)]
            self.assertTrue(nearmiss.collides(kind, shrunk.shrunk).all())
            self.assertFalse(sampled(kind, shrunk.shrunk, shrunk.shrunk_separation).any())
            zeros = (shrunk.shrunk == 0).sum((1, 2, 3)) >= (shrunk.x == 0).sum((1, 2, 3))
            self.assertTrue(zeros.all())
        rest = findings[~findings.is_shrunk]
        np.testing.assert_array_equal(rest.x, rest.shrunk)

    def test_finds_nothing_about_exact_answers(self):
        asked = {'kinds': ('vt', 'ee', 'vv', 've'), 'takes_separation': True}
        of_exact = nearmiss.Subject(exact, **asked)
        of_times = nearmiss.Subject(exact_times, time='lower-bound', **asked)
        result = nearmiss.trial([of_exact, of_times], 4000, list(nearmiss.families()))
        self.assertEqual(len(result.findings), 0)
        self.assertEqual(result.findings.x.shape, (0, 2, 4, 3))
        self.assertEqual(len(result.findings[~result.findings.is_shrunk]), 0)
        for subject in ('exact', 'exact_times'):
            counts = result.counts(subject)
            self.assertEqual((counts.queries, counts.missed, counts.late), (4000, 0, 0))
            self.assertEqual(counts.false_positives, 0)

    def test_counts_as_the_command_line_does(self):
        subjects = ['basic', 'wang', 'fcl', f'{PLUGINS}/cautious.so']
        result = nearmiss.trial(subjects, 3000, seed=7)
        command = [NEARMISS, 'fuzz', '--subject', ','.join(subjects), '--family', 'all']
        command += ['--cases', '3000', '--seed', '7', '--json', '-']
        report = json.loads(subprocess.run(command, capture_output=True).stdout)
        for subject, by_kind in report['subjects'].items():
            for kind, expected in by_kind.items():
                counts = result.counts(subject, kind=kind)
                self.assertEqual(counts.queries, expected['queries'])
                self.assertEqual(counts.collisions, expected['collisions'])
                self.assertEqual(counts.missed, expected['false_negatives'])
                self.assertEqual(counts.false_positives, expected['false_positives'])

        self.assertGreater(result.counts('always').beyond_contract, 500)

    def test_a_plugin_that_hangs_is_not_waited_for_again_and_again(self):
        plugin = f'hangs={PLUGINS}/hang.so'
        # If nearmiss waited a second for each query, the test would exceed its time limit.
        counts = nearmiss.trial(plugin, 1000, 'uniform', shrunk=0).counts('hangs')
        self.assertGreaterEqual(counts.no_answer, 6)  # three of each kind
        self.assertEqual(counts.missed, 0)

    def test_shows_its_progress_on_request(self):
        line = io.StringIO()
        with contextlib.redirect_stderr(line):
            nearmiss.trial('basic', 60000, shrunk=0, progress=True)
        self.assertRegex(line.getvalue(), r'\r\d+ s left, [\d,]+ of 60,000 cases, [\d,]+ missed')
        self.assertTrue(line.getvalue().endswith('\r'))

    def test_the_farthest_may_be_infinite(self):
        always = nearmiss.trial(lambda kind, x, h: np.ones(len(x), bool), 3000, 'overflow')
        self.assertEqual(always.counts('<lambda>').farthest, np.inf)

    def test_counts_families_and_kinds(self):
        result = nearmiss.trial([sampled, 'wang'], 500, ['uniform', 'aspect@8'])
        self.assertEqual(result.subjects, ['sampled', 'wang'])
        self.assertEqual(set(result.families), {'uniform', 'aspect@8'})
        parts = [
            result.counts('sampled', kind=kind, family=family)
            for kind in ('vt', 'ee')
            for family in result.families
        ]
        self.assertEqual(sum(parts, nearmiss.Counts()), result.counts('sampled'))
        self.assertIn('sampled', repr(result))
        for wrong in (lambda: result.counts('none'), lambda: result.counts('wang', family='none')):
            with self.assertRaisesRegex(ValueError, "'none', expected one of "):
                wrong()

    def test_finds_late_times(self):
        def late(kind, x, separation):
            hits, times = exact_times(kind, x, separation)
            return hits, np.minimum(np.nextafter(times, 2), 1)

        result = nearmiss.trial(nearmiss.Subject(late, time='lower-bound'), 500)
        findings = result.findings
        self.assertGreater(result.counts('late').late, 100)
        self.assertEqual(len(findings[findings.what == 'late']), result.counts('late').late)
        of_estimate = nearmiss.trial(nearmiss.Subject(late, time='estimate'), 500)
        self.assertEqual(of_estimate.counts('late').late, 0)

    def test_counts_collisions_without_a_time(self):
        def no_time(kind, x, separation):
            return exact(kind, x, separation), np.full(len(x), np.nan)

        result = nearmiss.trial(nearmiss.Subject(no_time, time='estimate'), 200, shrunk=0)
        self.assertGreater(result.counts('no_time').no_answer, 50)
        self.assertEqual(set(result.findings.what), {'fault'})

    def test_takes_every_byte_but_0_for_true(self):
        def always(kind, x, separation):
            return np.full(len(x), 2, np.uint8).view(bool)

        counts = nearmiss.trial(always, 200, shrunk=0).counts('always')
        self.assertEqual(counts.missed, 0)
        self.assertEqual(counts.false_positives, counts.queries - counts.collisions)
        self.assertGreater(counts.farthest, 1)

    def test_asks_only_the_kinds_and_separations_of_a_subject(self):
        asked = []

        def noting(kind, x, separation):
            self.assertEqual(x.shape, (len(separation), 2, 4, 3))
            asked.append((kind, (separation > 0).any()))
            return never(kind, x, separation)

        families = ['uniform', 'uniform~0.5']
        nearmiss.trial(nearmiss.Subject(noting, kinds=['ee']), 100, families, shrunk=0)
        self.assertEqual(set(asked), {('ee', False)})
        asked.clear()
        nearmiss.trial(nearmiss.Subject(noting, takes_separation=True), 100, families, shrunk=0)
        self.assertEqual(len(set(asked)), 4)

    def test_asks_vertices_and_edges_a_function_that_decides_them(self):
        shapes = {}

        def noting(kind, x, separation):
            shapes[kind] = x.shape[1:]
            return exact(kind, x, separation) & (x[:, 0, 0, 0] < 0)

        subject = nearmiss.Subject(noting, kinds=['ve', 'vv'], takes_separation=True)
        result = nearmiss.trial(subject, 2000)
        self.assertEqual(shapes, {'vv': (2, 2, 3), 've': (2, 3, 3)})
        self.assertTrue((result.findings.separation > 0).all())
        self.assertTrue(all(name.startswith('v-') for name in result.families))
        self.assertGreater(result.counts('noting', kind='ve').missed, 50)
        shrunk = result.findings[result.findings.is_shrunk & (result.findings.kind == 'vv')]
        self.assertGreater(len(shrunk), 0)
        np.testing.assert_array_equal(shrunk.shrunk[:, :, 2], shrunk.shrunk[:, :, 1])
        self.assertTrue(
            nearmiss.collides('vv', shrunk.shrunk[:, :, :2], shrunk.shrunk_separation).all()
        )
        for kinds, families in (('ve', None), ('vt', ['v-uniform']), (['vv', 've'], ['uniform'])):
            with self.assertRaisesRegex(ValueError, "found no query for 'noting'"):
                nearmiss.trial(nearmiss.Subject(noting, kinds=kinds), 100, families)
        only = nearmiss.Subject(noting, kinds='vv', takes_separation=True)
        self.assertEqual(nearmiss.trial(only, 300, shrunk=0).counts('noting').queries, 300)

    def test_passes_exceptions_on(self):
        class Mine(Exception):
            pass

        for exception in (Mine('as it is'), KeyboardInterrupt(), ValueError('mine')):
            calls = 0

            def fails(kind, x, separation):
                nonlocal calls
                calls += 1
                if calls > when:
                    raise exception
                return never(kind, x, separation)

            for when in (0, 5, 300):  # at 300, findings are being shrunk
                calls = 0
                with self.assertRaises(type(exception)) as caught:
                    nearmiss.trial(fails, 500, shrunk=3)
                self.assertIs(caught.exception, exception)

    def test_ends_at_a_signal(self):
        calls = 0

        def interrupted(kind, x, separation):
            nonlocal calls
            calls += 1
            if calls == 10:
                signal.raise_signal(signal.SIGINT)
            return never(kind, x, separation)

        with self.assertRaises(KeyboardInterrupt):
            nearmiss.trial(interrupted, 1000)
        self.assertEqual(calls, 10)

    def test_making_queries_ends_at_a_signal(self):
        before = signal.signal(signal.SIGALRM, signal.default_int_handler)
        self.addCleanup(signal.signal, signal.SIGALRM, before)
        with self.assertRaises(KeyboardInterrupt):
            signal.setitimer(signal.ITIMER_REAL, 0.01)
            nearmiss.queries('uniform', 'vt', 10**7)

    def test_a_function_may_change_what_it_is_given(self):
        def reshapes(kind, x, separation):
            hits = exact(kind, x, separation)
            x.shape = (-1,)
            return hits

        self.assertEqual(nearmiss.trial(reshapes, 200).counts('reshapes').missed, 0)

    def test_the_end_of_the_interpreter_ends_it(self):
        program = """
import threading, time, nearmiss
import sys
asked = threading.Event()
def slow(kind, x, separation):
    asked.set()
    time.sleep(0.01)
    return nearmiss.collides(kind, x)
def endless(kind, x, separation):
    asked.set()
    while True:
        pass
function = globals()[sys.argv[1]]
threading.Thread(target=nearmiss.trial, args=(function, 10**9), daemon=True).start()
asked.wait()
"""
        for function in ('slow', 'endless'):
            self.assertEqual(run_python(program, function), (0, '', ''), function)

    def test_a_function_that_python_calls_at_its_end_may_hold_one(self):
        program = """
import atexit
atexit.register(lambda: print(nearmiss.trial('wang', 100).counts('wang').missed))
import nearmiss
"""
        self.assertEqual(run_python(program), (0, '0\n', ''))


class Record(unittest.TestCase):
    def test_is_judged_as_answered(self):
        code = """if True:
            import nearmiss
            misses = 0
            for kind in ('vt', 'ee', 'vv', 've'):
                x, separation = nearmiss.queries('uniform' if kind in ('vt', 'ee') else 'v-uniform', kind, 50)
                v = {'vt': 4, 'ee': 4, 'vv': 2, 've': 3}[kind]
                x = x[:, :, :v]
                hits, toi = nearmiss.time_of_impact(kind, x, separation)
                misses += int(hits.any())
                hits[hits.argmax()] = False
                nearmiss.record(kind, x[1:], hits[1:], toi[1:], separation[1:], keep=kind == 'vv')
                nearmiss.record(kind, x[0].reshape(2 * v, 3), hits[0], toi[0], separation[0])
            # Each of these shapes has 24 numbers, as two queries of two vertices have.
            for shape in ((4, 2, 3), (2, 3, 4, 1), (1, 4, 2, 3), (4, 6), (24,), (2, 1, 2, 2, 3)):
                try:
                    nearmiss.record('vv', x.flat[:24].reshape(shape), True)
                except ValueError as error:
                    print(error)
            print(misses)
            """
        with tempfile.TemporaryDirectory() as folder:
            file = f'{folder}/run.nmq'
            returned, said, _ = run_python(code, NEARMISS_RECORD=file)
            *refusals, missed = said.splitlines()
            self.assertEqual((returned, len(refusals)), (0, 6), said)
            for line in refusals:
                self.assertIn(
                    'expected (n, 2, 2, 3) or (n, 4, 3), or (2, 2, 3) or (4, 3) for one', line
                )
            command = [NEARMISS, 'replay', file, '--as-answered', '--json', '-']
            judged = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual(judged.returncode, 1, judged.stderr)
        (kinds,) = json.loads(judged.stdout)['subjects'].values()
        self.assertEqual([each['queries'] for each in kinds.values()], [50] * 4)
        misses = sum(each['false_negatives'] for each in kinds.values())
        self.assertGreater(misses, 0)
        self.assertEqual(misses, int(missed))


class Queries(unittest.TestCase):
    def test_are_those_of_the_command_line(self):
        for family, kind in (('uniform', 'vt'), ('aspect@8~0.5', 'ee')):
            x, separation = nearmiss.queries(family, kind, 20, seed=3)
            command = [NEARMISS, 'family', family, '--kind', kind, '--count', '20', '--seed', '3']
            text = subprocess.run(command, capture_output=True, text=True, check=True).stdout
            rows = [list(map(float.fromhex, line.split())) for line in text.splitlines()]
            expected = x.reshape(20, 24)
            if '~' in family:
                expected = np.column_stack([expected, separation])
            np.testing.assert_array_equal(rows, expected)

    def test_more_than_fit_into_memory_are_refused(self):
        for count in (2**40, 2**63):
            with self.assertRaises(MemoryError):
                nearmiss.queries('uniform', 'vt', count)


if __name__ == '__main__':
    unittest.main()

"""Tests which calls the Python package refuses, and with which messages. Also tests that other
threads run during a call."""

import itertools
import signal
import sys
import threading
import time
import unittest
from fractions import Fraction

import numpy as np
from harness import run_python

import nearmiss

X = np.random.default_rng(1).random((300, 2, 4, 3))
FUNCTIONS = {
    'collides': nearmiss.collides,
    'earliest_time': nearmiss.earliest_time,
    'time_of_impact': nearmiss.time_of_impact,
    'smallest_distance': nearmiss.smallest_distance,
    'certificate': nearmiss.certificate,
    'wang': nearmiss.wang,
    'wang_bound': nearmiss.wang_bound,
}


class Refusals(unittest.TestCase):
    def expect(self, message, function, *arguments, error=ValueError, **named):
        with self.assertRaises(error) as caught:
            function(*arguments, **named)
        self.assertEqual(str(caught.exception), message)

    def test_of_a_coordinate_that_is_not_finite_name_the_first_query(self):
        wanted = 'query 234 has a coordinate that is not finite'
        values, types = (np.nan, np.inf, -np.inf), (np.float64, np.float32)
        for value, dtype, far in itertools.product(values, types, (0, 1e9)):
            x = X.astype(dtype)
            x[234, 0, 0, 0] += far  # unless `far` is 0, the boxes are apart
            x[234, 1, 2, 1] = value
            x[285, 0, 0, 0] = value
            for kind, function in itertools.product(('vt', 'ee'), FUNCTIONS):
                with self.subTest(value=value, dtype=dtype, kind=kind, function=function):
                    self.expect(wanted, FUNCTIONS[function], kind, x)

    def test_of_separations(self):
        h = np.zeros(len(X))
        for value in (-1.0, np.nan, np.inf):
            h[17] = value
            wanted = f'query 17 has the separation {value}, expected a finite number that is not negative'
            self.expect(wanted, nearmiss.collides, 'vt', X, h)
        wanted = 'separation has shape (2,), expected a number or (300,)'
        self.expect(wanted, nearmiss.earliest_time, 'vt', X, [0, 0])
        wanted = 'separation has shape (1,), expected a number'
        self.expect(wanted, nearmiss.collides, 'vt', X[0], [0])

    def test_of_kinds(self):
        for kind in ('tt', 1, None, 'VT'):
            wanted = f"kind is {kind!r}, expected 'vt', 'ee', 'vv' or 've'"
            self.expect(wanted, nearmiss.wang, kind, X)

    def test_of_what_to_prove(self):
        for prove in ('toi', None, 0, ['time']):
            wanted = f"prove is {prove!r}, expected 'decision', 'time' or 'distance'"
            self.expect(wanted, nearmiss.certificate, 'vt', X[0], prove=prove)

    def test_of_shapes(self):
        for shape in ((7, 3), (3, 8), (24,), (), (5, 24), (5, 2, 4, 2), (2, 2, 2, 4, 3)):
            wanted = 'x has shape ' + str(shape).replace('(', r'\(').replace(')', r'\)')
            with self.assertRaisesRegex(ValueError, wanted):
                nearmiss.collides('vt', np.zeros(shape))

    def test_of_types(self):
        for dtype in ('complex128', 'longdouble', 'bool', 'U3', 'object'):
            with self.assertRaisesRegex(TypeError, 'expected float64, float32 or integers'):
                nearmiss.collides('vt', np.zeros((2, 4, 3), dtype))

    def test_of_integers_that_would_be_rounded(self):
        for number in (2**53 + 1, -(2**53) - 1):
            x = np.zeros((8, 3), np.int64)
            x[3, 1] = number
            wanted = 'x has an integer beyond 2^53, which may be no double'
            mixed = x.tolist()
            mixed[0][0] = 0.5
            halves = [x[:4].astype(np.uint64 if number > 0 else np.int64), np.zeros((4, 3))]
            arrays = [[np.array(each) for each in row] for row in mixed]
            in_memory = memoryview(x.reshape(2, 4, 3))
            for queries in (x, mixed, halves, arrays, in_memory):
                self.expect(wanted, nearmiss.wang, 'ee', queries)
        wanted = 'separation has an integer beyond 2^53, which may be no double'
        self.expect(wanted, nearmiss.collides, 'vt', X[:2], [2**53 + 1, 0.5])

    def test_of_masked_elements(self):
        wanted = 'x has masked elements, expected none'
        self.expect(wanted, nearmiss.collides, 'vt', np.ma.masked_all((8, 3)))
        halves = [np.zeros((4, 3)), np.ma.masked_all((4, 3))]
        self.expect(wanted, nearmiss.collides, 'vt', halves)
        pairs = nearmiss.MeshPairs(np.ma.masked_all((1, 4), int), X[0, 0], X[0, 1])
        self.expect(wanted.replace('x ', 'pairs ', 1), nearmiss.collides, 'vt', pairs)
        nearmiss.collides('vt', np.ma.masked_array(X))

    def test_of_meshes(self):
        v = X[0, 0]
        for pairs, error, message in (
            ([[0, 1, 2, 4]], ValueError, 'pair 0 has the vertex 4, expected a number from 0 to 3'),
            ([[0, 1, 2, 3], [0, -1, 2, 3]], ValueError, 'pair 1 has the vertex -1, expected a '),
            (np.array([[2**40, 1, 2, 3]]), ValueError, 'pair 0 has the vertex 1099511627776,'),
            ([[0, 1, 2]], ValueError, 'pairs has shape (1, 3), expected (n, 4)'),
            ([[0.0, 1, 2, 3]], TypeError, 'pairs has the type float64, expected integers'),
        ):
            with self.assertRaises(error) as caught:
                nearmiss.collides('vt', nearmiss.MeshPairs(pairs, v, v))
            self.assertIn(message, str(caught.exception))
        good = [[0, 1, 2, 3]]
        with self.assertRaisesRegex(ValueError, 'but end has shape'):
            nearmiss.collides('vt', nearmiss.MeshPairs(good, v, v[:3]))
        with self.assertRaisesRegex(ValueError, r'start has shape \(4, 2\), expected \(v, 3\)'):
            nearmiss.collides('vt', nearmiss.MeshPairs(good, v[:, :2], v))

    def test_of_options(self):
        most, least = 'a double that is at most 1', 'a double that is not negative'
        for name, wanted, function, values in (
            ('tmax', most, nearmiss.time_of_impact, (1.5, np.nan, Fraction(1, 3))),
            ('width', least, nearmiss.earliest_time, (-5e-324, np.nan, 10**400)),
            ('relative_width', least, nearmiss.smallest_distance, (-1.0, np.float32(-1))),
        ):
            for error, wrong in ((ValueError, values), (TypeError, (None, '1', 1j, np.zeros(2)))):
                for value in wrong:
                    message = f'{name} is {value!r}, expected {wanted}'
                    self.expect(message, function, 'vt', X, error=error, **{name: value})
            for value in (0, np.float32(0), np.array(0.0), True):
                function('vt', X[:1], **{name: value})


def many_queries():
    """An array that repeats one query ten million times, but takes only the memory of one query."""
    return np.broadcast_to(X[0], (10**7, 2, 4, 3))


class DuringACall(unittest.TestCase):
    def test_other_threads_run(self):
        """Another thread counts. The test makes Python's switch interval so long that Python takes
        its lock away from no thread. So the other thread can count during a call only if the call
        releases the lock."""
        count, calls = 0, 0
        is_over = threading.Event()

        def count_up():
            nonlocal count
            while not is_over.is_set():
                count += 1
                time.sleep(0)  # releases the lock

        self.addCleanup(sys.setswitchinterval, sys.getswitchinterval())
        sys.setswitchinterval(1000)
        thread = threading.Thread(target=count_up)
        thread.start()
        queries = nearmiss._queries.Asked('vt', many_queries()).queries
        counted = 0
        while counted == 0 and calls < 100:
            before = count
            nearmiss._interface.collides(queries)
            counted = count - before
            calls += 1
        is_over.set()
        thread.join()
        self.assertGreater(counted, 0)

    def test_the_end_of_the_interpreter_ends_it(self):
        program = """
import sys, threading, time, numpy, nearmiss
x = numpy.random.rand(1000, 2, 4, 3)
def ask():
    while True:
        getattr(nearmiss, sys.argv[1])('vt', x)
threading.Thread(target=ask, daemon=True).start()
time.sleep(0.2)
"""
        for function in ('collides', 'certificate'):
            self.assertEqual(run_python(program, function), (0, '', ''), function)

    def test_a_function_that_python_calls_at_its_end_may_ask(self):
        program = """
import atexit
atexit.register(lambda: print(nearmiss.collides('vt', nearmiss.queries('uniform', 'vt', 1)[0])))
import nearmiss
"""
        self.assertIn(run_python(program), [(0, f'[{hit}]\n', '') for hit in (True, False)])

    def test_a_signal_ends_it(self):
        main = threading.main_thread().ident
        thread = threading.Thread(target=lambda: signal.pthread_kill(main, signal.SIGINT))
        with self.assertRaises(KeyboardInterrupt):
            thread.start()
            while True:
                nearmiss.smallest_distance('vt', many_queries())


if __name__ == '__main__':
    unittest.main()

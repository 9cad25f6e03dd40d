"""Tests which arguments and answers a trial of a Python function refuses, and what its findings show."""

import unittest

import numpy as np

import nearmiss


def never(kind, x, separation):
    return np.zeros(len(x), bool)


class Subjects(unittest.TestCase):
    def test_says_what_a_function_should_return(self):
        for answer, time, error, message in (
            (lambda n: np.zeros(n), 'none', TypeError, 'answers of type float64, expected bool'),
            (lambda n: np.zeros(n + 1, bool), 'none', ValueError, r'answers of shape \(\d+,\)'),
            (lambda n: None, 'none', TypeError, 'answers of type object, expected bool'),
            (lambda n: np.zeros(n, bool), 'estimate', TypeError, r'expected \(bools, times\)'),
            (lambda n: (np.zeros(n, bool), 1j), 'estimate', TypeError, 'times of type complex128'),
            (lambda n: (np.zeros(n, bool), 0.5), 'estimate', ValueError, r'times of shape \(\)'),
        ):
            subject = nearmiss.Subject(lambda kind, x, h: answer(len(x)), 'mine', time)
            with self.assertRaisesRegex(error, 'mine returned .*' + message):
                nearmiss.trial(subject, 100)

    def test_refuses_masked_answers(self):
        for what, answer, time in (
            ('answer', lambda n: np.ma.masked_all(n, bool), 'none'),
            ('times', lambda n: (np.ones(n, bool), np.ma.masked_all(n)), 'estimate'),
        ):
            subject = nearmiss.Subject(lambda kind, x, h: answer(len(x)), 'mine', time)
            with self.assertRaisesRegex(ValueError, f'the {what} of mine has masked elements'):
                nearmiss.trial(subject, 100)

    def test_takes_one_name_for_several(self):
        subject = nearmiss.Subject(never, kinds='ee')
        result = nearmiss.trial(subject, 100, 'uniform', shrunk=0)
        self.assertEqual(result.families, ['uniform'])
        self.assertEqual(result.counts('never').queries, result.counts('never', kind='ee').queries)

    def test_refuses_other_types(self):
        for message, make in (
            ('function is None, expected a function', lambda: nearmiss.Subject(None)),
            ('name is 5, expected a string', lambda: nearmiss.Subject(never, name=5)),
            (
                "takes_separation is 'no', expected a bool",
                lambda: nearmiss.Subject(never, takes_separation='no'),
            ),
            ('subjects is None, expected a Subject', lambda: nearmiss.trial(None)),
            ("subjects is b'wang', expected a Subject", lambda: nearmiss.trial(b'wang')),
            ('function is 5, expected a function', lambda: nearmiss.trial([5])),
            ('cases is 10000.0, expected an integer', lambda: nearmiss.trial(never, 1e4)),
            ('families is 5, expected names', lambda: nearmiss.trial(never, 10, 5)),
            ("kinds is None, expected some of 'vt'", lambda: nearmiss.Subject(never, kinds=None)),
            ('found the family 5, expected a name', lambda: nearmiss.trial(never, 10, [5])),
            ('found the family 5, expected a name', lambda: nearmiss.queries(5, 'vt', 1)),
            ('count is 1.5, expected an', lambda: nearmiss.queries('uniform', 'vt', 1.5)),
        ):
            with self.assertRaisesRegex(TypeError, message):
                make()

    def test_refuses_what_it_does_not_know(self):
        for message, arguments in (
            ('unknown subject', ['bassic']),
            ('./mine.so: cannot load the plug-in', ['./mine.so']),
            ('unknown family', [never, 100, ['unifrom']]),
            (r"found the family 'uniform\\x00', expected printable", [never, 1, 'uniform\0']),
            ('expected different ones', [[never, never]]),
            ('expected at least one', [never, 0]),
            ('expected at least one', [never, 10, []]),
            ('seed is -1, expected', [never, 10, ['uniform'], -1]),
            ('found no subject', [[]]),
            ('shrunk is 18446744073709551616, expected', [never, 10, 'uniform', 1, 2**64]),
            (r"found the name '\\ud800'", [nearmiss.Subject(never, '\ud800')]),
            ("found the name 'a:b'", [nearmiss.Subject(never, 'a:b')]),
            ("found the name 'oracle', under which", [nearmiss.Subject(never, 'oracle')]),
        ):
            with self.assertRaisesRegex(ValueError, message):
                nearmiss.trial(*arguments[:4], **dict(zip(['shrunk'], arguments[4:])))
        with self.assertRaisesRegex(ValueError, 'one of none, estimate, lower-bound, free-step'):
            nearmiss.Subject(never, time='exact')
        with self.assertRaisesRegex(
            ValueError, r"kinds is \(\), expected some of 'vt', 'ee', 'vv' and 've'"
        ):
            nearmiss.Subject(never, kinds=[])


class Findings(unittest.TestCase):
    def test_findings_are_selected_many_at_once(self):
        findings = nearmiss.trial(never, 100, 'uniform', shrunk=0).findings
        self.assertEqual(len(findings[[0, 2]]), 2)
        self.assertEqual(len(findings[:3]), 3)
        with self.assertRaisesRegex(TypeError, "found 'a', expected a number, a mask, a slice or"):
            findings['a']

    def test_a_finding_explains_itself(self):
        subject = nearmiss.Subject(never, kinds=('vt', 'vv'), takes_separation=True)
        findings = nearmiss.trial(subject, 400, ['uniform', 'v-uniform']).findings
        self.assertEqual(len(list(findings)), len(findings))
        with self.assertRaises(IndexError):
            findings[len(findings)]
        for finding in (findings[0], findings[findings.kind == 'vv'][0]):
            vertices = 4 if finding.kind == 'vt' else 2
            self.assertEqual(finding.x.shape, (2, vertices, 3))
            self.assertTrue(finding.is_shrunk)
            self.assertTrue(nearmiss.collides(finding.kind, finding.x, finding.separation))
            self.assertIn('inside the step', finding.explanation)
            self.assertIn(finding.class_, ('ordinary', 'degenerate'))
            self.assertTrue(finding.certificate.startswith('{'))
            names = {'np': np, 'nearmiss': nearmiss}
            exec(finding.code, names)
            self.assertTrue((names['x'] == finding.x).all())
            page = finding._repr_html_()
            self.assertIn('<svg ', page)
            self.assertIn(finding.explanation, page)
        self.assertEqual(findings[-1].provenance, findings.provenance[-1])

    def test_a_finding_draws_itself(self):
        try:
            import matplotlib
        except ModuleNotFoundError:
            self.skipTest('matplotlib is not installed')
        matplotlib.use('Agg')
        axes = nearmiss.trial(never, 100, 'uniform').findings[0].plot()
        self.assertIn('false-negative of never', axes.get_title())
        self.assertGreaterEqual(len(axes.lines), 4)

    def test_findings_become_a_data_frame_where_pandas_is(self):
        findings = nearmiss.trial(never, 100, 'uniform', shrunk=0).findings
        try:
            frame = findings.to_dataframe()
        except ModuleNotFoundError:
            self.skipTest('pandas is not installed')
        self.assertEqual(len(frame), len(findings))
        self.assertEqual(list(frame.family), list(findings.family))


if __name__ == '__main__':
    unittest.main()

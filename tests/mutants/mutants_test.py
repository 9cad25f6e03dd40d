#!/usr/bin/python3
"""Tests that the operators make the right edits, that a seed always gives the same draw, and that
the list of equivalent mutants is checked against the sources."""

import json
import tempfile
import unittest
from dataclasses import replace
from pathlib import Path

from compiling import Mutants, blamed
from draw import draw
from equivalents import complaints, entries
from mutation import applied
from schemata import by_itself, with_switches
from sites import mutants_of
from sources import Compiled, read
from syntax import parse

HERE = Path(__file__).resolve().parent
FILE = 'fixture/slips.cpp'
TEXT = read(HERE / FILE)
(TREE,) = parse(HERE / FILE, ['-xc++', '-std=c++20'], [HERE / FILE])
SITES = mutants_of(FILE, TEXT, TREE)


def made(operator, before):
    """The lines that an operator makes from a line of code."""
    return {
        each.after
        for each in SITES
        if each.operator == operator and each.before.startswith(before)
    }


def only(operator, before):
    """The only mutant of an operator in a line."""
    (found,) = [e for e in SITES if e.operator == operator and e.before.startswith(before)]
    return found


class Operators(unittest.TestCase):
    def test_strictness(self):
        line = 'bool before(double t, double end) { return t < end; }'
        self.assertEqual(made('strictness', line), {line.replace('<', '<=')})

    def test_sign(self):
        line = 'double total(double a, double b) { return a + b; }'
        self.assertEqual(made('sign', line), {line.replace('+', '-')})

    def test_dropped_term(self):
        line = 'double total(double a, double b) { return a + b; }'
        changed = {line.replace('a + b', 'a'), line.replace('a + b', 'b')}
        self.assertEqual(made('dropped term', line), changed)

    def test_min_for_max(self):
        line = 'double earliest(double a, double b) { return std::min(a, b); }'
        self.assertEqual(made('min for max', line), {line.replace('min', 'max')})

    def test_a_minimum_has_no_swapped_arguments(self):
        self.assertEqual(made('swapped arguments', 'double earliest'), set())

    def test_index(self):
        changed = {'return x[(i) + 1] - x[2];', 'return x[i] - x[1];'}
        found = {after.split(' //')[0] for after in made('index', 'return x[i]')}
        self.assertEqual(found, changed)

    def test_constant(self):
        self.assertEqual(
            made('constant', 'constexpr double limit'),
            {
                f'constexpr double limit = ({each});'
                for each in ('2 * 0.25', '10 * 0.25', '0.25 / 2')
            },
        )

    def test_statement_left_out(self):
        line = 'void merge(const Counts& other) { hits += other.hits; }'
        changed = {'void merge(const Counts& other) { }'}
        self.assertEqual(made('statement left out', line), changed)

    def test_swapped_arguments(self):
        line = 'if (!late && lo < hi) return span({lo, hi, limit}, 1);'
        changed = {
            line.replace('{lo, hi, limit}', each)
            for each in ('{hi, lo, limit}', '{lo, limit, hi}')
        }
        self.assertEqual(made('swapped arguments', line), changed)

    def test_negated_condition(self):
        line = 'if (!late && lo < hi) return span({lo, hi, limit}, 1);'
        changed = {
            line.replace('!late && lo < hi', '!(!late && lo < hi)'),
            line.replace('!late', 'late'),
        }
        self.assertEqual(made('negated condition', line), changed)

    def test_assertions_and_comments_are_left_alone(self):
        self.assertEqual([each for each in SITES if 'static_assert' in each.before], [])
        comment = TEXT.index('// x[0]')
        places = [edit.start for each in SITES for edit in each.edits]
        self.assertFalse(
            [place for place in places if comment <= place < TEXT.index('\n', comment)]
        )


class Switches(unittest.TestCase):
    def test_an_expression_is_chosen_by_its_number(self):
        text = with_switches(TEXT, [(7, only('sign', 'double total'), 'now')])
        self.assertIn('{ return (mutants::now(7) ? (a - b) : (a + b)); }', text)

    def test_a_statement_is_left_out_by_its_number(self):
        text = with_switches(TEXT, [(7, only('statement left out', 'void merge'), 'now')])
        self.assertIn('{ if (!mutants::now(7)) hits += other.hits; }', text)

    def test_a_constant_becomes_a_variable(self):
        mutation = [each for each in SITES if each.before.startswith('constexpr double limit')][0]
        text = with_switches(TEXT, [(7, mutation, 'now')])
        self.assertIn('\nconst double limit = (mutants::now(7) ? ((2 * 0.25)) : (0.25));', text)

    def test_what_is_constexpr_stays_so(self):
        (mutation, *_) = [each for each in SITES if each.before.startswith('constexpr int twice')]
        self.assertTrue(mutation.at_compile_time)

    def test_lines_keep_their_numbers(self):
        chosen = draw(SITES, ['fixture'], 1, 100)
        numbered = [(number, each, 'now') for number, each in enumerate(chosen, 1)]
        self.assertEqual(with_switches(TEXT, numbered).count('\n'), TEXT.count('\n'))

    def test_one_by_itself_is_the_edit(self):
        mutation = only('sign', 'double total')
        self.assertEqual(by_itself(TEXT, mutation), applied(TEXT, mutation.edits))


class Blame(unittest.TestCase):
    """Tests that an error of the compiler is attributed to the right mutants."""

    @classmethod
    def setUpClass(cls):
        name = f'tests/mutants/{FILE}'
        drawn = [replace(each, file=name) for each in draw(SITES, ['fixture'], 1, 100)]
        cls.mutants = Mutants(drawn)
        cls.in_constexpr = [each for each in drawn if each.at_compile_time]

    def test_one_on_the_line_of_the_error(self):
        (mutation, *_) = [each for each in self.mutants.drawn if not each.at_compile_time]
        block = f'/x/tree/{mutation.file}:{mutation.line}: error: no match'
        self.assertEqual(blamed(self.mutants, block), [mutation])

    def test_one_in_a_constexpr_function_that_is_evaluated_elsewhere(self):
        block = f'/x/tree/{self.mutants.drawn[0].file}:9999: error: non-constant condition'
        self.assertTrue(self.in_constexpr)
        self.assertEqual(blamed(self.mutants, block), self.in_constexpr)


class Draw(unittest.TestCase):
    def test_a_seed_gives_the_same_draw(self):
        names = [[each.name for each in draw(SITES, ['fixture'], 1, 5)] for _ in range(2)]
        self.assertEqual(*names)

    def test_another_seed_gives_another(self):
        self.assertNotEqual(draw(SITES, ['fixture'], 1, 5), draw(SITES, ['fixture'], 2, 5))

    def test_a_line_has_one_mutant(self):
        lines = [each.line for each in draw(SITES, ['fixture'], 1, 100)]
        self.assertEqual(len(lines), len(set(lines)))

    def test_mutants_have_names_of_their_own(self):
        self.assertEqual(len({each.name for each in SITES}), len(SITES))


class CompileCommands(unittest.TestCase):
    def test_arguments_with_blanks_stay_whole(self):
        with tempfile.TemporaryDirectory() as folder:
            command = 'g++ -DNAME="\\"GNU 12\\"" -o a.o -c /copy/ccd/a.cpp'
            entry = {'file': '/copy/ccd/a.cpp', 'command': command}
            (Path(folder) / 'compile_commands.json').write_text(json.dumps([entry]))
            compiled = Compiled(Path(folder), '/copy')
        self.assertEqual(compiled.arguments('ccd/a.cpp', '/copy'), ['-xc++', '-DNAME="GNU 12"'])


ENTRY = f'{FILE}\n- return lo;\n+ return hi;\n= for the test\n'


class Equivalent(unittest.TestCase):
    def test_an_entry_that_occurs_is_fine(self):
        self.assertEqual(list(complaints(entries(ENTRY), HERE)), [])

    def test_an_entry_that_does_not_occur_is_refused(self):
        wrong = entries(ENTRY.replace('- return lo;', '- return mid;'))
        self.assertEqual(list(complaints(wrong, HERE)), [f'{FILE}: does not contain: return mid;'])

    def test_an_entry_without_a_reason_is_refused(self):
        with self.assertRaises(ValueError):
            entries(ENTRY.replace('for the test', ''))


if __name__ == '__main__':
    unittest.main()

#!/usr/bin/python3
"""Tests that the operators make the right edits, that a seed always gives the same draw, that a mutant in a
layer does not change the copy, and that the tool checks its list of equivalent mutants against the sources."""

import unittest
from pathlib import Path
from tempfile import TemporaryDirectory
from unittest import mock

import copied
from draw import chosen, mutants_of
from equivalents import complaints, entries
from processes import run

FILE = 'slips.cpp'
TEXT = '''
static_assert(2 < 3);
double earliest(double a, double b) { return std::min(a, b); }
  return x[i] - x[2];  // x[0] + 1 < 2 in a comment
  hits += other.hits;
  total = a + b;
  if (!late && lo < hi) return span({lo, hi}, 0.25);
  throw Error(a + "b < c");
  if (a == b) say("a + b");
'''
SITES = mutants_of(FILE, TEXT)


class Operators(unittest.TestCase):
    def test_make_these_mutants(self):
        made = {}
        for each in SITES:
            made.setdefault(each.operator, set()).add(each.after.split(' //')[0])
        fine = 'if (!late && lo < hi) return span({lo, hi}, 0.25);'
        expected = {
            'strictness': {fine.replace('<', '<=')},
            'sign': {'return x[i] + x[2];', 'total = a - b;', 'hits -= other.hits;'},
            'equality': {'if (a != b) say("a + b");'},
            'dropped term': {'return x[i];', 'total = a;', 'total = b;'},
            'index': {'return x[i + 1] - x[2];', 'return x[i] - x[(2 - 1)];'},
            'constant': {fine.replace('0.25', each) for each in ('(2 * 0.25)', '(0.25 / 2)')},
            'statement left out': {';'},
            'swapped arguments': {
                fine.replace('lo, hi', 'hi, lo'),
                'double earliest(double a, double b) { return std::min(b, a); }',
            },
            'negated condition': {
                'if (!(!late && lo < hi)) return span({lo, hi}, 0.25);',
                'if (late && lo < hi) return span({lo, hi}, 0.25);',
                'if (!(a == b)) say("a + b");',
            },
            'min for max': {'double earliest(double a, double b) { return std::max(a, b); }'},
        }
        for operator, mutants in expected.items():
            self.assertEqual(made.get(operator), mutants, operator)
        self.assertEqual(set(made), set(expected))

    def test_a_mutant_changes_its_line(self):
        (strict,) = [each for each in SITES if each.operator == 'strictness']
        self.assertEqual(strict.where, f'{FILE}:7')
        self.assertEqual(strict.applied(TEXT), TEXT.replace('lo <', 'lo <='))


class Draw(unittest.TestCase):
    def test_a_seed_gives_the_same_draw_wherever_the_lines_are(self):
        moved = mutants_of(FILE, '\n' + TEXT)
        names = [[each.name for each in chosen(sites, 1, 4)] for sites in (SITES, moved)]
        self.assertEqual(*names)

    def test_another_seed_gives_another(self):
        self.assertNotEqual(chosen(SITES, 1, 4), chosen(SITES, 2, 4))

    def test_a_line_has_one_mutant(self):
        lines = [each.line for each in chosen(SITES, 1, 100)]
        self.assertEqual(len(lines), len(set(lines)))

    def test_mutants_have_names_of_their_own(self):
        twice = mutants_of(FILE, TEXT + TEXT)
        self.assertEqual(len({each.name for each in twice}), 2 * len(SITES))


class Layers(unittest.TestCase):
    def test_only_commands_in_a_layer_see_its_mutant(self):
        mutant = SITES[0]
        with TemporaryDirectory() as folder:
            base = Path(folder) / 'base'
            file = base / 'tree' / FILE
            file.parent.mkdir(parents=True)
            file.write_text(TEXT)
            with mock.patch.multiple(copied, BASE=base, COPY=base / 'tree'):
                layer = copied.Layer(Path(folder) / 'layer')
                if not layer.is_possible():
                    self.skipTest('overlayfs cannot be mounted here')
                layer.begin(mutant)
                seen = run(['cat', file], base, before=layer.words())
                run(['rm', file], base, before=layer.words())
                gone = run(['ls', file.parent], base, before=layer.words())
                layer.begin(mutant)
                again = run(['cat', file], base, before=layer.words())
                layer.end()
            self.assertEqual(seen.output, mutant.applied(TEXT))
            self.assertEqual(gone.output, '')
            self.assertEqual(again.output, mutant.applied(TEXT))
            self.assertEqual(file.read_text(), TEXT)


class Copies(unittest.TestCase):
    def test_follow_the_tree_and_leave_it_alone(self):
        with TemporaryDirectory() as folder:
            tree, copy = Path(folder) / 'tree', Path(folder) / 'copy'
            (tree / 'docs').mkdir(parents=True)
            (tree / 'docs' / 'table.csv').write_text('1,2')
            for code in ('', TEXT, ''):  # a folder gets its first C++ file, and loses its last one
                new = tree / 'docs' / 'new.cpp'
                new.write_text(code) if code else new.unlink(missing_ok=True)
                copied.mirror(tree, copy)
                self.assertEqual((tree / 'docs' / 'table.csv').read_text(), '1,2')
                self.assertFalse((tree / 'docs' / 'table.csv').is_symlink())
                self.assertEqual((copy / 'docs' / 'table.csv').read_text(), '1,2')
                self.assertEqual((copy / 'docs' / 'new.cpp').exists(), bool(code))


ENTRY = f'{FILE}\n- return x[i]\n+ return x[2]\n= for the test\n'


class Equivalent(unittest.TestCase):
    def test_an_entry_must_occur(self):
        listed = entries(ENTRY + ENTRY.replace('- return x[i]', '- return mid;'))
        with TemporaryDirectory() as folder:
            (Path(folder) / FILE).write_text(TEXT)
            found = list(complaints(listed, Path(folder)))
        self.assertEqual(found, [f'{FILE}: does not contain: return mid;'])

    def test_an_entry_without_a_reason_is_refused(self):
        with self.assertRaises(ValueError):
            entries(ENTRY.replace('for the test', ''))


if __name__ == '__main__':
    unittest.main()

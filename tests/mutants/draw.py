"""Draws mutants by a seed, evenly over folders and over operators.

The operators are substitutions in lines that clang-format has laid out, with blanks around binary operators
and none around the brackets of templates."""

import re
from collections import Counter
from dataclasses import replace
from itertools import zip_longest

import equivalents
from mutation import Mutation
from sources import ROOT, cpp_files, read, sha

# Each row has the operator's name, the pattern that the operator finds, and the text that replaces
# it. A mutant changes one place.
SUBSTITUTIONS = [
    ('strictness', r'(?<!template) (<|>) ', r' \1= '),
    ('strictness', r' (<|>)= ', r' \1 '),
    ('sign', r' \+(=?) ', r' -\1 '),
    ('sign', r' -(=?) ', r' +\1 '),
    ('sign', r'(?<=[(,=?:] )-(?=[\w(])|(?<=[(\[{])-(?=[\w(])', ''),
    ('equality', r' == ', ' != '),
    ('equality', r' != ', ' == '),
    (
        'dropped term',
        r' (?:[-+*/]|&&|\|\|) [\w.]+(?:\([^()]*\)|\[[^][]*\])?(?=[;),]| (?:[-+*/]|&&|\|\|) )',
        '',
    ),
    ('dropped term', r'(?<=[( ])[\w.]+(?:\([^()]*\)|\[[^][]*\])? (?:[+*]|&&|\|\|) ', ''),
    ('index', r'(?<=\w)\[([a-z]\w*)\]', r'[\1 + 1]'),
    ('index', r'(?<=[\[( ])0(?=[\]); ,])', '1'),
    ('index', r'(?<=[\[( ])1(?=[\]); ,])', '0'),
    ('index', r'(?<=[\[( ])([23])(?=[\]); ,])', r'(\1 - 1)'),
    (
        'constant',
        r'(?<=[( ])(?!0\.0\W)((?:\d+\.\d+|\d{2,}|[4-9])(?:e-?\d+)?)(?=[); ,])',
        r'(2 * \1)',
    ),
    ('constant', r'(?<=[( ])(?!0\.0\W)(\d+\.\d+(?:e-?\d+)?)(?=[); ,])', r'(\1 / 2)'),
    (
        'statement left out',
        r'^(\s+)(?!return|using)[\w.>\[\]-]+(?:\(.*\)| [-+*/|&]?= .*);$',
        r'\1;',
    ),
    ('statement left out', r'(?<=\) )(?:continue|break);$', ';'),
    ('swapped arguments', r'(?<![:<])([({])([\w.]+), ([\w.]+)(?=[,)}])', r'\1\3, \2'),
    ('negated condition', r'\bif \(([^;]*)\)(?= \w| \{|$)', r'if (!(\1))'),
    ('negated condition', r'(?<=[( ])!(?=[\w(])', ''),
    ('min for max', r'\b(std::)?min\(', r'\1max('),
    ('min for max', r'\b(std::)?max\(', r'\1min('),
    ('min for max', r'\blower_bound\(', 'upper_bound('),
    ('min for max', r'\bupper_bound\(', 'lower_bound('),
]
# Lines without mutants, because no test can notice a change, or because only the compiler reads them.
LEFT_ALONE = re.compile(
    r'\s*(#|//|/?\*|static_assert|template|using |throw |namespace )|.*\bError\('
)
# The text that operators ignore: quoted text, and a comment after //.
NO_CODE = re.compile(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])+\'(?!\d)|//.*')


def changed(line):
    """Yields each change that an operator makes to a line, as (operator, changed line)."""
    if LEFT_ALONE.match(line):
        return
    hidden = NO_CODE.sub(lambda found: '\0' * len(found[0]), line)
    code = hidden.rstrip('\0 ')
    for operator, pattern, replacement in SUBSTITUTIONS:
        for found in re.finditer(pattern, code):
            if '\0' not in found[0]:
                new = line[: found.start()] + found.expand(replacement) + line[found.end() :]
                if new != line:
                    yield operator, new


def mutants_of(file, text):
    """The mutants of a file, each once, in the order of the file's lines."""
    found, count = [], Counter()
    for number, line in enumerate(text.split('\n'), 1):
        operators = {}  # for each changed line, the first operator that makes it
        for operator, new in changed(line):
            operators.setdefault(new, operator)
        for new, operator in operators.items():
            mutation = Mutation(file, operator, number, line, new)
            found.append(replace(mutation, nth=count[mutation.identity]))
            count[mutation.identity] += 1
    return found


def in_turn(lists):
    """Interleaves lists: the first of each list, then the second of each, and so on."""
    return [each for row in zip_longest(*lists) for each in row if each is not None]


def chosen(mutations, seed, count):
    """Up to `count` mutants, with at most one mutant of each line. Takes a mutant of each operator
    in turn."""
    by_operator = {}
    for each in sorted(mutations, key=lambda each: sha(str(seed), each.identity)):
        by_operator.setdefault(each.operator, []).append(each)
    by_line = {}
    for each in in_turn(by_operator.values()):
        by_line.setdefault(each.where, each)
    return list(by_line.values())[:count]


def draw(folders, seed, count):
    """Draws equally many mutants from each folder, so that there are `count` or a few more in
    total. A folder may have too few mutants for its share."""
    known = equivalents.listed()
    drawn = []
    for folder in folders:
        found = [m for file in cpp_files([folder]) for m in mutants_of(file, read(ROOT / file))]
        drawn.append(chosen(found, seed, -(-count // len(folders))))
    return [replace(each, reason=equivalents.reason_of(known, each)) for each in in_turn(drawn)]

"""Writes the results as text."""

from collections import Counter, defaultdict

VERDICTS = ['noticed', 'survived', 'equivalent', 'invalid']


def columns(rows):
    widths = [max(len(str(cell)) for cell in column) for column in zip(*rows)]
    lines = []
    for first, *others in rows:
        cells = [str(cell).rjust(width) for cell, width in zip(others, widths[1:])]
        lines.append('  '.join([first.ljust(widths[0]), *cells]).rstrip())
    return '\n'.join(lines)


def scores(results):
    """A table with a line for each folder, a line for each operator, and a line for all mutants together."""
    groups = defaultdict(Counter)
    for mutation, result in results:
        for key in (f'{mutation.file.split("/")[0]}/', mutation.operator, 'all'):
            groups[key][result['verdict']] += 1
    rows = [['', 'mutants', 'score', *VERDICTS]]
    for key in sorted(groups, key=lambda each: (each == 'all', not each.endswith('/'), each)):
        count = groups[key]
        asked = count['noticed'] + count['survived']
        score = f'{100 * count["noticed"] / asked:.0f} %' if asked else ''
        rows.append([key, count.total(), score, *(count[each] or '' for each in VERDICTS)])
    return columns(rows)


def one(mutation, result):
    """Describes a mutant that no test noticed."""
    lines = [
        f'{mutation.where}  ({mutation.operator})',
        f'- {mutation.before}',
        f'+ {mutation.after}',
        f'  {result["asked"]} tests pass in {result["cpu"]:.0f} s',
    ]
    return '\n'.join(lines)


def table(results):
    """The whole table, from pairs of a mutant and its result."""
    left = [one(*each) for each in results if each[1]['verdict'] == 'survived']
    return '\n\n'.join([scores(results), 'Not noticed:', *left]) + '\n'

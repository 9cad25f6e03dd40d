"""Prints the results as text."""

from collections import Counter, defaultdict
from statistics import median


def columns(rows):
    widths = [max(len(str(row[i])) for row in rows) for i in range(len(rows[0]))]
    lines = []
    for row in rows:
        cells = [
            str(cell).ljust(width) if i == 0 else str(cell).rjust(width)
            for i, (cell, width) in enumerate(zip(row, widths))
        ]
        lines.append('  '.join(cells).rstrip())
    return '\n'.join(lines)


def percent(part, all_of_them):
    return f'{100 * part / all_of_them:.0f} %' if all_of_them else ''


def scores(results):
    """A table with a line for each folder, for each operator, and for all together."""
    rows = [
        [
            '',
            'mutants',
            'noticed',
            'score',
            'not noticed',
            'not reached',
            'equivalent',
            'not asked',
        ]
    ]
    groups = defaultdict(list)
    for mutation, result in results:
        for key in (f'{mutation.file.split("/")[0]}/', mutation.operator, 'all'):
            groups[key].append(result)
    order = [key for key in groups if key.endswith('/')]
    order += sorted(key for key in groups if not key.endswith('/') and key != 'all') + ['all']
    for key in order:
        count = Counter(result['verdict'] for result in groups[key])
        asked = count['noticed'] + count['survived'] + count['unreached']
        rows.append(
            [key, len(groups[key]), count['noticed'], percent(count['noticed'], asked)]
            + [count[each] or '' for each in ('survived', 'unreached', 'equivalent', 'open')]
        )
    return columns(rows)


def one(mutation, result):
    """Describes a mutant that no test noticed."""
    lines = [
        f'{mutation.where}  ({mutation.operator})',
        f'- {mutation.before}',
        f'+ {mutation.after}',
    ]
    if result['verdict'] == 'unreached':
        lines.append('  no test reaches it')
    elif 'asked' in result:
        left = result['unasked']
        rest = (
            f'; left out for lack of time: {", ".join(left[:3])}{" ..." if len(left) > 3 else ""}'
            if left
            else ''
        )
        lines.append(f'  {result["asked"]} tests pass in {result["cpu"]:.0f} s{rest}')
    return '\n'.join(lines)


def costs(results):
    """How soon mutants are noticed, by which tests, and which tests take longest without
    noticing any."""
    noticed = [result for _, result in results if result['verdict'] == 'noticed']
    asked = [result for _, result in results if 'spent' in result]
    lines = []
    if noticed:
        seconds = sorted(result['cpu'] for result in noticed)
        lines.append(
            f'noticed after {median(seconds):.2f} s of one core in the median, {seconds[-1]:.0f} s at most'
        )
    survived = [result['cpu'] for _, result in results if result['verdict'] == 'survived']
    if survived:
        lines.append(
            f'not noticed after {median(survived):.0f} s in the median, {max(survived):.0f} s at most'
        )
    by = Counter(result['noticed_by'] for result in noticed)
    lines.append(
        'noticed by: ' + ', '.join(f'{name} {count}' for name, count in by.most_common(12))
    )
    spent = Counter()
    for result in asked:
        spent.update(result['spent'])
    idle = [[name, f'{seconds:.0f} s', by[name]] for name, seconds in spent.most_common(15)]
    return '\n'.join(lines) + '\n\n' + columns([['test', 'asked for', 'noticed'], *idle])


def table(results):
    """The whole table, from pairs of a mutant and its result."""
    left = [one(*each) for each in results if each[1]['verdict'] in ('survived', 'unreached')]
    parts = [scores(results), costs(results), 'Not noticed:', *left]
    return '\n\n'.join(parts) + '\n'

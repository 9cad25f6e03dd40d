"""Checks texts in a report and in the output: headline, verdicts, tables, and lines with numbers.

Numbers in text are rounded. Therefore the expected texts are made from the numbers of
report.json, which other modules check."""

import itertools
import math
import re

from verdict_text import alarms, counted, fraction, headline, verdict, versions


def _whole(key):
    return lambda counts: f'{counts[key]:,}'


def _rounded(key, digits):
    return lambda counts: f'{counts[key]:.{digits}g}'


def _upper_end(key):
    return lambda counts: f'{counts[key][1]:.2g}'


# For each heading of a column: the text that a table shows, from the counters of its row.
COLUMNS = {
    'queries': _whole('queries'),
    'collisions': _whole('collisions'),
    'false neg.': _whole('false_negatives'),
    'missed': _whole('false_negatives'),
    'rate below*': _rounded('false_negative_rate_upper_95', 2),
    'late': lambda counts: f'{counts["late"]:,}' if counts['times_promised'] else '-',
    'false pos.': _whole('false_positives'),
    'max dist/bound': lambda counts: fraction(counts['max_fp_distance_over_bound'])
    + ('' if counts['bound_of_distances'] == 'claimed' else '**'),
    'sort': lambda counts: counts['time_sort'],
    'times': _whole('times_given'),
    'committed': lambda counts: f'{counts["committed"]:,}' if counts['times_promised'] else '-',
    'stuck': _whole('stuck'),
    'invalid': lambda counts: '0',  # there are no faults (check_counts.py)
    'unknown': _whole('unknown'),
    'early: median': _upper_end('median_early'),
    '99 %': _upper_end('q99_early'),
    'most': _rounded('max_early', 2),
    'after t*': _rounded('max_after', 2),
    'epsilon': lambda rung: f'2^{math.log2(rung["epsilon"]):.0f}',
    'farthest / B': _rounded('farthest', 3),
    'claimed / B': _rounded('claimed', 3),
}
# The headings of each table. Run times are not compared.
TIME = 'ns/query'
SUMMARY = (
    'subject  kind  queries  collisions  false neg.  rate below*  late  false pos.  max dist/bound'
)
SIZES = 'subject  kind  right with edges of  elsewhere  right at a distance of  elsewhere'
CLASSES = 'subject  kind  class  queries  collisions  false neg.  late  false pos.'
TIMES = (
    'subject  kind  class  sort  times  late  committed  stuck  invalid  unknown  '
    'early: median  99 %  most  after t*'
)
LADDER = 'subject  epsilon  queries  missed  false pos.  farthest / B  claimed / B'


def check_text(comparison, section, report, json_report):
    """Checks text in the report, and the output of nearmiss fuzz and nearmiss report."""
    rows, found = json_report['verdicts'], json_report['headline']
    for row in rows:
        expected = verdict(row, json_report['subjects'][row['subject']])
        comparison.same('text', f'{section} verdict of {row["subject"]}', row['text'], expected)
    expected = {
        'clean': all(row['clean'] for row in rows),
        'text': headline(json_report),
        'alarms': alarms(json_report),
    }
    comparison.same('text', f'{section} headline', found, expected)
    comparison.same('text', f'{section} complaint', json_report['oracle']['complaint'], '')
    for where, text in (('fuzz', report.fuzz_text), ('report', report.report_text)):
        _check_output(comparison, f'nearmiss {where}', text, json_report)
    if 'ladder' in json_report:
        _check_ladder(comparison, report.fuzz_text.splitlines(), json_report['ladder'])


def _check_output(comparison, where, text, report):
    """Checks the verdicts, the tables of counters, and the lines with numbers in the output of one
    command."""
    lines = text.splitlines()
    kinds = {
        (subject, kind): counts
        for subject, own in report['subjects'].items()
        for kind, counts in own.items()
    }
    classes = {
        (*key, name): of for key, counts in kinds.items() for name, of in counts['classes'].items()
    }
    timed = {key: of for key, of in classes.items() if of['times_given']}
    _check_table(comparison, where, lines, SUMMARY, kinds)
    if timed:
        _check_table(comparison, where, lines, TIMES, timed)
    if len({name for _, _, name in classes}) > 1:
        _check_table(comparison, where, lines, CLASSES, classes)
    _check_sizes(comparison, where, [re.split(r' {2,}', line.strip()) for line in lines], report)
    verdicts = [
        f'{" ok " if row["clean"] else "FAIL"} {row["subject"]}: {row["text"]}'
        for row in report['verdicts']
    ]
    _check_lines(comparison, f'{where} verdicts', lines, '(FAIL| ok ) ', verdicts)
    factors = [_common_factors(each) for each in report.get('common_factors', [])]
    _check_lines(comparison, f'{where} factors', lines, '.* % of the missed ones have ', factors)
    _check_lines(comparison, f'{where} versions', lines, '.* both fail, of ', versions(report))
    found = re.search(r'^oracle: .*\n.*$', text, re.MULTILINE)
    comparison.same('text', f'{where} oracle', found[0], _oracle(report['oracle']['total']))


def _check_sizes(comparison, where, lines, report):
    """Checks the table of sizes at which subjects are right. Empty cells are left out."""
    rows = report.get('sizes', [])
    if not rows:
        return
    first = lines.index(SIZES.split('  ')) + 1
    for line, row in zip(lines[first : first + len(rows)], rows):
        ranges = [row[factor] or {'values': '–', 'wrong': ''} for factor in ('edge', 'distance')]
        cells = [cell for each in ranges for cell in (each['values'], each['wrong'])]
        expected = [cell for cell in (row['subject'], row['kind'], *cells) if cell]
        comparison.same('text', f'{where} sizes {row["subject"]}', line, expected)


def _check_lines(comparison, where, lines, begin, expected):
    """Checks the lines whose beginning matches a regular expression."""
    found = [line for line in lines if re.match(begin, line)]
    comparison.same('text', where, found, expected)


def _check_table(comparison, where, lines, headings, sums):
    """Checks the table with these headings, whose last column may be run times. It has a row for
    each of the sums, whose names are in the first cells."""
    cells = [re.split(r' {2,}', line.strip()) for line in lines]
    headings = headings.split('  ')
    starts = [i for i, row in enumerate(cells) if row in (headings, [*headings, TIME])]
    comparison.same('text', f'{where} tables of {" ".join(headings)}', len(starts), 1)
    for start in starts:
        rows = list(itertools.takewhile(lambda row: len(row) > 1, cells[start + 1 :]))
        comparison.same('text', f'{where} number of rows', len(rows), len(sums))
        for row, (key, counts) in zip(rows, sums.items()):
            expected = [*key, *(COLUMNS[heading](counts) for heading in headings[len(key) :])]
            comparison.same('text', f'{where} row {" ".join(key)}', row[: len(headings)], expected)


def _check_ladder(comparison, lines, found):
    """Checks the table and the fits that nearmiss fuzz prints."""
    rungs = {(rung['subject'],): rung for rung in found['rungs']}
    _check_table(comparison, 'nearmiss fuzz ladder', lines, LADDER, rungs)
    fits = [_fit(each) for each in found['fits'] if not each['origin']]
    _check_lines(comparison, 'nearmiss fuzz fits', lines, '.* of the claimed distance', fits)


def _common_factors(found):
    """The line about the common factors of the missed collisions of a family."""
    return (
        f'{found["subject"]} {found["kind"]}, {found["family"]}: {found["false_negatives"]:,} of '
        f'{counted(found["collisions"], "collision")} missed; {found["text"]}'
    )


def _fit(found):
    """The line that describes a fit."""
    of = found['algorithm']
    subjects = f'{found["points"]} subjects with {found["precisions"]} precisions'
    ends = [fraction(found[f'{end}_part_of_claimed']) for end in ('least', 'greatest')]
    parts = f'{" to ".join(ends)} of the claimed distance'
    if found['restates_the_bound']:
        return f'{of}: the farthest are at {parts} for {subjects}'
    power = f'({found["exponent"]:.4f} +- {found["half_width_95"]:.2g}, 95 %)'
    return f'{of}: the farthest distance goes as epsilon^{power}, from {subjects}; at {parts}'


def _oracle(total):
    """The two lines about the oracle."""
    return (
        f'oracle: {total["queries"]:,} queries, {total["decided_by"]["undecided"]:,} left to exact '
        f'arithmetic by the filters; {total["compared"]:,} decided by all exact methods: they agree, '
        f'and {total["missed_by_parity"]:,} of {total["compared_collisions"]:,} collisions\n'
        'have an even number of roots, which root parity cannot see'
    )

"""Checks that the numbers in texts are those of report.json, which are checked elsewhere: in the
headline and the verdicts, and in the output of nearmiss fuzz and nearmiss report. The words around
them have unit tests."""

import itertools
import re
from collections import Counter

from enclosed import BORDERS, LARGEST
from tally import ON_REQUEST

NUMBER = r'(\d[\d,]*)'
# Columns of tables and their keys in report.json. Run times are left out.
COLUMNS = {
    'queries': 'queries',
    'collisions': 'collisions',
    'false neg.': 'false_negatives',
    'missed': 'false_negatives',
    'rate below*': 'false_negative_rate_upper_95',
    'false pos.': 'false_positives',
    'max dist/bound': 'max_fp_distance_over_bound',
    'sort': 'time_sort',
    'times': 'times_given',
    'late': 'late',
    'stuck': 'stuck',
    'unknown': 'unknown',
    'early: median': 'median_early',
    '99 %': 'q99_early',
    'most': 'max_early',
    'after t*': 'max_after',
    'epsilon': 'epsilon',
    'farthest / B': 'farthest',
    'claimed / B': 'claimed',
    'invalid': ('faults', 'invalid'),
}


def agrees(text, value):
    """Whether a number in text is a value, rounded to the digits of the text; of a range, its upper
    end."""
    text = text.removesuffix('**')
    if isinstance(value, list):
        value = value[1]
    if text == '-' or isinstance(value, str):
        return text == (value or '-')
    if text == 'inf' or value == LARGEST:
        return text == 'inf' and value == LARGEST
    if text.startswith('2^'):
        return 2.0 ** int(text[2:]) == value
    if text.startswith('below '):
        return 0 < value < BORDERS[0]
    if isinstance(value, int):
        return text == f'{value:,}'
    digits = len(re.sub(r'e.*|\D', '', text).lstrip('0')) or 1
    return float(text) == float(f'{value:.{digits}g}')


def _same(comparison, where, text, value):
    """A number in text must be a value."""
    if agrees(text, value):
        comparison.agree('text', 1)
    else:
        comparison.fail('text', where, text, value)


def numbers(text):
    """The whole numbers in a text."""
    return [int(number.replace(',', '')) for number in re.findall(NUMBER, text)]


def check_text(comparison, section, report, json_report):
    """Checks texts in the report, and the output of nearmiss fuzz and nearmiss report."""
    _check_headline(comparison, section, json_report)
    comparison.same('text', f'{section} complaint', json_report['oracle']['complaint'], '')
    for where, text in (('fuzz', report.fuzz_text), ('report', report.report_text)):
        _check_output(comparison, f'nearmiss {where}', text, json_report)


def _check_headline(comparison, section, report):
    """Checks the headline, the alarms and the verdicts. Each of their whole numbers is one of the
    subject's."""
    found, verdicts = report['headline'], report['verdicts']
    is_clean = all(verdict['clean'] for verdict in verdicts)
    comparison.same('text', f'{section} headline clean', found['clean'], is_clean)
    asked = numbers(found['text'].rpartition(', in ')[2])
    total = report['oracle']['total']['queries']
    comparison.same('text', f'{section} headline queries', asked, [total])
    alarming = [
        verdict['subject']
        for verdict in verdicts
        for failure in verdict['failures']
        if failure not in ON_REQUEST
    ]
    comparison.same('text', f'{section} alarms', len(found['alarms']), len(alarming))
    said = [
        *zip(alarming, found['alarms']),
        *((each['subject'], each['text']) for each in verdicts),
    ]
    for subject, text in said:
        text = text.removeprefix(f'{subject} ').partition('the farthest ')[0]
        wrong = set(numbers(text)) - _counts_of(report, subject)
        comparison.same('text', f'{section} numbers of {subject} in "{text}"', wrong, set())


def _counts_of(report, subject):
    """The counts of a subject: of each kind, of both, and of each class."""
    (verdict,) = (each for each in report['verdicts'] if each['subject'] == subject)
    kinds = list(report['subjects'][subject].values())
    by_name = [
        sum((Counter(of[key]) for of in kinds), Counter())
        for key in ('false_negatives_by_class', 'false_positives_by_stage')
    ]
    sums = [verdict['counts'], *verdict['classes'].values(), *by_name]
    for of in kinds:
        sums += [of, of['false_negatives_by_class'], *of['classes'].values()]
    return {value for each in sums for value in each.values() if isinstance(value, int)}


def _check_output(comparison, where, text, report):
    """Checks the verdicts, the tables, and the lines with numbers in the output of one command."""
    lines = text.splitlines()
    expected = [
        f'{" ok " if each["clean"] else "FAIL"} {each["subject"]}: {each["text"]}'
        for each in report['verdicts']
    ]
    comparison.same('text', f'{where} verdicts', lines[: len(expected)], expected)
    _check_tables(comparison, where, lines, report)
    _check_versions(comparison, where, lines, report.get('versions', []))
    total = report['oracle']['total']
    keys = ('queries', 'compared', 'missed_by_parity', 'compared_collisions')
    expected = [total[key] for key in keys]
    expected.insert(1, total['decided_by']['undecided'])
    found = re.search(r'^oracle: .*\n.*$', text, re.MULTILINE)
    comparison.same('text', f'{where} oracle', numbers(found[0]), expected)


def _check_versions(comparison, where, lines, rows):
    """Checks the line of each pair of versions: the sums, then what each class and kind has."""
    found = [line for line in lines if ' both fail, of ' in line]
    pairs = list(dict.fromkeys((row['before'], row['after']) for row in rows))
    comparison.same('text', f'{where} number of versions', len(found), len(pairs))
    keys = ('fixed', 'broken', 'both')
    for line, pair in zip(found, pairs):
        own = [row for row in rows if (row['before'], row['after']) == pair]
        expected = [sum(row[key] for row in own) for key in (*keys, 'queries')]
        expected += [row[key] for row in own for key in keys if row[key]]
        comparison.same('text', f'{where} {pair}', numbers(line.partition(': ')[2]), expected)


def _sums(report):
    """The counters that each table shows, by the first cells of its rows."""
    kinds = {
        (subject, kind): own[kind] for subject, own in report['subjects'].items() for kind in own
    }
    classes = {
        (*key, name): each for key, own in kinds.items() for name, each in own['classes'].items()
    }
    rungs = report.get('ladder', {}).get('rungs', [])
    return {
        'queries': kinds,
        'sort': {key: each for key, each in classes.items() if each['times_given']},
        'class': classes,
        'epsilon': {(rung['subject'],): rung for rung in rungs},
    }


def _check_tables(comparison, where, lines, report):
    """Checks each table whose first column is the subject."""
    cells = [re.split(r' {2,}', line.strip()) for line in lines]
    sums = _sums(report)
    expected = ['queries']
    expected += ['sort'] if sums['sort'] else []
    expected += ['class'] if len({key[2] for key in sums['class']}) > 1 else []
    expected += ['epsilon'] if where == 'nearmiss fuzz' and sums['epsilon'] else []
    starts = {_table(row): i for i, row in enumerate(cells) if _table(row)}
    comparison.same('text', f'{where} tables', list(starts), expected)
    for name, start in starts.items():
        rows = list(itertools.takewhile(lambda row: len(row) > 1, cells[start + 1 :]))
        for row, (key, counts) in zip(rows, sums[name].items()):
            comparison.same('text', f'{where} row of {name}', row[: len(key)], list(key))
            for heading, cell in zip(cells[start], row):
                if heading in COLUMNS:
                    place = f'{where} {" ".join(key)} {heading}'
                    _same(comparison, place, cell, _value(counts, COLUMNS[heading]))
        comparison.same('text', f'{where} rows of {name}', len(rows), len(sums[name]))


def _value(counts, key):
    """The value of a key; 0 for the count of a name that an object leaves out."""
    return counts[key] if isinstance(key, str) else counts[key[0]].get(key[1], 0)


def _table(row):
    """Which table has these headings: named by the heading that only it has among the first ones."""
    if row[:1] != ['subject']:
        return None
    return next(
        (name for name in ('epsilon', 'sort', 'class', 'queries') if name in row[:5]), None
    )

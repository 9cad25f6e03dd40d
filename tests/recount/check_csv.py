"""Checks that the CSV files of a report have the numbers of report.json, which other modules
check: statistics.csv, classes.csv, distances.csv, times.csv and findings.csv."""

import csv
import math

from check_findings import check_findings

# The columns with a count for each name: their prefix, and the object in report.json.
NAMED = {
    'fault_in_': 'faults_by_class',
    'fault_': 'faults',
    'missed_': 'false_negatives_by_class',
    'late_': 'late_by_class',
    'committed_': 'committed_by_class',
    'refuted_in_': 'refuted_bounds_by_class',
    'true_by_': 'true_positives_by_stage',
    'false_by_': 'false_positives_by_stage',
    'rejected_by_': 'rejected_by',
}
ENDS = ('_from', '_to')  # ends of the headings of a range's two columns


def read(folder, name):
    """The rows as dictionaries, with the headings as keys."""
    with open(folder / name, newline='', encoding='utf-8') as file:
        return list(csv.DictReader(file))


def number(text):
    """Converts text to an int if it is a whole number, or to a float if it is another number."""
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return text


def _rows(report, part):
    """The counters of each subject, kind and family (or class), in the order of the files."""
    return {
        (subject, kind, name): counts
        for subject, of_kinds in report['subjects'].items()
        for kind, of_kind in of_kinds.items()
        for name, counts in of_kind[part].items()
    }


def _value(counts, column):
    """The value in report.json for a column of statistics.csv."""
    for prefix, name in NAMED.items():
        if column.startswith(prefix):
            return counts[name].get(column.removeprefix(prefix), 0)
    for i, end in enumerate(ENDS):
        if column.endswith(end):
            name = column.removesuffix(end)
            own = counts[name]
            ends = own if isinstance(own, list) else counts[f'{name}_interval_95']
            return math.inf if ends[i] is None else ends[i]
    return counts['false_positives_measured_by_wang' if column == 'measured_by_wang' else column]


def _check_rows(comparison, name, rows, expected, of):
    """Checks the rows of statistics.csv or classes.csv; `of` is the heading of families or
    classes. Leaves out run times of single queries, because they are rounded."""
    found = [(row['subject'], row['kind'], row[of]) for row in rows]
    comparison.same('CSV', f'{name} rows', found, list(expected))
    for key, row in zip(found, rows):
        for column, text in row.items():
            if column not in ('subject', 'kind', of, 'median_ns', 'q99_ns'):
                where = f'{name} {" ".join(key)} {column}'
                comparison.same('CSV', where, number(text), _value(expected[key], column))


def _check_statistics(comparison, name, folder, report, _answers):
    """Checks all counters and measures by family. Columns name stages as report.json does."""
    rows = read(folder, name)
    by_stage = [column for column in rows[0] if column.startswith('true_by_')]
    expected = ['true_by_none', *(f'true_by_{stage}' for stage in report['stages'])]
    comparison.same('CSV', 'stages of report.json', by_stage, expected)
    _check_rows(comparison, name, rows, _rows(report, 'families'), 'family')


def _check_classes(comparison, name, folder, report, _answers):
    """Checks all counters and measures by class."""
    _check_rows(comparison, name, read(folder, name), _rows(report, 'classes'), 'class')


def _bins(report, histogram):
    """The borders and the count of each nonempty bin of a histogram."""
    borders = [*report['histogram_borders'], math.inf]
    return [(*borders[i : i + 2], count) for i, count in enumerate(histogram) if count]


def _check_bins(comparison, name, folder, expected):
    found = [tuple(map(number, row.values())) for row in read(folder, name)]
    comparison.same('CSV', f'{name} number of rows', len(found), len(expected))
    for i, (row, wanted) in enumerate(zip(found, expected)):
        comparison.same('CSV', f'{name} row {i + 1}', row, wanted)


def _check_distances(comparison, name, folder, report, _answers):
    """Checks the bins of the distances of false positives."""
    expected = [
        (*key, *each, counts['bound_of_distances'])
        for key, counts in _rows(report, 'families').items()
        for each in _bins(report, counts['fp_distance_histogram'])
    ]
    _check_bins(comparison, name, folder, expected)


def _check_times(comparison, name, folder, report, _answers):
    """Checks the bins of the errors of times, before and after the earliest time."""
    expected = [
        (*key, side, *each)
        for key, counts in _rows(report, 'families').items()
        for side in ('early', 'after')
        for each in _bins(report, counts[f'{side}_histogram'])
    ]
    _check_bins(comparison, name, folder, expected)


def _check_findings(comparison, name, folder, report, answers):
    """Checks that every finding is a query that fails in the recorded way."""
    rows = read(folder, name)
    comparison.same('CSV', f'{name} rows', len(rows), report['findings_total'])
    check_findings(comparison, f'{name} row', rows, 'query', report, answers)


# The check for each file.
CSV_CHECKS = {
    'statistics.csv': _check_statistics,
    'classes.csv': _check_classes,
    'distances.csv': _check_distances,
    'times.csv': _check_times,
    'findings.csv': _check_findings,
}

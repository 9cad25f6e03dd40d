"""Checks the CSV files of a report: statistics.csv, classes.csv, distances.csv, times.csv and
findings.csv."""

import csv

import numpy as np

from asking import KINDS
from check_numbers import ROUNDING, SOLVED, check_histogram, check_quantile, check_query
from check_sections import check_finding
from check_times import check_times
from enclosed import BINS, BORDERS
from tally import Tally, classes_of, denominators, interval, rate, stages, upper_bound


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


def keys(answers):
    """Subject, kind and family of every row, in order."""
    return [
        (subject, kind, family)
        for subject in answers.subjects
        for kind in KINDS
        for family in answers.families(kind)
    ]


def check_statistics_csv(comparison, _where, folder, answers, report):
    """Checks counters, rates and quantiles. The columns by stage must have the names in
    report.json."""
    statistics = read(folder, 'statistics.csv')
    by_stage = [name for name in statistics[0] if name.startswith('true_by_')]
    expected = ['true_by_none', *(f'true_by_{stage}' for stage in report['stages'])]
    comparison.same('CSV', 'stages of report.json', by_stage, expected)
    found = [(row['subject'], row['kind'], row['family']) for row in statistics]
    comparison.same('CSV', 'statistics.csv rows', found, keys(answers))
    for row in statistics:
        where = f'statistics.csv {row["subject"]} {row["kind"]} {row["family"]}'
        family = report['subjects'][row['subject']][row['kind']]['families'].get(row['family'])
        if family is not None:  # a report joins families that statistics.csv lists
            comparison.same('CSV', f'{where} class', row['class'], family['class'])
        tally = Tally.of(answers, row['subject'], [row['kind']], row['family'])
        _check_statistics(comparison, where, numbers(row), tally)


def check_classes_csv(comparison, _where, folder, answers, report):
    """Checks counters, rates and quantiles of the families of each class."""
    rows = read(folder, 'classes.csv')
    found = [(row['subject'], row['kind'], row['class']) for row in rows]
    expected = [
        (subject, kind, each)
        for subject in answers.subjects
        for kind in KINDS
        for each in report['subjects'][subject][kind]['classes']
    ]
    comparison.same('CSV', 'classes.csv rows', found, expected)
    for row in rows:
        families = report['subjects'][row['subject']][row['kind']]['families']
        members = classes_of({name: own['class'] for name, own in families.items()})
        if row['class'] in members:  # otherwise it is among the differences of the rows
            tally = Tally.of(answers, row['subject'], [row['kind']], members[row['class']])
            where = f'classes.csv {row["subject"]} {row["kind"]} {row["class"]}'
            _check_statistics(comparison, where, numbers(row), tally)


def numbers(row):
    """The row with numbers instead of text, where it is a number."""
    return {name: number(text) for name, text in row.items()}


def _check_statistics(comparison, where, row, tally):
    """Checks one row, except times."""
    for name in ('queries', 'collisions', 'positives', 'false_negatives', 'false_positives'):
        comparison.same('CSV', f'{where} {name}', row[name], getattr(tally, name))
    comparison.within('CSV', f'{where} refuted_bounds', row['refuted_bounds'], *tally.refuted())
    by_wang = 0 if tally.claims else tally.false_positives
    comparison.same('CSV', f'{where} by wang', row['measured_by_wang'], by_wang)
    of_negatives, of_positives = denominators(tally)
    lower, upper = interval(tally.false_positives, of_positives)
    for name, value in (
        ('false_negative_rate_upper_95', upper_bound(tally.false_negatives, of_negatives)),
        ('false_positive_rate', rate(tally.false_positives, of_positives)),
        ('false_positive_rate_from', lower),
        ('false_positive_rate_to', upper),
    ):
        comparison.near('CSV', f'{where} {name}', row[name], value, SOLVED)
    largest = row['max_fp_distance_over_bound']
    comparison.within(
        'CSV',
        f'{where} largest',
        largest,
        *(tally.ratios.largest()[0] if tally.false_positives else (0, 0)),
    )
    for name, part in (('median', 0.5), ('q99', 0.99)):
        ends = [row[f'{name}_fp_distance_over_bound_{end}'] for end in ('from', 'to')]
        check_quantile(
            comparison, f'{where} {name}', ends, tally.ratios.quantile_bins(part), largest
        )
    ranges = {
        name: [row[f'{name}_{end}'] for end in ('from', 'to')]
        for name in ('median_early', 'q99_early', 'q99_travelled')
    }
    check_times(comparison, where, {**row, **ranges, 'time_sort': tally.times.sort}, tally)
    for name, expected in (('true', tally.true_by_stage), ('false', tally.false_by_stage)):
        found = {key: n for key, n in row.items() if key.startswith(f'{name}_by_') and n}
        found = {key.removeprefix(f'{name}_by_'): n for key, n in found.items()}
        own, wanted = (stages(tally.subject, each) for each in (found, expected))
        comparison.same('CSV', f'{where} {name} by stage', own, wanted)
    missed = {
        key.removeprefix('missed_'): n for key, n in row.items() if key.startswith('missed_') and n
    }
    comparison.same('CSV', f'{where} missed by class', missed, tally.missed_by_class)
    rejected = sum(count for key, count in row.items() if key.startswith('rejected_by_'))
    comparison.same('CSV', f'{where} rejected', rejected, tally.queries - tally.positives)
    comparison.same(
        'CSV', f'{where} faults', sum(n for key, n in row.items() if key.startswith('fault_')), 0
    )


def bin_of(comparison, where, ends):
    """The bin with these ends."""
    lower, upper = np.concatenate(([0], BORDERS)), np.concatenate((BORDERS, [np.inf]))
    i = int(np.argmin(np.abs(upper[:-1] - ends[1]))) if ends[1] != np.inf else BINS - 1
    comparison.near('CSV', f'{where} from', ends[0], lower[i], ROUNDING)
    comparison.near('CSV', f'{where} to', ends[1], upper[i], ROUNDING)
    return i


def check_distances_csv(comparison, _where, folder, answers):
    """Checks the non-empty bins of the histograms."""
    bins = {key: [0] * BINS for key in keys(answers)}
    for row in read(folder, 'distances.csv'):
        where = f'distances.csv {row["subject"]} {row["kind"]} {row["family"]}'
        ends = [number(row[f'distance_over_bound_{end}']) for end in ('from', 'to')]
        claims = answers.asked[row['subject'], row['kind']].claims
        comparison.same('CSV', f'{where} bound', row['bound'], 'claimed' if claims else 'wang')
        i = bin_of(comparison, where, ends)
        bins[row['subject'], row['kind'], row['family']][i] += int(row['false_positives'])
    for (subject, kind, family), found in bins.items():
        ratios = Tally.of(answers, subject, [kind], family).ratios
        check_histogram(comparison, f'distances.csv {subject} {kind} {family}', found, ratios)


def check_times_csv(comparison, _where, folder, answers):
    """Checks the non-empty bins of the histograms of times, on both sides."""
    bins = {(*key, side): [0] * BINS for key in keys(answers) for side in ('early', 'after')}
    for row in read(folder, 'times.csv'):
        key = tuple(row[name] for name in ('subject', 'kind', 'family', 'side'))
        ends = [number(row[f'error_{end}']) for end in ('from', 'to')]
        i = bin_of(comparison, f'times.csv {" ".join(key)}', ends)
        bins[key][i] += int(row['times'])
    for (subject, kind, family, side), found in bins.items():
        errors = getattr(Tally.of(answers, subject, [kind], family).times, side)
        check_histogram(comparison, f'times.csv {subject} {kind} {family} {side}', found, errors)


def check_findings_csv(comparison, _where, folder, answers, report):
    """Checks that every finding is a query that fails in the recorded way."""
    rows = read(folder, 'findings.csv')
    comparison.same('CSV', 'findings.csv rows', len(rows), report['findings_total'])
    seen = {
        (each['what'], each['subject'], each['signature']): each['seen']
        for each in report['signatures']
    }
    for i, row in enumerate(rows):
        where = f'findings.csv row {i + 1}'
        check_finding(comparison, where, answers, row)
        signature = row['what'], row['subject'], row['signature']
        comparison.same('CSV', f'{where} seen', number(row['seen']), seen.get(signature))
        place = answers.place(row['kind'], row['provenance'])
        if place is not None:
            check_query(
                comparison,
                where,
                row['query'],
                answers.asked[row['subject'], row['kind']].judged[place],
            )

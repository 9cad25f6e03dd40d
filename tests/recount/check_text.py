"""Checks texts in a report and in the output: headline, verdicts, the summary's and the ladder's
tables.

Numbers in text are rounded. Therefore the expected texts are made from the numbers of report.json,
which are checked elsewhere."""

import re

from asking import KINDS
from verdict_text import failures_said, fraction, general, headline, verdict, versions


def check_text(comparison, section, report, json_report):
    """Checks text in the report, and the output of nearmiss fuzz and nearmiss report."""
    verdicts = {
        subject: verdict(subject, json_report) for subject in sorted(json_report['subjects'])
    }
    _check_headline(comparison, section, json_report, verdicts)
    _check_verdicts(comparison, section, json_report, verdicts)
    for where, text in (
        ('nearmiss fuzz', report.fuzz_text),
        ('nearmiss report', report.report_text),
    ):
        _check_output(comparison, where, text, json_report, verdicts)
    if 'ladder' in json_report:
        _check_ladder(comparison, report.fuzz_text.splitlines(), json_report['ladder'])


def _check_headline(comparison, section, json_report, verdicts):
    found = json_report['headline']
    expected = headline(json_report, verdicts)
    comparison.same('text', f'{section} headline', found['text'], expected)
    is_clean = all(clean for clean, _ in verdicts.values())
    comparison.same('text', f'{section} headline clean', found['clean'], is_clean)
    expected = [
        f'{subject} {said}'
        for subject in verdicts
        for _, said in failures_said(json_report['subjects'][subject])
    ]
    comparison.same('text', f'{section} headline alarms', found['alarms'], expected)


def _check_verdicts(comparison, section, json_report, verdicts):
    names = [each['subject'] for each in json_report['verdicts']]
    comparison.same('text', f'{section} verdicts', names, sorted(verdicts))
    for each in json_report['verdicts']:
        clean, text = verdicts.get(each['subject'], (None, None))
        where = f'{section} verdict of {each["subject"]}'
        comparison.same('text', where, each['text'], text)
        comparison.same('text', f'{where} clean', each['clean'], clean)
    complaint = json_report['oracle']['complaint']
    comparison.same('text', f"{section} the oracle's complaint", complaint, '')


def _check_output(comparison, where, text, json_report, verdicts):
    """Checks the verdicts, the table of counters, and the oracle's lines in the output of one
    command."""
    lines = text.splitlines()
    expected = [
        f'{" ok " if clean else "FAIL"} {subject}: {said}'
        for subject, (clean, said) in verdicts.items()
    ]
    comparison.same('text', f'{where} verdicts', lines[: len(expected)], expected)
    _check_table(comparison, where, lines, ['subject', 'kind', 'queries'], summary(json_report))
    if times(json_report):
        heading = ['subject', 'kind', 'class', 'sort']
        _check_table(comparison, where, lines, heading, times(json_report), last_is_time=False)
    if len({row[2] for row in class_rows(json_report)}) > 1:
        heading = ['subject', 'kind', 'class', 'queries']
        _check_table(comparison, where, lines, heading, class_rows(json_report))
    found = [line for line in lines if ' % of the missed ones have ' in line]
    expected = [common_factors(each) for each in json_report.get('common_factors', [])]
    comparison.same('text', f'{where} common factors', found, expected)
    found = [line for line in lines if ' both fail, of ' in line]
    comparison.same('text', f'{where} versions', found, versions(json_report))
    found = re.search(r'^oracle: .*\n.*$', text, re.MULTILINE)
    expected = oracle_line(json_report['oracle']['total'])
    comparison.same('text', f'{where} oracle', found and found[0], expected)


def _check_ladder(comparison, lines, found):
    """Checks the table and the fits that nearmiss fuzz prints."""
    heading = ['subject', 'epsilon']
    _check_table(comparison, 'nearmiss fuzz ladder', lines, heading, ladder(found))
    fits = [line for line in lines if ' of the claimed distance' in line]
    expected = [fit(each) for each in found['fits'] if not each['origin']]
    comparison.same('text', 'nearmiss fuzz fits', fits, expected)


def common_factors(found):
    """What the missed collisions of a family have in common, in words."""
    collisions = f'{found["collisions"]:,} collision{"" if found["collisions"] == 1 else "s"}'
    return (
        f'{found["subject"]} {found["kind"]}, {found["family"]}: {found["false_negatives"]:,} of '
        f'{collisions} missed; {found["text"]}'
    )


def summary(report):
    """The rows of the summary's table, without times."""
    rows = []
    for subject, own in report['subjects'].items():
        for kind in KINDS:
            c = own[kind]
            rows.append(
                [
                    subject,
                    kind,
                    f'{c["queries"]:,}',
                    f'{c["collisions"]:,}',
                    f'{c["false_negatives"]:,}',
                    general(c['false_negative_rate_upper_95'], 2),
                    late_times(c),
                    f'{c["false_positives"]:,}',
                    fraction(c['max_fp_distance_over_bound'])
                    + ('' if c['bound_of_distances'] == 'claimed' else '**'),
                ]
            )
    return rows


def late_times(counts):
    """The number of late times, if any were to be lower bounds."""
    return f'{counts["late"]:,}' if counts['times_promised'] else '-'


def classes(report):
    """The counters of each subject, kind and class."""
    return [
        ([subject, kind, name], each)
        for subject, own in report['subjects'].items()
        for kind in KINDS
        for name, each in own[kind]['classes'].items()
    ]


def times(report):
    """The rows of the table of times of impact."""
    return [
        [
            *key,
            each['time_sort'],
            f'{each["times_given"]:,}',
            late_times(each),
            f'{each["stuck"]:,}',
            '0',  # invalid; there are no faults (check_counts.py)
            f'{each["unknown"]:,}',
            *(general(each[f'{name}_early'][1], 2) for name in ('median', 'q99')),
            *(general(each[f'max_{side}'], 2) for side in ('early', 'after')),
        ]
        for key, each in classes(report)
        if each['times_given']
    ]


def class_rows(report):
    """The rows of the table by class, without times."""
    return [
        [
            *key,
            *(f'{each[counter]:,}' for counter in ('queries', 'collisions', 'false_negatives')),
            late_times(each),
            f'{each["false_positives"]:,}',
        ]
        for key, each in classes(report)
    ]


def ladder(found):
    """The rows of the ladder's table, without times."""
    return [
        [
            rung['subject'],
            f'2^{json_exponent(rung["epsilon"])}',
            f'{rung["queries"]:,}',
            f'{rung["false_negatives"]:,}',
            f'{rung["false_positives"]:,}',
            general(rung['farthest'], 3),
            general(rung['claimed'], 3),
        ]
        for rung in found['rungs']
    ]


def json_exponent(power_of_two):
    """The exponent x of 2^x."""
    return int(power_of_two.hex().partition('p')[2])


def fit(found):
    """The line that describes a fit."""
    of = found['algorithm']
    subjects = f'{found["points"]} subjects with {found["precisions"]} precisions'
    ends = [fraction(found[f'{end}_part_of_claimed']) for end in ('least', 'greatest')]
    parts = f'{" to ".join(ends)} of the claimed distance'
    if found['restates_the_bound']:
        return f'{of}: the farthest are at {parts} for {subjects}'
    power = f'({found["exponent"]:.4f} +- {found["half_width_95"]:.2g}, 95 %)'
    return f'{of}: the farthest distance goes as epsilon^{power}, from {subjects}; at {parts}'


def oracle_line(total):
    """The two lines about the oracle."""
    parts = [
        f'oracle: {total["queries"]:,} queries',
        f' {total["decided_by"]["undecided"]:,} left to exact arithmetic by the filters; '
        f'{total["compared"]:,} decided by all exact methods: they agree',
        f' and {total["missed_by_parity"]:,} of {total["compared_collisions"]:,} collisions\n'
        'have an even number of roots',
        ' which root parity cannot see',
    ]
    return ','.join(parts)


def _check_table(comparison, where, lines, heading, rows, last_is_time=True):
    """Checks the rows below the line that begins with the heading. A run time in the last column is
    left out."""
    cells = [re.split(r' {2,}', line.strip()) for line in lines]
    start = next((i for i, row in enumerate(cells) if row[: len(heading)] == heading), None)
    if start is None:
        return comparison.fail('text', where, 'no table', ' '.join(heading))
    end = next(i for i in range(start, len(cells) + 1) if i == len(cells) or len(cells[i]) < 2)
    found = [row[:-1] if last_is_time else row for row in cells[start + 1 : end]]
    comparison.same('text', f'{where} number of rows', len(found), len(rows))
    for row, expected in zip(found, rows):
        comparison.same('text', f'{where} row {" ".join(expected[:2])}', row, expected)

"""Checks texts in a report and in the output: headline, verdicts, the summary's and the ladder's
tables.

Numbers in text are rounded. Therefore the expected texts are made from the numbers of report.json,
which are checked elsewhere."""

import re

from asking import KINDS
from enclosed import BORDERS, LARGEST
from tally import CLASSES

WANGS = "wang's"


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


# The failures that count, the gravest first: the name, the counter, its total, and the words for it.
FAILURES = (
    ('miss', 'false_negatives', 'collisions', 'missed', 'collision'),
    ('late', 'late', 'times_promised', 'was late in', 'time'),
    (
        'beyond-bound',
        'refuted_bounds',
        'false_positives',
        'exceeded its bound in',
        'false positive',
    ),
)


def verdict(subject, report):
    """Whether a subject is clean, with the text of its verdict. A campaign that is recomputed has no
    faults."""
    found = report['error_against_time']['subjects'][subject]
    kinds = report['subjects'][subject]
    unknown = sum(kinds[kind]['false_positives_by_stage'].get('unknown', 0) for kind in KINDS)
    missed, late, refuted = (found[counter] for _, counter, *_ in FAILURES)
    if missed:
        parts = [f'MISSED {class_by_class(kinds, "false_negatives", "collisions")}']
    else:
        parts = [f'no miss in {counted(found["collisions"], "collision")}']
    if late:
        parts.append(f'LATE {class_by_class(kinds, "late", "times_promised")}')
    if refuted:
        parts.append(f'{refuted:,} BEYOND ITS BOUND')
    if found['unknown']:
        of = counted(found['queries'], 'query', 'queries')
        parts.append(f'UNKNOWN in {found["unknown"]:,} of {of}')
    parts.append(false_positives(found, unknown))
    is_clean = not missed and not late and not refuted
    return is_clean, ('; ' if missed or late else ', ').join(parts)


def false_positives(found, unknown):
    """How many there are, and the farthest. The number of those that are unknown is given."""
    if found['false_positives'] == 0:
        return 'no false positive'
    text = counted(found['false_positives'], 'false positive')
    if unknown == found['false_positives']:
        return text + ', all unknown'
    if unknown:
        text += f', {unknown:,} of them unknown'
    largest = found['max_fp_distance_over_bound']
    claims = found['bound_of_distances'] == 'claimed'
    if largest == LARGEST:
        far = f'beyond {"a" if claims else WANGS} bound of 0'
    else:
        far = f'at {fraction(largest)} {"of the" if claims else f"times {WANGS}"} bound'
    return f'{text}, the farthest {far}' + ('' if claims else ' (it claims none)')


def by_class(kinds, counter, total):
    """For each class in which there are some of the total: the count and the total of each kind."""
    classes = {
        name: {
            kind: (kinds[kind]['classes'][name][counter], kinds[kind]['classes'][name][total])
            for kind in KINDS
            if name in kinds[kind]['classes'] and kinds[kind]['classes'][name][total]
        }
        for name in CLASSES
    }
    return {name: of_kinds for name, of_kinds in classes.items() if of_kinds}


def class_by_class(kinds, counter, total):
    """ "ordinary vt 53 of 504, ee 0 of 701; degenerate 1,204 of 5,001": the first class by kind."""
    parts = []
    for name, of_kinds in by_class(kinds, counter, total).items():
        if parts:
            count, whole = map(sum, zip(*of_kinds.values()))
            text = f'{count:,} of {whole:,}'
        else:
            text = ', '.join(
                f'{kind} {count:,} of {whole:,}' for kind, (count, whole) in of_kinds.items()
            )
        parts.append(f'{name} {text}' if parts or name != 'unclassified' else text)
    return '; '.join(parts)


def failures_said(kinds):
    """The class and the words for each failure of a subject, the gravest first: in the least exotic
    class in which it was seen."""
    for _, counter, total, verb, noun in FAILURES:
        for name, of_kinds in by_class(kinds, counter, total).items():
            failed = {kind: each for kind, each in of_kinds.items() if each[0]}
            if failed:
                own = '' if name == 'unclassified' else f'{name} '
                some = [f'{n:,} of {whole:,} {own}{kind}' for kind, (n, whole) in failed.items()]
                is_one = [whole for _, whole in failed.values()] == [1]
                yield name, f'{verb} {" and ".join(some)} {noun}{"" if is_one else "s"}'
                break


def headline(report, verdicts):
    """The verdict in a line."""
    failed = {}
    for subject, (clean, _) in verdicts.items():
        if not clean:
            said = list(failures_said(report['subjects'][subject]))
            name, first = min(said, key=lambda each: CLASSES.index(each[0]))
            failed.setdefault(name, []).append((subject, first))
    if [len(group) for group in failed.values()] == [1]:
        ((subject, first),) = next(iter(failed.values()))
        parts = [f'{subject} failed: it {first}']
    else:
        parts = [
            f'{listed([subject for subject, _ in failed[name]])} failed {name} queries'
            for name in CLASSES
            if name in failed
        ]
    clean = [subject for subject, (is_clean, _) in verdicts.items() if is_clean]
    if clean:
        parts.append(f'{listed(clean)} did not fail')
    queries = report['oracle']['total']['queries']
    return '; '.join(parts) + f', in {counted(queries, "query", "queries")}.'


def listed(names):
    """ "a, b and c", or the number of names if there are more than eight."""
    if len(names) > 4:
        return f'{len(names)} subjects'
    return ' and '.join([', '.join(names[:-1]), names[-1]]) if len(names) > 1 else names[0]


def counted(count, one, many=None):
    """A number and the noun that it counts."""
    return f'{count:,} {one if count == 1 else many or one + "s"}'


def general(number, digits):
    """C's %.*g."""
    return f'{number:.{digits}g}'


def fraction(ratio):
    """A ratio with three digits, or more if a ratio below 1 would be rounded to 1."""
    if ratio == LARGEST:
        return 'inf'
    if 0 < ratio < BORDERS[0]:
        return 'below 1e-16'
    return next(
        text
        for text in (general(ratio, digits) for digits in range(3, 18))
        if ratio >= 1 or text != '1'
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

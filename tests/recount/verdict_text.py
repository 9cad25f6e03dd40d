"""The expected text of verdicts: of each subject, of each pair of versions, and of the headline."""

from asking import KINDS
from enclosed import BORDERS, LARGEST
from tally import CLASSES

WANGS = "wang's"


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


def versions(json_report):
    """A line for each pair of versions that were asked both kinds."""
    rows = json_report.get('versions', [])
    texts = {'fixed': 'fixed', 'broken': 'broken', 'both': 'both fail'}

    def words(of, keys):
        return ', '.join(f'{of[key]:,} {texts[key]}' for key in keys)

    lines = []
    for before, after in dict.fromkeys((row['before'], row['after']) for row in rows):
        own = [row for row in rows if (row['before'], row['after']) == (before, after)]
        total = {key: sum(row[key] for row in own) for key in (*texts, 'queries')}
        parts = [
            f'{row["class"]} {row["kind"]} {words(row, keys)}'
            for row in own
            if (keys := [key for key in texts if row[key]])
        ]
        queries = counted(total['queries'], 'query', 'queries')
        inside = f' ({"; ".join(parts)})' if parts else ''
        lines.append(f'{after} against {before}: {words(total, texts)}, of {queries}{inside}')
    return lines


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
    if nearer := class_of_missed(kinds):
        count = sum(missed_by_class(of, nearer) for of in kinds.values())
        parts.append(f'{count:,} of the missed queries {"is" if count == 1 else "are"} {nearer}')
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
        of = f'times {WANGS}' if not claims else 'of the' if largest <= 1 else 'times the'
        far = f'at {fraction(largest)} {of} bound'
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


def missed_by_class(counts, name):
    """How many queries of a class a subject missed."""
    return counts['false_negatives_by_class'].get(name, 0)


def class_of_missed(kinds):
    """The least exotic class of the queries that a subject missed, if no family of this class or a
    less exotic one has a miss."""
    for name in CLASSES:
        own = [of['classes'][name] for of in kinds.values() if name in of['classes']]
        if any(of['false_negatives'] for of in own):
            return None
        if any(missed_by_class(of, name) for of in kinds.values()):
            return name
    return None


def queries_said(kinds, name):
    """ "missed 12 ordinary vt collisions in degenerate families" """
    missed = {kind: missed_by_class(of, name) for kind, of in kinds.items()}
    families = [
        each
        for each in CLASSES[:3]
        if any(
            missed_by_class(of['classes'][each], name)
            for of in kinds.values()
            if each in of['classes']
        )
    ]
    some = ' and '.join(f'{n:,} {name} {kind}' for kind, n in missed.items() if n)
    noun = 'collision' if sum(missed.values()) == 1 else 'collisions'
    return f'missed {some} {noun} in {" and ".join(families)} families'


def failures_said(kinds):
    """The class and the words for each failure of a subject, the gravest first: in the least exotic
    class in which it was seen."""
    nearer = class_of_missed(kinds)
    if nearer:
        yield nearer, queries_said(kinds, nearer)
    for failure, counter, total, verb, noun in FAILURES:
        if nearer and failure == 'miss':
            continue
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
    """ "a, b and c", or the number of names if there are more than four."""
    if len(names) > 4:
        return f'{len(names)} subjects'
    return ' and '.join([', '.join(names[:-1]), names[-1]]) if len(names) > 1 else names[0]

"""The expected text of verdicts on subjects and on pairs of versions, and of the headline."""

from enclosed import BORDERS, LARGEST
from tally import CLASSES

# The failures that count, the gravest first: the counter, its total, its counter by the class of
# the query, the verb, and the noun.
MISS = 'false_negatives', 'collisions', 'false_negatives_by_class', 'missed', 'collision'
LATE = 'late', 'times_promised', 'late_by_class', 'was late in', 'time'
UNSAFE = (
    'unsafe_steps',
    'times_promised',
    'committed_by_class',
    'promised a free step that has contact in',
    'time',
)
BEYOND = (
    'refuted_bounds',
    'false_positives',
    'refuted_bounds_by_class',
    'exceeded its bound in',
    'false positive',
)
FAILURES = MISS, LATE, UNSAFE, BEYOND


def counted(count, one, many=None):
    """A number and the noun that it counts."""
    return f'{count:,} {one if count == 1 else many or one + "s"}'


def fraction(ratio):
    """A ratio with three digits. If these would round a ratio below 1 to 1, it has more digits."""
    if ratio == LARGEST:
        return 'inf'
    if 0 < ratio < BORDERS[0]:
        return 'below 1e-16'
    texts = (f'{ratio:.{digits}g}' for digits in range(3, 18))
    return next(text for text in texts if ratio >= 1 or text != '1')


def versions(report):
    """A line for each pair of versions that were asked the same kinds."""
    rows = report.get('versions', [])
    names = {'fixed': 'fixed', 'broken': 'broken', 'both': 'both fail'}
    lines = []
    for before, after in dict.fromkeys((row['before'], row['after']) for row in rows):
        own = [row for row in rows if (row['before'], row['after']) == (before, after)]
        words = [f'{sum(row[key] for row in own):,} {name}' for key, name in names.items()]
        queries = counted(sum(row['queries'] for row in own), 'query', 'queries')
        parts = []
        for row in own:
            some = [f'{row[key]:,} {name}' for key, name in names.items() if row[key]]
            parts += [f'{row["class"]} {row["kind"]} {", ".join(some)}'] if some else []
        inside = f' ({"; ".join(parts)})' if parts else ''
        lines.append(f'{after} against {before}: {", ".join(words)}, of {queries}{inside}')
    return lines


def verdict(row, kinds):
    """The text of a subject's verdict. `row` is its row in the section verdicts, and `kinds` has
    its counters of each kind. A campaign that is recomputed has no faults."""
    counts = row['counts']
    parts = []
    if not counts['false_negatives']:
        parts = [f'no miss in {counted(counts["collisions"], "collision")}']
    for failure, title, name in (
        (MISS, 'MISSED', 'missed'),
        (LATE, 'LATE', 'late'),
        (UNSAFE, 'UNSAFE STEPS', 'unsafe'),
        (BEYOND, 'BEYOND ITS BOUND', 'refuting'),
    ):
        if counts[failure[0]]:
            parts.append(f'{title} {_class_by_class(kinds, failure)}')
            parts += _other_class(kinds, failure, name)
    if counts['committed'] > counts['unsafe_steps']:
        sound = counts['times_promised'] - counts['late']
        parts.append(
            f'{counts["committed"]:,} of {sound:,} sound times lead to a step that touches, once rounded'
        )
    if counts['unknown']:
        of = counted(counts['queries'], 'query', 'queries')
        parts.append(f'UNKNOWN in {counts["unknown"]:,} of {of}')
    unknown = sum(of['false_positives_by_stage'].get('unknown', 0) for of in kinds.values())
    parts.append(_false_positives(counts, unknown))
    has_list = any(counts[failure[0]] for failure in FAILURES)
    return ('; ' if has_list else ', ').join(parts)


def _other_class(kinds, failure, name):
    """Such as "3 of the missed queries are ordinary", or "all missed queries are extreme", if the
    least exotic class of the queries is not that of the families."""
    of, families = _class_of_queries(kinds, failure), _class_of_families(kinds, failure)
    if CLASSES.index(of) > CLASSES.index(families):
        return [f'all {name} queries are {"degenerate or extreme" if of == CLASSES[1] else of}']
    count = sum(_of_class(each, failure, of) for each in kinds.values())
    text = f'{count:,} of the {name} queries {"is" if count == 1 else "are"} {of}'
    return [] if of == families else [text]


def _false_positives(counts, unknown):
    """The number of false positives, how many are unknown, and the farthest one's ratio."""
    if counts['false_positives'] == 0:
        return 'no false positive'
    text = counted(counts['false_positives'], 'false positive')
    if unknown == counts['false_positives']:
        return text + ', all unknown'
    if unknown:
        text += f', {unknown:,} of them unknown'
    largest = counts['max_fp_distance_over_bound']
    claims = counts['bound_of_distances'] == 'claimed'
    if largest == LARGEST:
        far = 'beyond a bound of 0' if claims else "beyond wang's bound of 0"
    else:
        of = "times wang's" if not claims else 'of the' if largest <= 1 else 'times the'
        far = f'at {fraction(largest)} {of} bound'
    return f'{text}, the farthest {far}' + ('' if claims else ' (it claims none)')


def _by_class(kinds, failure):
    """The count and the total of each kind, for each class whose total is not 0."""
    counter, total, *_ = failure
    classes = {}
    for name in CLASSES:
        own = {kind: of['classes'].get(name) for kind, of in kinds.items()}
        some = {kind: (of[counter], of[total]) for kind, of in own.items() if of and of[total]}
        if some:
            classes[name] = some
    return classes


def _class_by_class(kinds, failure):
    """Such as "ordinary vt 53 of 504, ee 0 of 701; degenerate 1,204 of 5,001". Only the first
    class is divided by kind."""
    parts = []
    for name, of_kinds in _by_class(kinds, failure).items():
        if parts:
            count, whole = map(sum, zip(*of_kinds.values()))
            text = f'{count:,} of {whole:,}'
        else:
            text = ', '.join(f'{kind} {n:,} of {whole:,}' for kind, (n, whole) in of_kinds.items())
        parts.append(f'{name} {text}' if parts or name != 'unclassified' else text)
    return '; '.join(parts)


def _of_class(counts, failure, name):
    """The number of queries of a class on which a subject failed in this way."""
    return counts[failure[2]].get(name, 0)


def _class_of_queries(kinds, failure):
    """The least exotic class of the queries on which a subject failed in this way, or None."""
    own = (
        name for name in CLASSES[:3] if any(_of_class(of, failure, name) for of in kinds.values())
    )
    return next(own, None)


def _class_of_families(kinds, failure):
    """The least exotic class of the families in which a subject failed in this way."""
    return next(
        name
        for name, of_kinds in _by_class(kinds, failure).items()
        if any(count for count, _ in of_kinds.values())
    )


def _said(kinds, failure, name):
    """Such as "missed 53 of 504 ordinary vt collisions, and 12 ordinary ee collisions in
    degenerate families"."""
    *_, verb, noun = failure
    own = '' if name == 'unclassified' else f'{name} '
    failed = {
        kind: each
        for kind, each in _by_class(kinds, failure).get(name, {}).items()
        if _of_class(kinds[kind]['classes'][name], failure, name)
    }
    parts = []
    if failed:
        some = [f'{n:,} of {whole:,} {own}{kind}' for kind, (n, whole) in failed.items()]
        is_one = [whole for _, whole in failed.values()] == [1]
        parts.append(f'{" and ".join(some)} {noun}{"" if is_one else "s"}')
    others = {
        kind: count
        for kind, of in kinds.items()
        if kind not in failed and (count := _of_class(of, failure, name))
    }
    if others:
        families = [
            each
            for each in CLASSES[:3]
            if any(
                _of_class(kinds[kind]['classes'][each], failure, name)
                for kind in others
                if each in kinds[kind]['classes']
            )
        ]
        some = ' and '.join(f'{n:,} {own}{kind}' for kind, n in others.items())
        inside = f' in {" and ".join(families)} families' if families else ''
        parts.append(f'{some} {noun}{"" if sum(others.values()) == 1 else "s"}{inside}')
    return f'{verb} {", and ".join(parts)}'


def _failures_said(kinds):
    """For each failure of a subject, the gravest first: the least exotic class in which it was
    seen, and the words for it."""
    for failure in FAILURES:
        if any(of[failure[0]] for of in kinds.values()):
            name = _class_of_queries(kinds, failure)
            yield name, _said(kinds, failure, name)


def alarms(report):
    """The text of each alarm: one for each failure of each subject."""
    return [
        f'{subject} {said}'
        for subject, kinds in report['subjects'].items()
        for _, said in _failures_said(kinds)
    ]


def headline(report):
    """The verdict on the campaign in a line."""
    failed, clean = {}, []
    for subject, kinds in report['subjects'].items():
        if said := list(_failures_said(kinds)):
            name, first = min(said, key=lambda each: CLASSES.index(each[0]))
            failed.setdefault(name, []).append((subject, first))
        else:
            clean.append(subject)
    if [len(group) for group in failed.values()] == [1]:
        ((subject, first),) = next(iter(failed.values()))
        parts = [f'{subject} failed: it {first}']
    else:
        parts = [
            f'{_listed([subject for subject, _ in failed[name]])} failed {name} queries'
            for name in CLASSES
            if name in failed
        ]
    parts += [f'{_listed(clean)} did not fail'] if clean else []
    queries = counted(report['oracle']['total']['queries'], 'query', 'queries')
    return f'{"; ".join(parts)}, in {queries}.'


def _listed(names):
    """Such as "a, b and c". If there are more than four names, only their number."""
    if len(names) > 4:
        return f'{len(names)} subjects'
    return ' and '.join([', '.join(names[:-1]), names[-1]]) if len(names) > 1 else names[0]

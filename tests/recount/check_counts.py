"""Checks the counters of report.json, and of the JSON of nearmiss fuzz, against tallies of single
answers: the counters of each subject, kind and family, their sums in other sections, and the
comparison of versions."""

import math
from collections import Counter

import numpy as np

from asking import KINDS
from check_findings import check_kept
from check_numbers import ROUNDING, SOLVED, check_histogram, quantile
from comparison import Near, Within
from tally import (
    CLASSES,
    ON_REQUEST,
    Tally,
    classes_of,
    denominators,
    failures_of,
    interval,
    rate,
    stages,
    upper_bound,
)

MESHES = KINDS[:2]  # the precision ladder counts only these kinds


def check_statistics(comparison, where, json, answers):
    """Checks the sections "subjects", "oracle" and "signatures"."""
    _check_oracle(comparison, f'{where} oracle', json['oracle'], answers)
    _check_signatures(comparison, f'{where} signatures', json['signatures'], answers)
    subjects = json['subjects']
    comparison.same('names', f'{where} subjects', sorted(subjects), answers.subjects)
    for subject in answers.subjects:
        comparison.same(
            'names', f'{where} {subject}', tuple(subjects[subject]), answers.kinds(subject)
        )
        for kind in answers.kinds(subject):
            place, found = f'{where} {subject} {kind}', subjects[subject][kind]
            families, classes = found['families'], found['classes']
            members = classes_of({name: own['class'] for name, own in families.items()})
            comparison.same('names', f'{place} families', sorted(families), answers.families(kind))
            comparison.same('names', f'{place} classes', list(classes), list(members))
            sums = [('', found, None)]
            sums += [(name, families[name], name) for name in answers.families(kind)]
            sums += [(name, classes[name], of_class) for name, of_class in members.items()]
            for name, own, of in sums:
                _check_sum(comparison, f'{place} {name}', own, answers, subject, kind, of)


def _check_sum(comparison, where, found, answers, subject, kind, families):
    """Checks all counters (except run times) of one subject for the queries of some families, and the
    extreme cases among these queries."""
    tally = Tally.of(answers, subject, [kind], families)
    check_rates(comparison, where, found, tally)
    expected = {'positives': tally.positives, 'faults': {}, 'faults_by_class': {}}
    comparison.entries('counters', where, found, expected)
    for name in ('false_negatives', 'late', 'committed', 'refuted_bounds'):
        by_class = sum(found[f'{name}_by_class'].values())
        comparison.same('counters', f'{where} {name} by class', by_class, found[name])
    for name, by_stage in (('true', tally.true_by_stage), ('false', tally.false_by_stage)):
        own = stages(subject, found[f'{name}_positives_by_stage'])
        comparison.same('stages', f'{where} {name}', own, stages(subject, by_stage))
    rejected = sum(found['rejected_by'].values())
    comparison.same('stages', f'{where} rejected', rejected, tally.queries - tally.positives)
    for name, enclosed in tally.enclosed.items():
        check_histogram(comparison, f'{where} {name}', found[f'{name}_histogram'], enclosed)
    check_kept(comparison, where, found, tally, answers, kind)


def check_rates(comparison, where, found, tally):
    """Checks the measures, except run times, that report.json has for every sum of counters."""
    comparison.entries('counters', where, found, measures(found, tally))


def measures(found, tally):
    """Maps the key of each measure to its expected value. A quantile's bin may end at the largest
    number, which is taken from `found`."""
    missed, false = tally.false_negatives, tally.false_positives
    of_negatives, of_positives = denominators(tally)
    times, by_wang = tally.times, 0 if tally.claims else false
    largest = found['max_fp_distance_over_bound']

    def ends(count, total):
        return tuple(Near(end, SOLVED) for end in interval(count, total))

    return {
        'queries': tally.queries,
        'collisions': tally.collisions,
        'false_negatives': missed,
        'false_negative_rate': Near(rate(missed, of_negatives), ROUNDING),
        'false_negative_rate_upper_95': Near(upper_bound(missed, of_negatives), SOLVED),
        'false_negative_rate_interval_95': ends(missed, of_negatives),
        'false_positives': false,
        'false_positive_rate': Near(rate(false, of_positives), ROUNDING),
        'false_positive_rate_interval_95': ends(false, of_positives),
        'false_positives_measured_by_wang': by_wang,
        'bound_of_distances': 'wang' if by_wang else 'claimed',
        'refuted_bounds': Within(*tally.refuted()),
        'max_fp_distance_over_bound': Within(*tally.ratios.most()),
        'median_fp_distance_over_bound': quantile(tally.ratios, 0.5, largest),
        'q99_fp_distance_over_bound': quantile(tally.ratios, 0.99, largest),
        'unknown': tally.unknown,
        'times_given': times.given,
        'times_promised': times.promised,
        'late': times.late,
        'stuck': times.stuck,
        'committed': times.committed,
        'unsafe_steps': times.unsafe_steps,
        'touch_at_end': times.touch_at_end,
        'time_sort': times.sort,
        'max_early': Within(*times.early.most()),
        'max_after': Within(*times.after.most()),
        'median_early': quantile(times.early, 0.5, found['max_early']),
        'q99_early': quantile(times.early, 0.99, found['max_early']),
        'q99_travelled': quantile(times.travelled, 0.99, math.inf),
    }


def _check_oracle(comparison, where, found, answers):
    """Checks what the oracle decided, for each family and in total."""
    none = {'disagreements': 0, 'mismatches_with_recorded_truth': 0}
    comparison.entries('oracle', where, found, none)
    sums = Counter()
    for kind in KINDS:
        families = found['families'].get(kind, {})
        comparison.same('names', f'{where} {kind}', sorted(families), answers.families(kind))
        for family in answers.families(kind):
            own = answers.family[kind] == family
            truth = Counter(
                queries=int(own.sum()),
                collisions=int(answers.collision[kind][own].sum()),
                ties=int((answers.within[kind] & ~answers.collision[kind])[own].sum()),
            )
            _check_truth(comparison, f'{where} {kind} {family}', families[family], truth)
            sums += truth
    _check_truth(comparison, f'{where} total', found['total'], sums)


def _check_truth(comparison, where, found, truth):
    counts = {name: truth[name] for name in ('queries', 'collisions', 'ties')}
    comparison.entries('oracle', where, found, counts)
    decided = sum(found['decided_by'].values())
    comparison.same('oracle', f'{where} decided_by', decided, truth['queries'])


def _check_signatures(comparison, where, found, answers):
    """Checks each sort of failure of a subject: the counts of its signatures (ways to fail) must
    add up to the tally."""
    sums = Counter()
    for each in found:
        sums[each['what'], each['subject']] += each['seen']
    for subject in answers.subjects:
        tally = Tally.of(answers, subject, KINDS)
        for failure, ends in (
            ('false-negative', [tally.false_negatives] * 2),
            ('late', [tally.times.late] * 2),
            ('committed', [tally.times.committed - tally.times.unsafe_steps] * 2),
            ('unsafe-step', [tally.times.unsafe_steps] * 2),
            ('refuted-bound', tally.refuted()),
        ):
            own = sums.pop((failure, subject), 0)
            comparison.within('signatures', f'{where} {subject} {failure}', own, *ends)
    comparison.same('signatures', f'{where} of no subject', dict(sums), {})


def check_scorecard(comparison, where, report, answers):
    """Checks each subject's failures, and its rates over all kinds: in total, and for each
    class."""
    rows = report['verdicts']
    comparison.same('names', where, [row['subject'] for row in rows], answers.subjects)
    for row in rows:
        subject = row['subject']
        own = f'{where} {subject}'
        failed = failures_of(row['counts'])
        expected = {'faults': {}, 'failures': failed, 'clean': not set(failed) - ON_REQUEST}
        comparison.entries('verdicts', own, row, expected)
        check_rates(comparison, own, row['counts'], Tally.of(answers, subject, KINDS))
        families = {
            name: each['class']
            for of_kind in report['subjects'][subject].values()
            for name, each in of_kind['families'].items()
        }
        members = classes_of(families)
        comparison.same('names', f'{own} classes', list(row['classes']), list(members))
        for name, of_class in members.items():
            tally = Tally.of(answers, subject, KINDS, of_class)
            check_rates(comparison, f'{own} {name}', row['classes'][name], tally)


def check_trade_offs(comparison, where, report, answers):
    """Checks the section "error_against_time": sums over the kinds that all subjects were asked."""
    found = report['error_against_time']['subjects']
    comparison.same('names', where, sorted(found), answers.subjects)
    kinds_of = [set(answers.kinds(subject)) for subject in answers.subjects]
    shared = tuple(kind for kind in KINDS if all(kind in kinds for kinds in kinds_of))
    for subject, each in found.items():
        tally = Tally.of(answers, subject, shared)
        check_rates(comparison, f'{where} {subject}', each, tally)
        errors, most = tally.times.errors, each['max_time_error']
        expected = {
            'max_time_error': Within(*errors.most()),
            'median_time_error': quantile(errors, 0.5, most),
            'q99_time_error': quantile(errors, 0.99, most),
            'sound': not set(failures_of(each)) - ON_REQUEST,
        }
        comparison.entries('trade-offs', f'{where} {subject}', each, expected)


def check_ladder(comparison, where, report, answers):
    """Checks the rates of each subject on the precision ladder (one algorithm in several scalar
    types)."""
    for rung in report.get('ladder', {'rungs': []})['rungs']:
        subject = rung['subject']
        check_rates(comparison, f'{where} {subject}', rung, Tally.of(answers, subject, MESHES))


def fails(asked):
    """For each query, whether the subject misses a collision, gives a late time, or exceeds its bound."""
    refuted = asked.ratios.hi > 1 if asked.claims else False
    return asked.false_negative | asked.impact.late | refuted


def check_versions(comparison, where, report, answers):
    """Checks the section "versions". If the report says that a later version breaks a query, the
    earlier version must have been right on this query."""
    found = report.get('versions', [])
    pairs = sorted({(each['before'], each['after']) for each in found})
    expected = [row for pair in pairs for row in rows(*pair, report, answers)]
    comparison.same('versions', where, found, expected)
    for i, each in enumerate(report['findings']):
        before = each.get('broken_since')
        place = answers.place(each['kind'], each['provenance'])
        if before is None or place is None:
            continue
        known = answers.asked.get((before, each['kind']))
        is_right = known is not None and not fails(known)[place]
        comparison.same('versions', f'findings {i} broken since {before}', is_right, True)


def rows(before, after, report, answers):
    """Yields the rows that compare two versions: one for each class of families and each kind."""
    for of in CLASSES:
        for kind in answers.kinds(after):
            families = report['subjects'][after][kind]['families']
            own = np.isin(
                answers.family[kind], [f for f in families if families[f]['class'] == of]
            )
            if not own.any():
                continue
            one, other = (fails(answers.asked[subject, kind])[own] for subject in (before, after))
            counts = {
                'fixed': one & ~other,
                'broken': other & ~one,
                'both': one & other,
                'neither': ~(one | other),
                'queries': np.ones_like(one),
            }
            yield {
                'before': before,
                'after': after,
                'kind': kind,
                'class': of,
                **{name: int(each.sum()) for name, each in counts.items()},
            }

"""Checks the counters of report.json, and of the JSON of nearmiss fuzz, against tallies."""

import math
from collections import Counter

from asking import KINDS
from check_kept import check_kept
from check_numbers import ROUNDING, SOLVED, check_histogram, quantile
from comparison import Near, Within
from tally import Tally, classes_of, denominators, interval, rate, stages, upper_bound


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
    """Checks all counters of one subject over the queries of some families, except run times.
    Also checks the extreme cases that the report keeps."""
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
    """Checks the measures that report.json has for every sum, except run times."""
    comparison.entries('counters', where, found, measures(found, tally))


def measures(found, tally):
    """The expected value of each measure, by its key. The highest bin of a quantile ends at the
    largest number in `found`."""
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
    """Checks that each false negative, late time, committed step and refuted bound is in one signature."""
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

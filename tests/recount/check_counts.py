"""Checks the counters of report.json, and of the JSON of nearmiss fuzz, against tallies."""

from asking import KINDS
from check_numbers import ROUNDING, SOLVED, check_histogram, check_quantile, check_query
from check_times import check_extremes, check_time_histograms, check_times
from enclosed import reported
from tally import Tally, classes_of, denominators, interval, rate, stages, upper_bound


def check_statistics(comparison, where, json, answers):
    """Checks the sections "subjects", "oracle" and "signatures"."""
    _check_oracle(comparison, f'{where} oracle', json['oracle'], answers)
    _check_signatures(comparison, f'{where} signatures', json['signatures'], answers)
    subjects = json['subjects']
    comparison.same('names', f'{where} subjects', sorted(subjects), answers.subjects)
    for subject in answers.subjects:
        for kind in KINDS:
            found = subjects[subject][kind]
            place = f'{where} {subject} {kind}'
            tally = Tally.of(answers, subject, [kind])
            check_counts(comparison, place, found, tally)
            _check_kept(comparison, place, found, tally, answers, subject, kind)
            families = found['families']
            comparison.same('names', f'{place} families', sorted(families), answers.families(kind))
            for family in answers.families(kind):
                own = f'{place} {family}'
                tally = Tally.of(answers, subject, [kind], family)
                check_counts(comparison, own, families[family], tally)
                _check_kept(comparison, own, families[family], tally, answers, subject, kind)
            _check_classes(comparison, place, found, answers, subject, kind)


def _check_classes(comparison, where, found, answers, subject, kind):
    """Checks the sums over the families of each class."""
    members = classes_of({name: own['class'] for name, own in found['families'].items()})
    comparison.same('names', f'{where} classes', list(found['classes']), list(members))
    for name, families in members.items():
        if name in found['classes']:
            own = found['classes'][name]
            tally = Tally.of(answers, subject, [kind], families)
            check_counts(comparison, f'{where} {name}', own, tally)
            _check_kept(comparison, f'{where} {name}', own, tally, answers, subject, kind)


def check_counts(comparison, where, found, tally):
    """Checks all counters of one subject over some queries, except times."""
    check_rates(comparison, where, found, tally)
    comparison.same('counters', f'{where} positives', found['positives'], tally.positives)
    comparison.same('counters', f'{where} faults', found['faults'], {})
    comparison.same(
        'counters',
        f'{where} missed by class',
        found['false_negatives_by_class'],
        tally.missed_by_class,
    )
    for name, expected in (('true', tally.true_by_stage), ('false', tally.false_by_stage)):
        own = stages(tally.subject, found[f'{name}_positives_by_stage'])
        comparison.same('stages', f'{where} {name}', own, stages(tally.subject, expected))
    comparison.same(
        'stages',
        f'{where} rejected',
        sum(found['rejected_by'].values()),
        tally.queries - tally.positives,
    )
    check_histogram(comparison, where, found['fp_distance_histogram'], tally.ratios)
    check_time_histograms(comparison, where, found, tally.times)


def check_rates(comparison, where, found, tally):
    """Checks counters, rates with their intervals, and quantiles of distances."""
    for name in ('queries', 'collisions', 'false_negatives', 'false_positives'):
        comparison.same('counters', f'{where} {name}', found[name], getattr(tally, name))
    comparison.within(
        'counters', f'{where} refuted_bounds', found['refuted_bounds'], *tally.refuted()
    )
    by_wang = 0 if tally.claims else tally.false_positives
    comparison.same(
        'counters', f'{where} by wang', found['false_positives_measured_by_wang'], by_wang
    )
    comparison.same(
        'counters', f'{where} bound', found['bound_of_distances'], 'wang' if by_wang else 'claimed'
    )
    of_negatives, of_positives = denominators(tally)
    for name, value in (
        ('false_negative_rate', rate(tally.false_negatives, of_negatives)),
        ('false_positive_rate', rate(tally.false_positives, of_positives)),
    ):
        comparison.near('rates', f'{where} {name}', found[name], value, ROUNDING)
    upper = upper_bound(tally.false_negatives, of_negatives)
    comparison.near(
        'intervals',
        f'{where} false_negative_rate',
        found['false_negative_rate_upper_95'],
        upper,
        SOLVED,
    )
    for name, count, total in (
        ('false_negative_rate', tally.false_negatives, of_negatives),
        ('false_positive_rate', tally.false_positives, of_positives),
    ):
        for end, value in zip(found[f'{name}_interval_95'], interval(count, total)):
            comparison.near('intervals', f'{where} {name}', end, value, SOLVED)
    largest = tally.ratios.largest()[0] if tally.false_positives else (0, 0)
    comparison.within('largest ratios', where, found['max_fp_distance_over_bound'], *largest)
    for name, part in (('median', 0.5), ('q99', 0.99)):
        check_quantile(
            comparison,
            f'{where} {name}',
            found[f'{name}_fp_distance_over_bound'],
            tally.ratios.quantile_bins(part),
            found['max_fp_distance_over_bound'],
        )
    check_times(comparison, where, found, tally)


def _check_kept(comparison, where, found, tally, answers, subject, kind):
    """Checks the extreme cases that are kept."""
    _check_farthest(comparison, where, found['farthest'], tally, answers, subject, kind)
    check_extremes(comparison, where, found, tally.times, answers, subject, kind)


def _check_farthest(comparison, where, found, tally, answers, subject, kind):
    """Checks the distances and the queries of the farthest false positives that are kept."""
    expected = tally.ratios.largest()
    comparison.same('largest ratios', f'{where} number', len(found), len(expected))
    for i, (far, ends) in enumerate(zip(found, expected)):
        comparison.within('largest ratios', f'{where} farthest {i}', far['ratio'], *ends)
        check_false_positive(comparison, f'{where} farthest {i}', answers, subject, kind, far)


def _check_oracle(comparison, where, found, answers):
    for name in ('disagreements', 'mismatches_with_recorded_truth'):
        comparison.same('oracle', f'{where} {name}', found[name], 0)
    sums = {'queries': 0, 'collisions': 0}
    for kind in KINDS:
        comparison.same(
            'names', f'{where} {kind}', sorted(found['families'][kind]), answers.families(kind)
        )
        for family in answers.families(kind):
            own = answers.family[kind] == family
            expected = {
                'queries': int(own.sum()),
                'collisions': int(answers.collision[kind][own].sum()),
            }
            _check_truth(
                comparison, f'{where} {kind} {family}', found['families'][kind][family], expected
            )
            sums = {name: sums[name] + expected[name] for name in sums}
    _check_truth(comparison, f'{where} total', found['total'], sums)


def _check_truth(comparison, where, found, expected):
    for name, value in expected.items():
        comparison.same('oracle', f'{where} {name}', found[name], value)
    comparison.same('oracle', f'{where} ties', found['ties'], 0)  # all queries ask for contact
    comparison.same(
        'oracle', f'{where} decided_by', sum(found['decided_by'].values()), expected['queries']
    )


def _check_signatures(comparison, where, found, answers):
    """Checks that each false negative, each late time and each refuted bound counts for one signature."""
    sums = {}
    for each in found:
        key = each['what'], each['subject']
        sums[key] = sums.get(key, 0) + each['seen']
    for subject in answers.subjects:
        tally = Tally.of(answers, subject, KINDS)
        missed = tally.false_negatives
        comparison.same(
            'signatures',
            f'{where} {subject} missed',
            sums.pop(('false-negative', subject), 0),
            missed,
        )
        comparison.same(
            'signatures',
            f'{where} {subject} late',
            sums.pop(('late', subject), 0),
            tally.times.late,
        )
        refuted = sums.pop(('refuted-bound', subject), 0)
        comparison.within('signatures', f'{where} {subject} refuted', refuted, *tally.refuted())
    comparison.same('signatures', f'{where} of no subject', sums, {})


def check_false_positive(comparison, where, answers, subject, kind, found):
    """Checks a false positive with its provenance, its ratio, and its query as a line or a list of
    numbers."""
    place = answers.place(kind, found['provenance'])
    if place is None or not answers.asked[subject, kind].false_positive[place]:
        return comparison.fail('provenances', where, found['provenance'], 'a false positive')
    asked = answers.asked[subject, kind]
    ends = reported(asked.ratios.lo[place], asked.ratios.hi[place])
    comparison.within('largest ratios', f'{where} own', found['ratio'], *ends)
    check_query(comparison, where, found['query'], asked.judged[place])

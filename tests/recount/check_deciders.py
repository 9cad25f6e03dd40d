"""Checks the section "deciders" of report.json: which stage decided, for subjects that pass
queries on.

The section adds up counts by accepting stage and by reason of rejection. Only a campaign knows
why a pair was rejected, so the expected sums come from the section "subjects", which other
modules check."""


def check_deciders(comparison, where, report, answers):
    """Checks the rows for all families together ("") and for each family."""
    expected = {}
    for subject in answers.subjects:
        kinds = answers.kinds(subject)
        families = sorted({family for kind in kinds for family in answers.families(kind)})
        rows = {family: _row(report['subjects'][subject], family) for family in ['', *families]}
        if rows['']['algorithm'] and any(rows[''][name] for name in ('filter', 'finer', 'exact')):
            expected.update({(subject, family): row for family, row in rows.items()})
    found = report.get('deciders', [])
    keys = [(row['subject'], row['family']) for row in found]
    comparison.same('deciders', f'{where} rows', keys, list(expected))
    for row, key in zip(found, keys):
        counts = {'decided_by': expected[key], 'queries': sum(expected[key].values())}
        comparison.entries('deciders', f'{where} {key}', row, counts)


def _row(subject, family):
    """For each decider, the number of queries of all kinds that it decided."""
    deciders = {'algorithm': 0, 'filter': 0, 'finer': 0, 'exact': 0}
    for of_kind in subject.values():
        counts = of_kind['families'].get(family) if family else of_kind
        if counts is None:
            continue
        names = ('true_positives_by_stage', 'false_positives_by_stage', 'rejected_by')
        for name in ('filter', 'finer', 'exact'):
            deciders[name] += sum(counts[each].get(name, 0) for each in names)
        deciders['algorithm'] += counts['queries']
    deciders['algorithm'] -= sum(deciders[name] for name in ('filter', 'finer', 'exact'))
    return deciders

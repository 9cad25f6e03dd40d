"""Asks the tests about a mutant: the quick ones first, until one fails."""

import re
from dataclasses import dataclass, field

from suite import run_tests

KILLED = (-9, 128 + 9, 128 + 24)  # by a limit
BUDGET = 120  # seconds of one core that a mutant may take, by what its tests take without it


@dataclass
class Answer:
    """What the tests said of a mutant."""

    noticed_by: str = ''  # the first test that failed, or ''
    how: str = ''  # 'failed', 'crashed' or 'too slow'
    cpu: float = 0
    wall: float = 0
    asked: int = 0  # tests
    unasked: list = field(default_factory=list)  # tests for which no time was left
    unsteady: list = field(default_factory=list)  # tests that failed once, and not again or always
    spent: dict = field(default_factory=dict)  # seconds by test, as without a mutant


def batches(steps, folder):
    """Steps in the order of their time, in batches that take twice as long each; the folder's own first."""
    batch, size, limit = [], 0, 0.5
    for step in sorted(steps, key=lambda each: (each.cpu, each.name)):
        if batch and size + step.cpu > limit:
            yield by_group(batch, folder)
            batch, size, limit = [], 0, 2 * limit
        batch.append(step)
        size += step.cpu
    if batch:
        yield by_group(batch, folder)


def by_group(batch, folder):
    """The steps of a batch, by executable."""
    groups = {}
    for step in batch:
        groups.setdefault(step.group, []).append(step)
    order = sorted(groups, key=lambda each: (each != folder, sum(s.cpu for s in groups[each])))
    return [groups[each] for each in order]


def affordable(steps):
    """The quick ones that fit the budget, and the names of the others."""
    kept, left, total = [], [], 0
    for step in sorted(steps, key=lambda each: (each.cpu, each.name)):
        total += step.cpu
        if total <= BUDGET:
            kept.append(step)
        else:
            left.append(step.name)
    return kept, left


def culprit(group, ended):
    """Which test failed, and how."""
    how = (
        'too slow'
        if ended.late or ended.code in KILLED
        else 'failed'
        if ended.code == 1
        else 'crashed'
    )
    failed = re.search(r'\[  FAILED  \] ([\w./]+)', ended.output)
    begun = re.findall(r'\[ RUN      \] (\S+)', ended.output)
    return failed[1] if failed else begun[-1] if begun else '', how


def run_steps(number, group):
    """Runs steps of one executable with a mutant; the limits are what they take without it, generously."""
    return run_tests(
        group[0].group,
        [step.test for step in group],
        {'NEARMISS_MUTANT': str(number)},
        seconds=30 + 10 * sum(step.wall for step in group),
        cpu=4 + 4 * sum(step.cpu for step in group),
    )


def is_confirmed(number, step):
    """Whether a test that failed fails again with the mutant, and not without: some depend on the machine's load."""
    again = run_steps(number, [step])
    without = run_steps(0, [step]) if number else None
    return again.code != 0 and (without is None or without.code == 0)


def ask(number, steps, folder):
    """What the tests say of the mutant with a number, 0 for one that is built in."""
    answer = Answer()
    kept, answer.unasked = affordable(steps)
    for batch in batches(kept, folder):
        for group in batch:
            while group:
                ended = run_steps(number, group)
                answer.cpu += ended.cpu
                answer.wall += ended.wall
                answer.asked += len(group)
                answer.spent.update({step.name: step.cpu for step in group})
                if ended.code == 0:
                    break
                test, how = culprit(group[0].group, ended)
                failed = next((step for step in group if step.test == test), group[0])
                if how != 'failed' or is_confirmed(number, failed):
                    answer.noticed_by, answer.how = failed.name, how
                    return answer
                answer.unsteady.append(failed.name)
                group = [step for step in group if step is not failed]
    return answer

"""Runs the tests with a mutant, quick tests first, until one fails."""

import re
from dataclasses import dataclass, field

from suite import run_tests

KILLED = (-9, 128 + 9, 128 + 24)  # exit codes of processes that ended at a limit
BUDGET = 120  # limit in seconds of one core for a mutant's tests, from their times without it


@dataclass
class Answer:
    """The result of the tests with a mutant."""

    noticed_by: str = ''  # the first test that failed, or ''
    how: str = ''  # 'failed', 'crashed' or 'too slow'
    cpu: float = 0
    wall: float = 0
    asked: int = 0  # number of tests
    unasked: list = field(default_factory=list)  # tests left out for lack of time
    unsteady: list = field(default_factory=list)  # tests whose failure was not confirmed
    spent: dict = field(default_factory=dict)  # seconds of each test without a mutant


def batches(steps, folder):
    """Yields the steps, the quickest first, in batches whose total time doubles. In each batch,
    the tests of `folder` come first."""
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
    """Divides a batch into lists of steps, one for each executable."""
    groups = {}
    for step in batch:
        groups.setdefault(step.group, []).append(step)
    order = sorted(groups, key=lambda each: (each != folder, sum(s.cpu for s in groups[each])))
    return [groups[each] for each in order]


def affordable(steps, budget):
    """The quickest steps that together fit a budget in seconds, and the names of the others."""
    kept, left, total = [], [], 0
    for step in sorted(steps, key=lambda each: (each.cpu, each.name)):
        total += step.cpu
        if total <= budget:
            kept.append(step)
        else:
            left.append(step.name)
    return kept, left


def culprit(group, ended):
    """The name of the failed test, and how it failed."""
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
    """Runs steps of one executable with a mutant, with limits far above their times without it."""
    return run_tests(
        group[0].group,
        [step.test for step in group],
        {'NEARMISS_MUTANT': str(number)},
        seconds=30 + 10 * sum(step.wall for step in group),
        cpu=4 + 4 * sum(step.cpu for step in group),
    )


def is_confirmed(number, step):
    """Whether a failed test fails again with the mutant, and passes without it. The first
    failure may be due to a busy machine."""
    again = run_steps(number, [step])
    without = run_steps(0, [step]) if number else None
    return again.code != 0 and (without is None or without.code == 0)


def ask(number, steps, folder, answer):
    """Runs the tests with the mutant of this number, or with the built-in mutant if the number
    is 0, and adds the result to `answer`."""
    kept, left = affordable(steps, BUDGET)
    answer.unasked += left
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
                    return
                answer.unsteady.append(failed.name)
                group = [step for step in group if step is not failed]

"""Runs the tests with a mutant, quick tests first, until a test fails."""

import re
from dataclasses import dataclass

from suite import run_tests

KILLED = (-9, 128 + 9)  # exit codes of processes that were killed at a limit


@dataclass
class Answer:
    """The result of the tests with a mutant."""

    noticed_by: str = ''  # the first test that failed, or ''
    how: str = ''  # 'failed', 'crashed' or 'too slow'
    cpu: float = 0
    asked: int = 0  # number of tests


def in_order(steps):
    return sorted(steps, key=lambda each: (each.cpu, each.name))


def batches(steps):
    """Divides steps, quick steps first, into batches. Each batch takes about as long as all
    earlier batches together. Yields, for each batch, a list of its steps for each executable."""
    batch, size, limit = {}, 0, 0.5
    for step in in_order(steps):
        if batch and size + step.cpu > limit:
            yield from batch.values()
            batch, size, limit = {}, 0, 2 * limit
        batch.setdefault(step.group, []).append(step)
        size += step.cpu
    yield from batch.values()


def culprit(group, ended):
    """The name of the test at which a run ended, and how it failed."""
    how = 'failed' if ended.code == 1 else 'crashed'
    if ended.late or ended.code in KILLED:
        how = 'too slow'
    failed = re.search(r'\[  FAILED  \] ([\w./]+)', ended.output)
    begun = re.findall(r'\[ RUN      \] (\S+)', ended.output)
    return failed[1] if failed else begun[-1] if begun else '', how


def run_steps(group, layer):
    """Runs steps of one executable, with a limit far above the times that the steps take without a
    mutant. The limit is one of wall time, because a limit of CPU time would change how the kernel
    measures CPU time."""
    return run_tests(
        group[0].group,
        [step.test for step in group],
        seconds=30 + 10 * sum(step.wall for step in group),
        layer=layer,
    )


def ask(steps, answer, layer):
    """Runs tests with the mutant of a layer, which must be built, and adds the result to `answer`.
    Runs a failed test again, since it may have failed because the machine was busy."""
    for group in batches(steps):
        while group:
            ended = run_steps(group, layer)
            answer.cpu += ended.cpu
            answer.asked += len(group)
            if ended.code == 0:
                break
            test, how = culprit(group[0].group, ended)
            failed = next((step for step in group if step.test == test), group[0])
            if run_steps([failed], layer).code != 0:
                answer.noticed_by, answer.how = failed.name, how
                return
            group = [step for step in group if step is not failed]

"""Surveys mutants: builds each of them in a layer over the copy, and runs the tests with it."""

import queue
import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict

import copied
from asking import Answer, ask
from results import Results
from sources import WORK
from suite import all_steps, baseline


def say(text):
    print(text, flush=True)


class Survey:
    """Finds the results of mutants. Builds and tests `jobs` mutants at a time."""

    def __init__(self, drawn, jobs):
        self.drawn, self.jobs = drawn, jobs
        self.results = Results()
        self.done = 0
        self.lock = threading.Lock()
        self.layers = queue.SimpleQueue()
        for number in range(jobs):
            self.layers.put(copied.Layer(WORK / f'layer-{number}'))

    def prepare(self):
        """Builds the copy, and measures the tests without a mutant, unless all results are known."""
        if all(each.reason or self.results.get(each) for each in self.drawn):
            return
        copied.make_copy()
        if not copied.Layer(WORK / 'layer-0').is_possible():
            raise SystemExit('this system does not mount overlayfs, which mutants need')
        copied.configure()
        say('building the copy without a mutant')
        ended = copied.ninja(['all'], self.jobs)
        if ended.code != 0:
            raise SystemExit(f'the copy is not built:\n{ended.output[-4000:]}')
        self.steps = [step for step in baseline(all_steps(), self.jobs, say) if step.fine]

    def find(self, mutation, layer):
        """First builds and runs the tests of the mutant's own folder, then all others. A mutant is
        not valid if it does not compile, or if its file is not compiled here."""
        own = mutation.file.split('/')[0]
        answer, is_compiled = Answer(), False
        layer.begin(mutation)
        for target, is_own in ((f'{own}_tests', True), ('all', False)):
            built = copied.ninja([target], 1, layer)
            if built.code != 0:
                return {'verdict': 'invalid', 'noticed_by': ''}
            is_compiled |= 'no work to do' not in built.output
            if not is_compiled:
                continue
            ask([step for step in self.steps if (step.group == own) == is_own], answer, layer)
            if answer.noticed_by:
                return {'verdict': 'noticed', **asdict(answer)}
        return {'verdict': 'survived' if is_compiled else 'invalid', **asdict(answer)}

    def known(self, mutation):
        """The result of a mutant: a stored result or, if there is none, a new one, which is then stored."""
        if mutation.reason:
            return {'verdict': 'equivalent', 'noticed_by': ''}
        if (result := self.results.get(mutation)) is None:
            layer = self.layers.get()
            try:
                result = self.find(mutation, layer)
            finally:
                layer.end()
                self.layers.put(layer)
            with self.lock:
                self.results.put(mutation, result)
        return result

    def result_of(self, mutation):
        """A mutant with its result. Prints a line of progress."""
        result = self.known(mutation)
        by = f' by {result["noticed_by"]}, {result["cpu"]:.1f} s' if result['noticed_by'] else ''
        with self.lock:
            self.done += 1
            say(f'[{self.done}] {mutation.where} {mutation.operator}: {result["verdict"]}{by}')
        return mutation, result

    def take(self):
        """Pairs of a mutant and its result, one for each mutant drawn."""
        with ThreadPoolExecutor(self.jobs) as pool:
            return list(pool.map(self.result_of, self.drawn))

"""A survey: draws mutants, compiles them, and runs the tests with each."""

import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict

import compiling
import copied
import equivalents
from asking import Answer, ask
from draw import all_sites, draw
from results import Results
from schemata import by_itself
from sources import ROOT, Compiled, read
from suite import all_steps, baseline

SPARE = 1.3  # number of drawn mutants for each requested one, because some need a separate build


def say(text):
    print(text, flush=True)


def folder_of(mutation):
    return mutation.file.split('/')[0]


class Survey:
    """The results of mutants. Prints a line of progress for each."""

    def __init__(self, jobs):
        self.jobs = jobs
        self.results = Results()
        self.printing = threading.Lock()
        self.done = 0

    def show(self, mutation, result):
        """Prints a line of progress."""
        by = f' by {result["noticed_by"]}, {result["cpu"]:.1f} s' if result['noticed_by'] else ''
        with self.printing:
            self.done += 1
            text = f'{mutation.where} {mutation.operator}: {result["verdict"]}{by}'
            say(f'[{self.done}] {text}')


class DrawnSurvey(Survey):
    """The drawn mutants, most of which are switches in one build."""

    def __init__(self, folders, seed, count, alone, jobs):
        super().__init__(jobs)
        self.folders, self.alone = folders, alone
        copied.make_copy(copied.text_of_copy)
        copied.configure()
        self.compiled = Compiled(copied.BUILD, copied.COPY)
        self.quota = -(-count // len(folders))
        found = all_sites(self.compiled, copied.COPY, folders, jobs)
        self.drawn = draw(found, folders, seed, int(SPARE * self.quota))
        self.mutants = compiling.Mutants(self.drawn)
        self.equivalent = equivalents.listed()

    def prepare(self):
        """Builds the copy, and measures the tests without a mutant."""
        say(f'{len(self.drawn)} mutants are compiled')
        compiling.build_all(self.mutants, self.compiled, self.jobs, say)
        self.steps = baseline(all_steps(), self.jobs, say)

    def reaching(self, number):
        return [step for step in self.steps if step.fine and number in step.reached]

    def is_compile_time(self, number):
        """Whether the switch of a mutant has no effect at run time."""
        form = self.mutants.forms[self.drawn[number - 1].name]
        return form == 'alone' or (form == 'constexpr' and not self.reaching(number))

    def chosen(self):
        """The numbers of the requested mutants with a switch, and of those to build separately."""
        switched, alone = [], []
        left = {folder: self.quota for folder in self.folders}
        for number, mutation in enumerate(self.drawn, 1):
            if self.mutants.forms[mutation.name] == 'invalid':
                continue
            if self.is_compile_time(number):
                alone.append(number)
            elif left[folder_of(mutation)] > 0:
                left[folder_of(mutation)] -= 1
                switched.append(number)
        alone.sort(key=lambda number: self.drawn[number - 1].file.endswith('.hpp'))
        return switched, alone[: self.alone]

    def known(self, mutation):
        """The stored result of a mutant, unless the list of equivalent mutants contradicts it."""
        result = self.results.get(mutation)
        is_listed = equivalents.reason_of(self.equivalent, mutation) is not None
        if result is None or is_listed == (result['verdict'] == 'equivalent'):
            return result
        return None

    def find(self, mutation, switch, steps):
        """Runs the tests with a mutant. `switch` is its number, or 0 if it has no switch."""
        if equivalents.reason_of(self.equivalent, mutation):
            return {'verdict': 'equivalent', 'noticed_by': ''}
        if not steps:
            return {'verdict': 'unreached', 'noticed_by': ''}
        answer = Answer()
        ask(switch, steps, folder_of(mutation), answer)
        return {'verdict': 'noticed' if answer.noticed_by else 'survived', **asdict(answer)}

    def ask_switched(self, number):
        """The result of a mutant that has a switch. Runs the tests if the result is not known."""
        mutation = self.drawn[number - 1]
        if (result := self.known(mutation)) is None:
            result = self.find(mutation, number, self.reaching(number))
            self.results.put(mutation, result)
        self.show(mutation, result)
        return mutation, result

    def ask_alone(self, number):
        """The result of a mutant in a separate build. This build stays in the copy until the next
        one."""
        mutation = self.drawn[number - 1]
        if (result := self.known(mutation)) is None:
            copied.make_copy(self.mutants.text_of)
            text = by_itself(read(ROOT / mutation.file), mutation)
            copied.write(copied.COPY / mutation.file, text)
            compiles = copied.ninja(['all'], self.jobs).code == 0
            steps = [step for step in self.steps if step.fine]
            result = {'verdict': 'open', 'noticed_by': ''}
            if compiles:
                result = self.find(mutation, 0, steps)
            self.results.put(mutation, result)
        self.show(mutation, result)
        return mutation, result

    def take(self):
        """All results, as pairs of a mutant and its result."""
        switched, alone = self.chosen()
        say(f'{len(switched)} mutants are tested by switch, {len(alone)} in separate builds')
        with ThreadPoolExecutor(self.jobs) as pool:
            found = list(pool.map(self.ask_switched, switched))
        return found + [self.ask_alone(number) for number in alone]

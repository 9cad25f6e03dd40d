"""Builds all mutants at once. A mutant that does not compile as a switch gets another form, or a
separate build."""

import json
import re

from copied import COPY, make_copy, ninja
from schemata import SWITCHES, first_form, next_form, with_switches
from sources import ROOT, WORK, read

FORMS_FILE = WORK / 'forms.json'
# A path may be relative, because ccache makes paths relative.
PLACE = re.compile(rf'(?:^|\s)(?:\S*/)?{COPY.name}/([\w./-]+\.[ch]pp):(\d+)', re.MULTILINE)


def known_forms():
    """The forms that mutants took in earlier builds, by name."""
    return json.loads(FORMS_FILE.read_text()) if FORMS_FILE.exists() else {}


class Mutants:
    """The drawn mutants, numbered from 1, and the form in which each is compiled."""

    def __init__(self, drawn):
        self.drawn = drawn
        known = known_forms()
        self.forms = {each.name: known.get(each.name, first_form(each)) for each in drawn}
        self.by_file = {}
        for number, each in enumerate(drawn, 1):
            self.by_file.setdefault(each.file, []).append((number, each))

    def text_of(self, name):
        """The text of a file in the copy, with its mutants."""
        switches = [
            (number, each, self.forms[each.name])
            for number, each in self.by_file.get(name, [])
            if self.forms[each.name] in SWITCHES
        ]
        return with_switches(read(ROOT / name), switches)

    def step_back(self, mutation, errors):
        """Gives a mutant that does not compile its next form."""
        self.forms[mutation.name] = next_form(self.forms[mutation.name], errors)
        FORMS_FILE.write_text(json.dumps({**known_forms(), **self.forms}, indent=0))

    def at(self, places):
        """The mutants on any of these lines that are compiled as switches."""
        found = []
        for name in {name for name, _ in places} & set(self.by_file):
            text = read(ROOT / name)
            lines = {line for each, line in places if each == name}
            for _, each in self.by_file[name]:
                if self.forms[each.name] in SWITCHES and each.lines(text) & lines:
                    found.append(each)
        return found

    def in_constexpr_functions(self, files):
        """Mutants in constexpr functions of these files, which may be evaluated elsewhere."""
        return [
            each
            for name in sorted(files & set(self.by_file))
            for _, each in self.by_file[name]
            if self.forms[each.name] == 'constexpr'
        ]


def failures(output):
    """The compiler's output about each file that did not compile."""
    blocks = re.split(r'^(?=FAILED: |\[\d+/\d+\] )', output, flags=re.MULTILINE)
    return [block for block in blocks if block.startswith('FAILED: ')]


def places(text):
    return {(name, int(line)) for name, line in PLACE.findall(text)}


def blamed(mutants, block):
    """The mutants on the line of an error; if none, those on lines that the error mentions; if
    none, those in the constexpr functions of the files that it mentions."""
    errors = '\n'.join(line for line in block.splitlines() if ' error: ' in line)
    mentioned = places(block)
    return (
        mutants.at(places(errors))
        or mutants.at(mentioned)
        or mutants.in_constexpr_functions({name for name, _ in mentioned})
    )


def errors_about(mutation, block):
    """The compiler's errors on the lines of a mutant, or its whole output if the errors are on
    other lines."""
    lines = {(mutation.file, line) for line in mutation.lines(read(ROOT / mutation.file))}
    errors = [line for line in block.splitlines() if ' error: ' in line and places(line) & lines]
    return '\n'.join(errors) or block


def build(mutants, targets, jobs, say):
    """Builds targets of the copy with all mutants, and repeats the build until it succeeds."""
    while True:
        make_copy(mutants.text_of)
        ended = ninja(targets, jobs, lambda step: say(f'building {step}'))
        if ended.code == 0:
            return
        (WORK / 'errors.txt').write_text('\n'.join(failures(ended.output)))
        culprits = {}
        for block in failures(ended.output):
            found = blamed(mutants, block)
            if not found:
                raise SystemExit(
                    f'the copy does not compile, and no mutant is the cause:\n{block[:4000]}'
                )
            culprits.update({each.name: (each, errors_about(each, block)) for each in found})
        if not culprits:
            raise SystemExit(f'the copy is not built:\n{ended.output[-4000:]}')
        for each, errors in culprits.values():
            mutants.step_back(each, errors)
            say(f'{each.file}:{each.line}: now {mutants.forms[each.name]}: {each.after}')


def probes(mutants, compiled):
    """The object files that suffice to show whether the mutants compile."""
    units = {unit for name in mutants.by_file for unit in compiled.units(name)}
    objects = []
    for unit in sorted(units):
        command = compiled.commands[unit]['command']
        objects.append(re.search(r' -o (\S+)', command)[1])
    return objects


def build_all(mutants, compiled, jobs, say):
    """Builds the files that show whether the mutants compile, and then everything."""
    build(mutants, probes(mutants, compiled), jobs, say)
    build(mutants, ['all'], jobs, say)

"""The lists of named edits, each a small error that somebody has thought of.

    == GROUP ==

    NAME in FILE (2 of 3): the error that the edit makes
    - the text to find, once in the file, or at the second of three places; any blanks match
    + the text that replaces it
    and in FILE
    - the text to find in one more place
    + the text that replaces it
    = for an edit that no test notices: why it changes no answer, or what would notice it

A file is named from the folder that the list is about, or from the root if it is in fuzz/.
tools/cmake/edited_copies.cmake reads the same form.
"""

import re
import sys
from dataclasses import astuple, dataclass, field

from mutation import Edit, applied
from sources import ROOT, sha

LISTS = {'tests/judge/defects': 'oracle', 'fuzz/subjects/defects': 'ccd/wang'}
HEADING = re.compile(r'(\S+) in (\S+?\.[ch]pp)(?: \((\d+) of (\d+)\))?(?:: (.+))?')


@dataclass
class Place:
    """The `nth` of `of` places in a file with the text `before`, which `after` replaces."""

    file: str
    nth: int
    of: int
    before: str = ''
    after: str = ''

    def edit(self, text):
        """The edit of the file's text. Raises ValueError if `before` does not occur `of` times."""
        words = [re.escape(word) for word in self.before.split()]
        found = list(re.finditer(r'\s+'.join(words), text))
        if len(found) != self.of:
            raise ValueError(
                f"'{self.before}' occurs {len(found)} times in {self.file}, expected {self.of}"
            )
        return Edit(*found[self.nth - 1].span(), self.after)


@dataclass
class NamedEdit:
    """An entry of a list. A survey treats it as a mutant whose operator is the entry's group."""

    title: str
    about: str
    operator: str
    places: list = field(default_factory=list)
    reason: str = ''

    @property
    def name(self):
        """The title, and a hash of the edit itself."""
        return f'{self.title} {sha(repr([astuple(place) for place in self.places]))[:12]}'

    @property
    def file(self):
        return self.places[0].file

    @property
    def where(self):
        return f'{self.title} in {self.file}'

    @property
    def before(self):
        return ' ... '.join(place.before for place in self.places)

    @property
    def after(self):
        return ' ... '.join(' '.join(place.after.split()) for place in self.places)

    def applied(self, file, text):
        """The text of a file with the edit."""
        return applied(text, [place.edit(text) for place in self.places if place.file == file])


def entries(text, folder):
    """The edits of a list about a folder. Raises ValueError at a line in another form."""
    found, group = [], ''
    for line in filter(str.strip, text.split('\n')):
        rest = line[1:].strip()
        if title := re.fullmatch('== (.+) ==', line):
            group = title[1]
        elif heading := HEADING.fullmatch(line):
            name, file, nth, of, about = heading.groups()
            if name != 'and':
                found.append(NamedEdit(name, about or '', group))
            path = file if file.startswith('fuzz/') else f'{folder}/{file}'
            found[-1].places.append(Place(path, int(nth or 1), int(of or 1)))
        elif line[0] == '-':
            place = found[-1].places[-1]
            place.before = f'{place.before} {rest}'.strip()
        elif line[0] == '+':
            place = found[-1].places[-1]
            place.after = f'{place.after}\n{rest}'.strip()
        elif line[0] == '=':
            found[-1].reason = f'{found[-1].reason} {rest}'.strip()
        elif line[0] != '#':
            raise ValueError(f"found '{line}', expected NAME in FILE: ABOUT, or -, + or =")
    return found


def listed(folder='tests/judge/defects'):
    """The edits of all lists in a folder."""
    texts = [path.read_text('utf-8') for path in sorted((ROOT / folder).glob('*.txt'))]
    return entries('\n'.join(texts), LISTS[folder])


def matching(pattern, seed, count=None):
    """The edits of the oracle for which a regular expression matches 'NAME in FILE'. All of
    them, in the order of the lists, or `count` of them, drawn by a seed."""
    found = [edit for edit in listed() if re.search(pattern, edit.where)]
    if count is None:
        return found
    return sorted(found, key=lambda edit: sha(str(seed), edit.name))[:count]


def complaints(edits, root=ROOT):
    """Yields complaints about edits that have no description, have the title of another edit, do
    not fit the sources, or change nothing."""
    titles = set()
    for edit in edits:
        if not edit.about:
            yield f'{edit.title}: does not say what it makes wrong'
        if edit.title in titles:
            yield f'{edit.title}: stands in the list twice'
        titles.add(edit.title)
        for file in sorted({place.file for place in edit.places}):
            text = (root / file).read_text('utf-8')
            try:
                if edit.applied(file, text) == text:
                    yield f'{edit.title}: changes nothing in {file}'
            except ValueError as wrong:
                yield f'{edit.title}: {wrong}'


if __name__ == '__main__':
    lists = [listed(folder) for folder in LISTS]
    wrong = [complaint for edits in lists for complaint in complaints(edits)]
    print('\n'.join(wrong) or f'{sum(map(len, lists))} named edits, all of which fit the sources')
    sys.exit(1 if wrong else 0)

"""Reads equivalent.txt, which lists mutants that change no answer:

    oracle/root.cpp
    - the text of some lines of this file
    + the text that the mutant makes of them
    = why this changes no answer
"""

import sys
from pathlib import Path

from sources import ROOT, read, shown

LIST = Path(__file__).resolve().parent / 'equivalent.txt'


def entries(text):
    """Maps each entry (file, before, after) to its reason. Raises ValueError at the first wrong entry."""
    found = {}
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith('#')]
    for first in range(0, len(lines), 4):
        entry = lines[first : first + 4]
        marks = [line[:1] for line in entry[1:]]
        if marks != ['-', '+', '='] or not entry[3][1:].strip():
            raise ValueError(f'not a file and lines with -, + and =: {" / ".join(entry)}')
        file, before, after, reason = entry[0].strip(), *(
            ' '.join(e[1:].split()) for e in entry[1:]
        )
        found[file, before, after] = reason
    return found


def complaints(found, root=ROOT):
    """Yields complaints about entries whose text is not in their file, or whose mutant changes nothing."""
    for file, before, after in found:
        if not (root / file).is_file():
            yield f'{file}: no such file'
        elif not before or before not in shown(read(root / file)):
            yield f'{file}: does not contain: {before}'
        elif before == after:
            yield f'{file}: changes nothing: {before}'


def reason_of(found, mutation):
    """The reason why a mutant is equivalent; '' if it is not in the list."""
    return found.get((mutation.file, mutation.before, mutation.after), '')


def listed():
    return entries(LIST.read_text())


if __name__ == '__main__':
    wrong = list(complaints(listed()))
    print(
        '\n'.join(wrong) or f'{len(listed())} equivalent mutants, all of which are in the sources'
    )
    sys.exit(1 if wrong else 0)

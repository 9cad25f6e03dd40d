"""Reads the product's C++ files; a character is one byte, because the compiler counts bytes."""

import hashlib
import json
import re
import shlex
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ['ccd', 'oracle', 'reports', 'fuzz', 'corpus']
WORK = ROOT / 'build' / 'mutants'


def read(path):
    """The text of a file, with one character for each byte."""
    return Path(path).read_bytes().decode('latin-1')


def sha(*parts):
    """A hash of texts, in hexadecimal digits."""
    return hashlib.sha256('\0'.join(parts).encode()).hexdigest()


def shown(text):
    """The text as a person reads it, without line ends."""
    return ' '.join(text.encode('latin-1').decode('utf-8', 'replace').split())


def cpp_files(folders, root=ROOT):
    """The names of the C++ files in folders, relative to the root."""
    found = []
    for folder in folders:
        for path in sorted((root / folder).rglob('*.[ch]pp')):
            if 'node_modules' not in path.parts:
                found.append(str(path.relative_to(root)))
    return found


def fingerprint(folders, suffixes, root=ROOT):
    """A hash of the files with these suffixes in folders, except those of this tool."""
    digest = hashlib.sha256()
    for folder in folders:
        for path in sorted((root / folder).rglob('*')):
            name = path.relative_to(root)
            is_other = {'node_modules', 'mutants'} & set(name.parts)
            if path.suffix in suffixes and path.is_file() and not is_other:
                digest.update(f'{name}\0'.encode() + path.read_bytes())
    return digest.hexdigest()[:16]


def included_by(name, root=ROOT, seen=None):
    """The files of the tree that a file includes, directly or not, and the file itself."""
    seen = seen if seen is not None else set()
    if name in seen or not (root / name).is_file():
        return seen
    seen.add(name)
    for include in re.findall(r'^#include "([^"]+)"', read(root / name), re.MULTILINE):
        included_by(include, root, seen)
    return seen


class Compiled:
    """The compile commands of the copy, by file."""

    def __init__(self, build, copy, root=ROOT):
        self.commands = {}
        for entry in json.loads((build / 'compile_commands.json').read_text()):
            name = entry['file'].removeprefix(f'{copy}/')
            if name.endswith('.cpp'):
                self.commands[name] = entry
        self.users = {}
        for name in self.commands:
            for included in included_by(name, root):
                self.users.setdefault(included, []).append(name)

    def units(self, name):
        """The files whose compilation shows whether a file compiles: the file itself, or for a
        header, one or two files that include it."""
        if name in self.commands:
            return [name]
        users = self.users.get(name, [])
        folder = name.split('/')[0]
        product = [user for user in users if user.split('/')[0] == folder]
        stem = Path(name).stem
        tests = [user for user in users if user.startswith('tests/') and stem in user]
        return (product[:1] + tests[:1]) or users[:1]

    def arguments(self, unit, copy, root=ROOT):
        """The arguments with which the compiler parses a compiled file of the tree."""
        entry = self.commands[unit]
        words = shlex.split(entry['command'])
        kept = []
        skip = False
        for word in words[1:]:
            if skip or word == '-c' or word == entry['file']:
                skip = False
            elif word in ('-o', '-include'):
                skip = True
            else:
                kept.append(word.replace(str(copy), str(root)))
        return ['-xc++', *kept]

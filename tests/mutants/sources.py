"""Reads the product's C++ files."""

import hashlib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ['ccd', 'oracle', 'reports', 'fuzz', 'corpus']
WORK = ROOT / 'build' / 'mutants'


def read(path):
    return Path(path).read_bytes().decode()


def sha(*parts):
    """The SHA-256 hash of some texts, in hexadecimal digits."""
    return hashlib.sha256('\0'.join(parts).encode()).hexdigest()


def shown(text):
    """The words of a text in one line, separated by single blanks."""
    return ' '.join(text.split())


def cpp_files(folders, root=ROOT):
    """The names of the C++ files in folders, relative to the root."""
    found = []
    for folder in folders:
        for path in sorted((root / folder).rglob('*.[ch]pp')):
            if 'node_modules' not in path.parts:
                found.append(str(path.relative_to(root)))
    return found


def fingerprint(folders, suffixes, root=ROOT):
    """A hash of the files in `folders` that have one of `suffixes`. Leaves out npm's packages and
    this tool's files."""
    digest = hashlib.sha256()
    for folder in folders:
        for path in sorted((root / folder).rglob('*')):
            name = path.relative_to(root)
            is_other = {'node_modules', 'mutants'} & set(name.parts)
            if path.suffix in suffixes and path.is_file() and not is_other:
                digest.update(f'{name}\0'.encode() + path.read_bytes())
    return digest.hexdigest()[:16]

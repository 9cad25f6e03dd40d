"""The copy of the tree that contains the mutants: the folders' C++ files are its own, all else are links."""

import os
from pathlib import Path

from processes import run
from sources import FOLDERS, ROOT, WORK, read

HERE = Path(__file__).resolve().parent
COPY = WORK / 'tree'
BUILD = WORK / 'build'


def has_code(folder):
    return any('node_modules' not in path.parts for path in folder.rglob('*.[ch]pp'))


def write(path, text):
    """Writes a file where it is not so already: what did not change is not compiled again."""
    data = text.encode('latin-1')
    if path.is_symlink() or not path.exists() or path.read_bytes() != data:
        path.unlink(missing_ok=True)
        path.write_bytes(data)


def link(target, path):
    if path.is_symlink() and os.readlink(path) == str(target):
        return
    path.unlink(missing_ok=True)
    path.symlink_to(target)


def mirror(source, target, text_of):
    """A folder with C++ files: these from `text_of`, links to all else, nothing more."""
    target.mkdir(parents=True, exist_ok=True)
    names = {entry.name for entry in source.iterdir()}
    for entry in target.iterdir():
        if entry.name not in names:
            remove(entry)
    for entry in source.iterdir():
        if entry.is_dir() and has_code(entry):
            mirror(entry, target / entry.name, text_of)
        elif entry.suffix in ('.cpp', '.hpp'):
            write(target / entry.name, text_of(str(entry.relative_to(ROOT))))
        else:
            link(entry, target / entry.name)


def remove(path):
    """Removes what the tree no longer has."""
    if path.is_symlink() or path.is_file():
        path.unlink()
        return
    for entry in path.iterdir():
        remove(entry)
    path.rmdir()


def text_of_copy(name):
    """As the copy has it already, if it does."""
    return read(COPY / name) if (COPY / name).exists() else read(ROOT / name)


def make_copy(text_of):
    """Makes the copy, with the text that `text_of` gives for the name of a C++ file."""
    COPY.mkdir(parents=True, exist_ok=True)
    for entry in ROOT.iterdir():
        if entry.name in FOLDERS:
            mirror(entry, COPY / entry.name, text_of)
        elif entry.name not in ('.git', 'build'):
            link(entry, COPY / entry.name)


def configure():
    """The build of the copy: the product's semantics, less optimised. Sees files that are new or gone."""
    options = {
        'CMAKE_BUILD_TYPE': 'Release',
        'CMAKE_CXX_COMPILER': 'g++',
        'CMAKE_CXX_FLAGS_RELEASE': '-O1 -DNDEBUG -D_GLIBCXX_ASSERTIONS',
        'NEARMISS_MUTANTS': HERE,
        'CMAKE_PROJECT_nearmiss_INCLUDE': HERE / 'copy/CMakeLists.txt',
    }
    words = [f'-D{name}={value}' for name, value in options.items()]
    ended = run(['cmake', '-S', COPY, '-B', BUILD, '-G', 'Ninja', *words], cwd=COPY)
    if ended.code != 0:
        raise SystemExit(f'cmake failed:\n{ended.output}')


def ninja(targets, jobs, say=None):
    """Builds targets as far as possible. A precompiled header takes a cache longer than the compiler."""
    words = ['ninja', '-C', BUILD, f'-j{jobs}', '-k', '0', *targets]
    return run(words, cwd=COPY, env={'CCACHE_DISABLE': '1'}, seconds=24 * 3600, say=say)

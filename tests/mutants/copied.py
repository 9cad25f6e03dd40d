"""The copy of the tree that contains the mutants. The copy has its own C++ files and headers; all
other files are links."""

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
    """Writes a file if its text has changed, so that unchanged files are not compiled again."""
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
    """Copies a folder. C++ files and headers get the text that `text_of` gives, and all other
    files become links. Removes everything else from the copy."""
    target.mkdir(parents=True, exist_ok=True)
    names = {entry.name for entry in source.iterdir()}
    for entry in target.iterdir():
        if entry.name not in names:
            remove(entry)
    for entry in source.iterdir():
        if entry.is_dir() and has_code(entry):
            mirror(entry, target / entry.name, text_of)
        elif entry.suffix in ('.cpp', '.hpp', '.h'):
            write(target / entry.name, text_of(str(entry.relative_to(ROOT))))
        else:
            link(entry, target / entry.name)


def remove(path):
    """Removes a file or folder that the tree no longer has."""
    if path.is_symlink() or path.is_file():
        path.unlink()
        return
    for entry in path.iterdir():
        remove(entry)
    path.rmdir()


def text_of_copy(name):
    """The text of a file in the copy, or in the tree if the copy does not have the file."""
    return read(COPY / name) if (COPY / name).exists() else read(ROOT / name)


def make_copy(text_of):
    """Makes the copy. `text_of` gives the text of a C++ file by its name."""
    COPY.mkdir(parents=True, exist_ok=True)
    for entry in ROOT.iterdir():
        if entry.name in FOLDERS:
            mirror(entry, COPY / entry.name, text_of)
        elif entry.name not in ('.git', 'build'):
            link(entry, COPY / entry.name)


def configure():
    """Configures the build of the copy, with the product's semantics and less optimisation. Must
    run again when files appear or disappear."""
    options = {
        'CMAKE_BUILD_TYPE': 'Release',
        'NEARMISS_COMPONENTS': 'ccd;oracle;trial;tools;python;tests',
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
    """Builds as many of the targets as possible. Does not use a compiler cache, which is slower
    with precompiled headers than the compiler itself."""
    words = ['ninja', '-C', BUILD, f'-j{jobs}', '-k', '0', *targets]
    return run(words, cwd=COPY, env={'CCACHE_DISABLE': '1'}, seconds=24 * 3600, say=say)

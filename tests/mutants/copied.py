"""The copy of the tree that contains a mutant. The copy has its own C++ files and headers; all
other files are links."""

import os

from processes import run
from sources import FOLDERS, ROOT, WORK, read

COPY = WORK / 'tree'
BUILD = WORK / 'build'


def has_code(folder):
    return any('node_modules' not in path.parts for path in folder.rglob('*.[ch]pp'))


def write(path, text):
    """Writes a file if its text has changed, so that unchanged files are not compiled again."""
    data = text.encode()
    if path.is_symlink() or not path.exists() or path.read_bytes() != data:
        path.unlink(missing_ok=True)
        path.write_bytes(data)


def link(target, path):
    if path.is_symlink() and os.readlink(path) == str(target):
        return
    path.unlink(missing_ok=True)
    path.symlink_to(target)


def mirror(source, target, mutation):
    """Copies a folder. C++ files and headers become files, one of which may have the mutant; all other
    files become links. Removes from the copy what the folder does not have."""
    target.mkdir(parents=True, exist_ok=True)
    names = {entry.name for entry in source.iterdir()}
    for entry in target.iterdir():
        if entry.name not in names:
            remove(entry)
    for entry in source.iterdir():
        if entry.is_dir() and has_code(entry):
            mirror(entry, target / entry.name, mutation)
        elif entry.suffix in ('.cpp', '.hpp', '.h'):
            is_mutated = mutation is not None and entry == ROOT / mutation.file
            write(
                target / entry.name, mutation.applied(read(entry)) if is_mutated else read(entry)
            )
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


def make_copy(mutation=None):
    """Makes the copy, with the mutant if one is given."""
    COPY.mkdir(parents=True, exist_ok=True)
    for entry in ROOT.iterdir():
        if entry.name in FOLDERS:
            mirror(entry, COPY / entry.name, mutation)
        elif entry.name not in ('.git', 'build'):
            link(entry, COPY / entry.name)


def configure():
    """Configures the build of the copy. The code means the same as in the product, but is less optimised."""
    options = {
        'CMAKE_BUILD_TYPE': 'Release',
        'NEARMISS_COMPONENTS': 'ccd;oracle;trial;tools;python;tests',
        'CMAKE_CXX_COMPILER': 'g++',
        # Mutants cause many warnings.
        'CMAKE_CXX_FLAGS_RELEASE': '-O1 -DNDEBUG -D_GLIBCXX_ASSERTIONS -w',
        # The edits that make defective subjects do not fit headers that contain a mutant.
        'nearmiss_unedited': ROOT,
    }
    words = [f'-D{name}={value}' for name, value in options.items()]
    ended = run(['cmake', '-S', COPY, '-B', BUILD, '-G', 'Ninja', *words], cwd=COPY)
    if ended.code != 0:
        raise SystemExit(f'cmake failed:\n{ended.output}')


def ninja(targets, jobs):
    """Builds as many of the targets as possible. Uses no compiler cache: with precompiled headers, a
    cache is slower than the compiler."""
    words = ['ninja', '-C', BUILD, f'-j{jobs}', '-k', '0', *targets]
    return run(words, cwd=COPY, env={'CCACHE_DISABLE': '1'}, seconds=24 * 3600)

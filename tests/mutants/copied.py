"""A copy of the tree without a mutant, and the build of this copy. The copy has its own C++ files
and headers; all other files are links. A mutant is put into a layer over the copy and the build,
which stay unchanged. So several mutants can be built at a time, and nothing is compiled again when
a mutant is removed."""

import os
import shutil
from dataclasses import dataclass
from pathlib import Path

from processes import limits, run, seal
from sources import FOLDERS, ROOT, WORK, read

BASE = WORK / 'base'
COPY = BASE / 'tree'
BUILD = BASE / 'build'


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
    if path.exists() or path.is_symlink():
        remove(path)
    path.symlink_to(target)


def mirror(source, target):
    """Makes the folder `target` a copy of `source`: C++ files and headers are copied, all other files are
    linked. Removes from `target` what `source` does not have."""
    if target.is_symlink():  # to a folder that had no C++ file
        target.unlink()
    target.mkdir(parents=True, exist_ok=True)
    names = {entry.name for entry in source.iterdir()}
    for entry in target.iterdir():
        if entry.name not in names:
            remove(entry)
    for entry in source.iterdir():
        if entry.is_dir() and has_code(entry):
            mirror(entry, target / entry.name)
        elif entry.suffix in ('.cpp', '.hpp', '.h'):
            write(target / entry.name, read(entry))
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


def make_copy():
    COPY.mkdir(parents=True, exist_ok=True)
    for entry in ROOT.iterdir():
        if entry.name in FOLDERS:
            mirror(entry, COPY / entry.name)
        elif entry.name not in ('.git', 'build'):
            link(entry, COPY / entry.name)


def configure():
    """Configures the build of the copy, which optimises less than the product's build."""
    options = {
        'CMAKE_BUILD_TYPE': 'Release',
        'NEARMISS_COMPONENTS': 'ccd;oracle;trial;tools;python;tests',
        'CMAKE_CXX_COMPILER': 'g++',
        # Mutants cause many warnings.
        'CMAKE_CXX_FLAGS_RELEASE': '-O1 -DNDEBUG -D_GLIBCXX_ASSERTIONS -w',
        # The build makes defective subjects by editing headers. An edit could fail in a header
        # with a mutant, so the edits start from the original headers.
        'nearmiss_unedited': ROOT,
    }
    words = [f'-D{name}={value}' for name, value in options.items()]
    ended = run(['cmake', '-S', COPY, '-B', BUILD, '-G', 'Ninja', *words], cwd=COPY)
    if ended.code != 0:
        raise SystemExit(f'cmake failed:\n{ended.output}')


@dataclass
class Layer:
    """A layer over the copy and its build. Files that commands write to the copy or its build are
    kept in `folder` instead."""

    folder: Path

    def begin(self, mutation=None):
        """Empties the layer, and puts the mutant into it if one is given."""
        self.end()
        for name in ('upper', 'work'):
            (self.folder / name).mkdir(parents=True)
        if mutation is not None:
            changed = self.folder / 'upper' / (COPY / mutation.file).relative_to(BASE)
            changed.parent.mkdir(parents=True)
            changed.write_text(mutation.applied(read(COPY / mutation.file)))

    def end(self):
        for made_by_overlayfs in (self.folder / 'work').glob('*'):
            made_by_overlayfs.chmod(0o700)
        shutil.rmtree(self.folder, ignore_errors=True)

    def is_possible(self):
        """Whether this system can mount layers."""
        self.begin()
        possible = run(['true'], COPY, before=self.words()).code == 0
        self.end()
        return possible

    def words(self):
        """Words to put before a command so that it sees the layer."""
        user = [] if os.geteuid() == 0 else ['--user', '--map-current-user', '--keep-caps']
        folders = f'lowerdir={BASE},upperdir={self.folder}/upper,workdir={self.folder}/work'
        mount = 'mount -t overlay overlay -o "$1" "$2" && cd "$PWD" && shift 2 && exec "$@"'
        return ['unshare', *user, '--mount', 'sh', '-c', mount, 'sh', folders, BASE]


def before(layer, memory=None):
    """Words to put before a command so that it sees the layer, if one is given, and cannot kill
    other processes."""
    return [*(layer.words() if layer else []), *seal(), *limits(memory)]


def ninja(targets, jobs, layer=None):
    """Builds targets, until one fails. Uses no compiler cache: with precompiled headers, a
    cache is slower than the compiler."""
    words = ['ninja', '-C', BUILD, f'-j{jobs}', *targets]
    env = {'CCACHE_DISABLE': '1'}
    return run(words, COPY, env, seconds=24 * 3600, before=before(layer))

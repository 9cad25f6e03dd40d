"""Builds the extension modules with CMake, in build/wheel of the source tree.

The environment variable NEARMISS_COMPONENTS='oracle;python' leaves out trials, and the libraries that only
trials need. The environment variable NEARMISS_BUILD names a build folder that already has the modules.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

root = pathlib.Path(__file__).resolve().parents[2]
built = os.environ.get('NEARMISS_BUILD')
build = pathlib.Path(built) if built else root / 'build/wheel'


class CMakeBuild(build_ext):
    def run(self):
        if not built:
            self.build_modules()
        with tempfile.TemporaryDirectory() as prefix:
            cmake('--install', build, '--component', 'python', '--strip', '--prefix', prefix)
            (package,) = pathlib.Path(prefix).rglob('nearmiss/__init__.py')
            destination = pathlib.Path(self.build_lib) / 'nearmiss'
            shutil.copytree(package.parent, destination, dirs_exist_ok=True)
            # The file `copyright` is about the libraries whose headers are compiled into the modules.
            for terms in ('LICENSE', 'tools/debian/copyright'):
                shutil.copy(root / terms, destination)

    def build_modules(self):
        components = os.environ.get('NEARMISS_COMPONENTS', 'oracle;tools;python')
        generator = ['-G', 'Ninja'] if not (build / 'CMakeCache.txt').exists() else []
        cmake(
            '-S', root, '-B', build, *generator,
            f'-DNEARMISS_COMPONENTS={components}',
            '-DCMAKE_BUILD_TYPE=Release', f'-DPython_EXECUTABLE={sys.executable}',
        )  # fmt: skip
        cmake('--build', build, '--target', 'nearmiss_python')


def cmake(*arguments):
    subprocess.run(['cmake', *map(str, arguments)], check=True)


def version():
    text = (root / 'CMakeLists.txt').read_text()
    return re.search(r'project\(nearmiss VERSION ([\d.]+)', text)[1]


setup(
    version=version(),
    # The extension has no sources; it makes the wheel specific to this platform.
    ext_modules=[Extension('nearmiss._interface', [])],
    cmdclass={'build_ext': CMakeBuild},
)

"""Builds the extension modules with CMake, in build/wheel of the source tree.

The environment variable NEARMISS_COMPONENTS='oracle;python' leaves out trials, and the libraries that only they need.
"""

import os
import pathlib
import re
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

root = pathlib.Path(__file__).resolve().parents[2]
build = root / 'build/wheel'


class CMakeBuild(build_ext):
    def run(self):
        components = os.environ.get('NEARMISS_COMPONENTS', 'oracle;tools;python')
        generator = ['-G', 'Ninja'] if not (build / 'CMakeCache.txt').exists() else []
        cmake(
            '-S', root, '-B', build, *generator,
            f'-DNEARMISS_COMPONENTS={components}', '-DNEARMISS_PYTHON_DIR=.',
            '-DCMAKE_BUILD_TYPE=Release', f'-DPython_EXECUTABLE={sys.executable}',
        )  # fmt: skip
        cmake('--build', build, '--target', 'nearmiss_python')
        prefix = pathlib.Path(self.build_lib).resolve()
        cmake('--install', build, '--component', 'python', '--strip', '--prefix', prefix)


def cmake(*arguments):
    subprocess.run(['cmake', *map(str, arguments)], check=True)


def version():
    text = (root / 'CMakeLists.txt').read_text()
    return re.search(r'project\(nearmiss VERSION ([\d.]+)', text)[1]


setup(
    version=version(),
    # An extension without sources, so that the wheel is one of this platform.
    ext_modules=[Extension('nearmiss._interface', [])],
    cmdclass={'build_ext': CMakeBuild},
)

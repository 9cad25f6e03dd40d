"""Checks that clang accepts what the libFuzzer targets of the readers are made of.

Those targets are only built with clang, by hand (tools/libfuzzer), and the other tests only build with g++.
Usage: clang_test.py BUILD_FOLDER
"""

import concurrent.futures
import json
import os
import pathlib
import shlex
import subprocess
import sys

build = pathlib.Path(sys.argv[1])
root = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ('corpus', 'reports', 'fuzz/meshes', 'fuzz/libfuzzer', 'tools/certificates')
WITH_VALUE = ('-o', '-include')  # the output, and g++'s precompiled header


def clang_command(command):
    words = iter(shlex.split(command)[1:])
    kept = ['clang++', '-fsyntax-only', '-Wno-unknown-warning-option']
    for word in words:
        if word in WITH_VALUE:
            next(words)
        elif word != '-c' and not word.startswith(('-O', '--param')):
            kept.append(word)
    return kept


def complaints(entry):
    result = subprocess.run(
        clang_command(entry['command']), cwd=entry['directory'], capture_output=True, text=True
    )
    return '' if result.returncode == 0 else result.stderr


files = {}
for entry in json.loads((build / 'compile_commands.json').read_text()):
    if entry['file'].startswith(tuple(f'{root}/{folder}/' for folder in FOLDERS)):
        files[entry['file']] = entry
assert len(files) > 50, f'found {len(files)} files, expected those of {FOLDERS}'
with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
    found = [text for text in pool.map(complaints, files.values()) if text]
print('\n'.join(found) or f'{len(files)} files')
sys.exit(1 if found else 0)

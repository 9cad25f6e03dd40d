#!/usr/bin/env bash
# Uses an installed nearmiss as a user does: puts a CCD on trial, looks up a man page, and completes a command
# line.
# Usage: tools_test.sh PREFIX
set -euo pipefail
source "$(dirname "$0")/../../tools/options.sh"
options '' "$@"
((${#arguments[@]} == 1)) || refuse "expected PREFIX"
prefix=$(realpath "${arguments[0]}")
here=$(dirname "$script")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "FAILED: $*" >&2; exit 1; }

gcc -shared -fPIC -I"$prefix/include/nearmiss" -o boxes.so "$here/../plugin/example.c"
printf '%s\n' 'using V = const double*;' 'bool always(V, V, V, V, V, V, V, V) { return true; }' '#include "ccd/nearmiss_functions.hpp"' \
  'NEARMISS_SUBJECT(detector("always").vertex_triangle(always).edge_edge(always))' >always.cpp
g++ -std=c++17 -Wall -Wextra -Werror -shared -fPIC -I"$prefix/include/nearmiss" -o always.so always.cpp
nearmiss=$prefix/bin/nearmiss
code=0
"$nearmiss" fuzz --subject wang,fcl,bullet,bullet-double,./boxes.so,./always.so --cases 1000 --no-shrink --db a.db >said || code=$?
((code == 1)) || fail "fuzz: exit code $code: $(cat said)"  # FCL and Bullet miss collisions
for each in ' ok  wang: no miss' ' ok  boxes: no miss' ' ok  always: no miss' 'FAIL fcl: MISSED' 'FAIL bullet: MISSED' 'FAIL bullet-double: MISSED'; do
  grep -q "^$each" said || fail "expected '$each', found $(cat said)"
done
"$nearmiss" report a.db -o report >/dev/null || (($? == 1))
[[ -s report/index.html ]] || fail "no report"
"$nearmiss" demo >said
grep -q '^wang, the failure-proof CCD, reports it' said || fail "the demo: $(cat said)"

# A miss becomes a test, which proves with the installed checker that the query collides.
"$nearmiss" shrink nearmiss-demo.case --subject bridson:thickness=0 --as python >pasted.py
cp "$prefix/share/nearmiss/check.py" .
for answer in True False; do
  printf '%s\n' 'import pasted' "pasted.detects = lambda *_: $answer" \
    '[test() for name, test in vars(pasted).items() if name.startswith("test_")]' >$answer.py
done
python3 -B True.py || fail "the pasted test"
! python3 -B False.py 2>said || fail "the pasted test passes although the CCD misses"
grep -q 'assert detects' said || fail "$(cat said)"

man=$prefix/share/man/man1/nearmiss-fuzz.1.gz
[[ ! -e $man ]] || zgrep -q "Time limit per query" "$man" || fail "the man page"
words() { bash -c 'source "$1"; COMP_WORDS=(nearmiss fu) COMP_CWORD=1; _nearmiss; echo "${COMPREPLY[*]}"' - "$1"; }
found=$(words "$prefix/share/bash-completion/completions/nearmiss")
[[ $found == fuzz ]] || fail "bash completes 'nearmiss fu' to '$found'"
ls "$prefix"/share/zsh/*/_nearmiss >/dev/null

# CMake finds the program.
printf '%s\n' 'cmake_minimum_required(VERSION 3.25)' 'project(user LANGUAGES C)' 'find_package(nearmiss 1 REQUIRED COMPONENTS tools)' \
  'add_custom_target(ask COMMAND nearmiss::nearmiss --version)' >CMakeLists.txt
cmake -B build -DCMAKE_PREFIX_PATH="$prefix" >said || fail "$(cat said)"
cmake --build build --target ask >said
grep -q '^1\.' said || fail "CMake does not find the program: $(cat said)"
echo "the installed program puts 6 CCDs on trial"

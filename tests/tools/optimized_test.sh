#!/usr/bin/env bash
# Checks that OBJECTS, which are compiled with less optimization, and FAST_OBJECTS, the objects of
# ccd/ and oracle/, have no function in common. Otherwise, the linker could use the slower copy of
# such a function in place of the faster one.
# Usage: optimized_test.sh OBJECTS FAST_OBJECTS, each a list separated by blanks
set -euo pipefail
source "$(dirname "$0")/../../tools/options.sh"
options '' "$@"
((${#arguments[@]} == 2)) || refuse "expected OBJECTS FAST_OBJECTS"
# Prints the weak symbols of some objects: functions that the linker may take from another object instead.
shared() {
  # shellcheck disable=SC2086
  nm -C $1 | sed -n 's/^[0-9a-f]* W //p' | grep -E 'nearmiss::|Eigen::' | grep -vE '::~|excerpt' | sort -u
}
both=$(comm -12 <(shared "${arguments[0]}") <(shared "${arguments[1]}"))
[[ -z $both ]] || { echo "compiled with more and with less optimization: $both"; exit 1; }

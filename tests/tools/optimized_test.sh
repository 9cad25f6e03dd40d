#!/usr/bin/env bash
# Checks that, at link time, no function that is compiled with less optimization can replace one of ccd/ or
# oracle/.
# Usage: optimized_test.sh OBJECTS FAST_OBJECTS, each a list separated by blanks
set -euo pipefail
source "$(dirname "$0")/../../tools/options.sh"
options '' "$@"
((${#arguments[@]} == 2)) || refuse "expected OBJECTS FAST_OBJECTS"
# Prints the functions of some objects that the linker may also take from another object (weak symbols).
shared() {
  # shellcheck disable=SC2086
  nm -C $1 | sed -n 's/^[0-9a-f]* W //p' | grep -E 'nearmiss::|Eigen::' | grep -vE '::~|excerpt' | sort -u
}
both=$(comm -12 <(shared "${arguments[0]}") <(shared "${arguments[1]}"))
[[ -z $both ]] || { echo "compiled with more and with less optimization: $both"; exit 1; }

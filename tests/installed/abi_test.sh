#!/usr/bin/env bash
# Checks that programs compiled with an earlier minor version keep working. For this, the library
# must have all functions and types in oracle/interface/nearmiss.abi, and all constants in
# constants.txt, unchanged. The library may also have new ones.
# Usage: abi_test.sh [--write] LIBRARY, which has debug information
#   --write  replaces both files after an addition; any other change needs a new major version
set -euo pipefail
source "$(dirname "$0")/../../tools/options.sh"
write=false
options 'write' "$@"
((${#arguments[@]} == 1)) || refuse "expected LIBRARY"
library=$(realpath "${arguments[0]}")
cd "$(dirname "$0")/../../oracle/interface"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }

describe() {
  abidw --exported-interfaces-only --no-corpus-path --no-comp-dir-path --no-show-locs --no-elf-needed --no-architecture \
    --no-write-default-sizes --type-id-style hash --out-file "$1" "$library"
}
constants() {
  echo '#include "oracle/interface/nearmiss.h"' | gcc -dM -E -I../.. - | sed -nE 's/^#define (NEARMISS_\w+) (.+)/\1 \2/p' | sort
}
if $write; then
  describe nearmiss.abi
  constants >constants.txt
  exit
fi

abidiff --exported-interfaces-only --no-architecture --no-corpus-path --no-added-syms nearmiss.abi "$library" >"$folder/changes" 2>&1 ||
  fail "$(cat "$folder/changes")"
missing=$(comm -23 constants.txt <(constants))
[[ ! $missing ]] || fail "constants that are lost or have another value: $missing"

# Debian's list of symbols, which gives the first version that has each function, must be complete.
known=$(sed -nE 's/^ (nearmiss_\w+)@NEARMISS_1 .*/\1/p' ../../tools/debian/symbols | sort)
exported=$(nm -D --defined-only "$library" | sed -nE 's/.* T (\w+)@@NEARMISS_1$/\1/p' | sort)
[[ $known == "$exported" ]] || fail "tools/debian/symbols has: $known; the library: $exported"

echo "the interface keeps $(grep -c '<function-decl' nearmiss.abi) functions, their types, and $(wc -l <constants.txt) constants"

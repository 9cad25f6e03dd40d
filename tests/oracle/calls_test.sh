#!/usr/bin/env bash
# Checks that the only symbols of ours that the oracle calls and does not define are those of the Subject
# interface, and the one that chooses an instruction set, which changes no answer.
# Usage: calls_test.sh LIBRARY, the oracle's library
set -euo pipefail
source "$(dirname "$0")/../../tools/options.sh"
options '' "$@"
((${#arguments[@]} == 1)) || refuse "expected LIBRARY"
names() { nm -C "$1" | awk -v kinds="$2" 'match($0, " " kinds " ") { print substr($0, RSTART + 3) }' | sort -u; }
calls=$(comm -23 <(names "$1" '[U]' | grep 'nearmiss::') <(names "$1" '[TWVBDRu]'))
allowed='^(nearmiss::Subject::|nearmiss::refuse_coordinates\(|nearmiss::chosen_instructions\(|typeinfo for nearmiss::Subject$)'
[[ -n $calls ]] || { echo "found no calls at all: is this the library? $1"; exit 1; }
others=$(grep -vE "$allowed" <<<"$calls" || true)
[[ -z $others ]] || { echo "the oracle calls of others:"; echo "$others"; exit 1; }

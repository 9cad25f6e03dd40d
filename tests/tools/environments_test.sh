#!/usr/bin/env bash
# Runs tools/environments on two environments, and checks the script's output. Also checks which compiler
# flags the headers of ccd/ refuse.
set -euo pipefail
source "$(dirname "$0")/../../tools/options.sh"
cd "$(dirname "$0")/../.."
options '' "$@"
((${#arguments[@]} == 0)) || refuse "found '${arguments[0]}', expected no argument"
fail() { echo "$1"; exit 1; }

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
tools/environments --only '^wang g[+][+] -O2 (nearest|flush)$' --cases 2000 --results "$folder" >"$folder/out" 2>&1 ||
  { cat "$folder/out" "$folder/log"; fail "expected exit code 0"; }
grep -Eq '^wang +g\+\+ [0-9.]+ +-O2 +nearest +2,[0-9]+ .* 0 +keeps it$' "$folder/out" || { cat "$folder/out"; fail "expected that wang keeps it"; }
grep -Eq '^wang +g\+\+ [0-9.]+ +-O2 +flush .* MISSES +false-negative ' "$folder/out" ||
  { cat "$folder/out"; fail "expected that wang misses where subnormals are flushed"; }
grep -q '"verdict": "misses"' "$folder/report/report.json" || fail "expected the table in report.json"

compile() { g++ -std=c++20 -fsyntax-only -I. "$@" -x c++ - <<<'#include "ccd/query/arithmetic.hpp"'; }
if compile -ffast-math 2>"$folder/error"; then fail "expected that -ffast-math is refused"; fi
grep -q 'found -ffast-math' "$folder/error" || { cat "$folder/error"; fail "expected a line that says why"; }
compile || fail "expected that plain flags are not refused"
compile -ffast-math -DNEARMISS_ANY_ARITHMETIC || fail "expected that the environments can be compiled"

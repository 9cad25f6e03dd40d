#!/usr/bin/env bash
# Checks that operations of Lanes give the results of double, with a given compiler and each instruction set
# of this machine.
# Usage: lanes_test.sh COMPILER
set -euo pipefail
source "$(dirname "$0")/../../../tools/options.sh"
options '' "$@"
((${#arguments[@]} == 1)) || refuse "expected COMPILER"
compiler=${arguments[0]}
cd "$(dirname "$(realpath "$0")")/../../.."
program=$(mktemp)
trap 'rm -f "$program"' EXIT
sets=("")
! grep -qw avx2 /proc/cpuinfo || sets+=("-mavx2")
! grep -qw avx512dq /proc/cpuinfo || sets+=("-mavx512f -mavx512dq -mavx512vl -mbmi2")
for set in "${sets[@]}"; do
  # shellcheck disable=SC2086  # several flags
  "$compiler" -std=c++20 -O2 -fno-math-errno -ffp-contract=off -DEIGEN_DONT_VECTORIZE $set -I. $(pkg-config --cflags eigen3) \
    tests/ccd/compilers/lanes.cpp -o "$program"
  "$program" || { echo "FAILED: $compiler $set"; exit 1; }
  echo "$compiler $set: as double"
done

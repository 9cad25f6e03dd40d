#!/usr/bin/env bash
# Certificates of `nearmiss certify`, as users check them: with the checker in Python.
# Usage: tests/tools/certificates_test.sh NEARMISS
set -euo pipefail
cd "$(dirname "$0")/../.."
nearmiss=$1
check=(/usr/bin/python3 -B tools/certificates/check.py)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

fail() { echo "$1" >&2; exit 1; }

# expect CODE COMMAND...
expect() {
  local code=0
  "${@:2}" >"$folder/output" 2>&1 || code=$?
  [[ $code == "$1" ]] || fail "found exit code $code, expected $1, of: ${*:2}: $(head -c 300 "$folder/output")"
}

for family in uniform planted planted-ulp planar even-roots crossed decimals mixed-scale overflow near-separation; do
  for kind in vt ee; do
    "$nearmiss" family $family --kind $kind --count 20 >"$folder/queries"
    "$nearmiss" certify --kind $kind --toi --distance "$folder/queries" >"$folder/certificates"
    expect 0 "${check[@]}" -q "$folder/certificates"
  done
done

# A pair that touches its separation at an irrational time has no certificate.
missing() { "$nearmiss" family tied-separation --kind vt --first 194 --count 1 | "$nearmiss" certify --kind vt -; }
expect 1 missing
cp "$folder/output" "$folder/missing"
expect 1 "${check[@]}" "$folder/missing"

# A wrong claim is refused, and what is no JSON cannot be read.
"$nearmiss" family uniform --kind vt --count 30 | "$nearmiss" certify --kind vt - | sed 's/"apart"/"meets"/' >"$folder/wrong"
expect 1 "${check[@]}" "$folder/wrong"
echo '{"kind":' >"$folder/wrong"
expect 2 "${check[@]}" "$folder/wrong"
expect 2 "${check[@]}" "$folder/absent"

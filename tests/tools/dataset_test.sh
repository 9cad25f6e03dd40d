#!/usr/bin/env bash
# Writes a small data set twice, and expects the same bytes both times. Checks the truths, proofs
# and checksums.
# Usage: dataset_test.sh NEARMISS
set -euo pipefail
source "$(dirname "$0")/../../tools/options.sh"
cd "$(dirname "$0")/../.."
options '' "$@"
((${#arguments[@]} == 1)) || refuse "expected NEARMISS"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "$1"; exit 1; }

for name in a b; do tools/dataset "$folder/$name" --count 80 2>/dev/null; done
diff -r "$folder/a" "$folder/b" || fail "expected the same bytes"
(cd "$folder/a" && sha256sum --check --strict --quiet SHA256SUMS)
for class in ordinary degenerate extreme; do
  for kind in vt ee; do
    file=$folder/a/$class
    (($(wc -l <"$file/answers-$kind.txt") == 40)) || fail "$class $kind: expected 40 answers"
    python3 tools/certificates/check.py "$file/certificates-$kind.jsonl" >/dev/null || fail "$class $kind: expected proofs"
    diff <(sed -n 's/^# expect=//p' "$file/queries.$kind") <(cut -c1 "$file/answers-$kind.txt") || fail "$class $kind: truths differ"
  done
done
# The data set has each of the 240 queries, with its truth, both in CSV and as plain text.
"${arguments[0]}" replay "$folder/a" --subject exact --json "$folder/replay.json" >/dev/null || fail "expected no failure"
grep -q '"mismatches_with_recorded_truth": 0' "$folder/replay.json" || fail "expected that all truths are right"
grep -q '"queries": 480' "$folder/replay.json" || fail "expected 480 queries"
if tools/dataset "$folder/a" 2>"$folder/error"; then fail "expected that nothing is overwritten"; fi
grep -q 'exists already' "$folder/error" || fail "expected a line that says why"

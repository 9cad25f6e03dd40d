#!/usr/bin/env bash
# Builds the published CCDs of ../shared/peers with tools/peers, and asks each about a plain hit and a plain
# miss of each kind. Skipped (exit code 77) without that folder.
# Usage: peers_test.sh NEARMISS
set -euo pipefail
source "$(dirname "$0")/../../tools/options.sh"
options '' "$@"
((${#arguments[@]} == 1)) || refuse "expected NEARMISS"
nearmiss=$(realpath "${arguments[0]}")
cd "$(dirname "$0")/../.."
sources=
for each in ../shared/peers ../../shared/peers; do
  if [[ -d $each ]]; then sources=$each; break; fi
done
[[ $sources ]] || { echo "skipped: found no folder ../shared/peers"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

failures=0
fail() { echo "failed: $1"; ((++failures)); }

tools/peers --output "$folder/all" "$sources" >"$folder/built" || fail "expected that all are built"
(($(wc -l <"$folder/built") == 7)) || { cat "$folder/built"; fail "expected 7 plug-ins"; }

vt_hit='0.25 0.25 1  0 0 0  1 0 0  0 1 0   0.375 0.3125 -1  0 0 0  1 0 0  0 1 0'
vt_miss='0.25 0.25 2  0 0 0  1 0 0  0 1 0   0.375 0.3125 1  0 0 0  1 0 0  0 1 0'
ee_hit='-1 0 1  1 0.125 1  0 -1 0  0 1 0   -1 0.125 -1  1 0 -1  0 -1 0  0 1 0'
ee_miss='-1 0 2  1 0.125 2  0 -1 0  0 1 0   -1 0.125 1  1 0 1  0 -1 0  0 1 0'
# ask SUBJECT KIND QUERY: puts the answer into `said`.
ask() { said=$("$nearmiss" verdict --kind "$2" --subject "$1" <<<"$3" 2>&1) || said="exit code $?: $said"; }
while read -r plugin; do
  for kind in vt ee; do
    hit=${kind}_hit miss=${kind}_miss
    ask "$plugin" $kind "${!hit}"
    [[ $said == 1* ]] || fail "$plugin $kind: expected a hit, found '$said'"
    ask "$plugin" $kind "${!miss}"
    [[ $said == 0 ]] || fail "$plugin $kind: expected none, found '$said'"
  done
done <"$folder/built"

# Options are accepted, and wrong ones refused.
ask "$folder/all/tight-inclusion.so:tolerance=1e-3:iterations=100" vt "$vt_hit"
[[ $said == 1* ]] || fail "expected a hit, found '$said'"
ask "$folder/all/additive.so:iterations=1e3:rescaling=0.99" vt "$vt_miss"
[[ $said == 0 ]] || fail "expected none, found '$said'"
for bad in tight-inclusion:tolerance=x tight-inclusion:tolerance=-1 tight-inclusion:tolerance=nan additive:rescaling=2; do
  ask "$folder/all/${bad/:/.so:}" vt "$vt_hit"
  [[ $said == "exit code 2: nearmiss: "*"found '${bad#*:}', expected "*"=NUMBER from "* ]] || fail "$bad: found '$said'"
done
ask "$folder/all/tight-inclusion.so:tolerance=1e-3:tolerance=1" vt "$vt_hit"
[[ $said == *"found 'tolerance=1', expected "*", each once"* ]] || fail "an option given twice: found '$said'"
# The contract of MSRF: the primitives start farther apart than its minimum separation.
"$nearmiss" subjects "$folder/all/msrf.so" | grep -q 'the distance at t = 0 is more than 1e-08' || fail "msrf: found another contract"
# The contract of the paper's own code: a range of sizes, and no contact at t = 0.
"$nearmiss" subjects "$folder/all/safeccd.so" | grep -q 'apart at t = 0; .*multiples of .*e-50; .*1e+50 long' || fail "safeccd: found another contract"
ask "$folder/all/msrf.so:separation=1.5" vt "$vt_miss"
[[ $said == *"found the options 'separation=1.5', expected none"* ]] || fail "msrf takes an option: found '$said'"

# If a CCD cannot be built, a line says so, and the others are built.
cp -r "$sources" "$folder/broken"
chmod -R u+w "$folder/broken"
echo '#error no longer' >>"$folder/broken/safeccd/safeCCDWrapper.cpp"
rm "$folder/broken/root-parity/interval.cpp"
code=0
tools/peers --output "$folder/some" "$folder/broken" safeccd root-parity tight-bound >"$folder/built" 2>"$folder/said" || code=$?
((code == 2)) || fail "expected exit code 2, found $code"
(($(wc -l <"$folder/said") == 2)) || { cat "$folder/said"; fail "expected two lines"; }
grep -q "tools/peers: safeccd cannot be built: .*no longer" "$folder/said" || { cat "$folder/said"; fail "expected why safeccd cannot be built"; }
grep -q "tools/peers: root-parity cannot be built: .*found no .*/root-parity/interval.cpp" "$folder/said" || { cat "$folder/said"; fail "expected the missing file"; }
[[ $(cat "$folder/built") == "$folder/some/tight-bound.so" && -e $folder/some/tight-bound.so ]] || fail "expected that tight-bound is built"

((failures == 0)) || exit 1

#!/usr/bin/env bash
# Runs every script of the tree with --help, -h and --nonsense in a copy of the tree. Checks that it prints
# its usage or refuses, and changes nothing. Programs that would change something, such as cmake and sbatch,
# are replaced by a program that only records the call.
# Usage: scripts_test.sh NEARMISS
# shellcheck disable=SC2086  # two words in $options
set -euo pipefail
source "$(dirname "$0")/../../tools/options.sh"
options '' "$@"
((${#arguments[@]} == 1)) || refuse "expected NEARMISS"
nearmiss=$(realpath "${arguments[0]}")
cd "$(dirname "$0")/../.."
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

failures=0
fail() { echo "failed: $1"; ((++failures)); }

mkdir -p "$folder/tree/build/"{release,run,nightly,slurm,environments} "$folder/programs" "$folder/temporary"
find . \( -path ./build -o -path ./out -o -name .git -o -name node_modules -o -name __pycache__ \) -prune -o -type f -print0 |
  xargs -0 cp --parents -t "$folder/tree"
ln -s "$nearmiss" "$folder/tree/build/release/nearmiss"
touch "$folder/tree/build/"{run,nightly,slurm,environments}/precious
for program in apt-get cargo clang-tidy cmake ctest npm sbatch scancel squeue sudo; do
  printf '#!/bin/sh\necho "%s $*" >>"%s/called"\n' $program "$folder" >"$folder/programs/$program"
  chmod +x "$folder/programs/$program"
done
export PATH=$folder/programs:$PATH TMPDIR=$folder/temporary
cd "$folder/tree"

state() { find . -printf '%p %y %s %T@\n' | sort; ls -A "$TMPDIR"; cat "$folder/called" 2>/dev/null || true; }
before=$(state)
# try CODE SCRIPT ARGUMENTS...: puts a script's output into `said`, expects its exit code and no change.
try() {
  local code=0 now
  case $2 in *.mjs) said=$(timeout 20 node "${@:2}" 2>&1 </dev/null) || code=$? ;;
    *) said=$(timeout 20 "${@:2}" 2>&1 </dev/null) || code=$? ;; esac
  ((code == $1)) || fail "${*:2}: expected exit code $1, found $code: $said"
  now=$(state)
  [[ $now == "$before" ]] || { fail "${*:2}: changes something"; diff <(echo "$before") <(echo "$now") || true; before=$now; }
}
expect_said() { [[ ${said,,} == *"${1,,}"* ]] || fail "expected '$1', found '$said'"; }

mapfile -t scripts < <(find . \( -path ./build -o -path './.git*' \) -prune -o \( -type f -executable -o -name chart.mjs \) -print | sort)
((${#scripts[@]} >= 20)) || fail "found only the scripts ${scripts[*]}"
for each in "${scripts[@]}"; do
  for option in --help -h; do
    try 0 "$each" $option
    [[ $said ]] || fail "$each $option: expected the usage, found nothing"
  done
  try 2 "$each" --nonsense
  [[ $said ]] || fail "$each --nonsense: expected a line that says why, found nothing"
done

# An option's value follows a blank or an equals sign. A missing or wrong value is refused at once.
for options in "--keep 0" --keep=0; do try 2 tools/nightly $options; expect_said "found --keep '0'"; done
for options in "--time 9s" --time=9s; do try 2 tools/nightly $options; expect_said "found the time '9s'"; done
try 2 tools/nightly --subject ''; expect_said "found --subject '', expected CCDs"
try 2 tools/nightly --subject; expect_said "found --subject without a value"
try 2 tools/nightly tonight; expect_said "found 'tonight'"
try 2 tools/bench-commits; expect_said "found 0 commits, expected one or two"
try 2 tools/bench-commits --pairs 5 HEAD; expect_said "found --pairs '5'"
try 2 tools/run soon; expect_said "found the time 'soon'"
for options in "--only none" --only=none; do try 2 tools/environments $options; expect_said "matches 'none'"; done
try 0 tools/environments --list --only='^wang g[+][+] -O2 nearest$'
[[ $said == "wang g++ -O2 nearest" ]] || fail "expected one environment, found '$said'"
try 2 tools/environments --list=all; expect_said "expected --list without a value"
for options in "--jobs none" --jobs=none; do try 2 tools/libfuzzer $options false_negative 60s; expect_said "found --jobs 'none'"; done
for options in "--shards none" --shards=none; do try 2 tools/slurm/campaign $options; expect_said "found --shards 'none'"; done
try 2 tools/subject; expect_said "found no adapter"
try 2 tools/subject none.cpp; expect_said "found no file 'none.cpp'"
try 2 tools/subject fuzz/subjects/peers/fcl.cpp -lfcl; expect_said "unknown option '-lfcl'"
try 2 tools/subject fuzz/subjects/peers/fcl.cpp fcl.so; expect_said "found 'fcl.so', expected -- before the compiler's flags"
for options in "-o none/a.so" "-o a.so --pkg-config=none"; do
  try 2 tools/subject $options fuzz/subjects/peers/fcl.cpp; expect_said none
done
try 2 tools/subject -o; expect_said "found -o without a value"
try 2 tools/slurm/campaign --cases=10 --nonsense; expect_said nonsense
try 2 tools/slurm/campaign --cases=10 --db=a.db; expect_said "found --db=a.db"
try 2 tools/test --output-on-failure -R oracle --nonsense; expect_said "unknown option '--nonsense'"

((failures == 0)) || exit 1
echo "${#scripts[@]} scripts print their usage and refuse unknown options"

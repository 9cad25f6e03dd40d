#!/usr/bin/env bash
# Runs every script in a copy of the tree, with --help and with --nonsense. Checks that the script prints its
# usage for --help, refuses --nonsense, and changes nothing. The test replaces programs that would
# change something, such as cmake and sbatch, by a program that only records the call.
# Usage: scripts_test.sh NEARMISS
# shellcheck disable=SC2086  # several words in $command
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
# try CODE SCRIPT ARGUMENTS...: runs a script, and puts its output into `said`. Expects the exit code CODE,
# and that the script changes nothing.
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
  try 0 "$each" --help
  [[ $said ]] || fail "$each --help: expected the usage, found nothing"
  try 2 "$each" --nonsense
  [[ $said ]] || fail "$each --nonsense: expected a line that says why, found nothing"
done
try 0 tools/run -h

# An option's value follows a blank or an equals sign. Scripts refuse a missing or wrong value at once.
try 0 tools/environments --list --only='^wang g[+][+] -O2 nearest$'
[[ $said == "wang g++ -O2 nearest" ]] || fail "expected one environment, found '$said'"
while IFS='|' read -r words command; do  # the command's words are separated by blanks
  try 2 $command
  expect_said "$words"
done <<'END'
found --keep '0'|tools/nightly --keep 0
found --keep '0'|tools/nightly --keep=0
found the time '9s'|tools/nightly --time=9s
found --subject without a value|tools/nightly --subject
found 'tonight'|tools/nightly tonight
found 0 commits, expected one or two|tools/bench-commits
found --pairs '5'|tools/bench-commits --pairs 5 HEAD
found the time 'soon'|tools/run soon
matches 'none'|tools/environments --only none
expected --list without a value|tools/environments --list=all
found --jobs 'none'|tools/libfuzzer --jobs none false_negative 60s
found --shards 'none'|tools/slurm/campaign --shards=none
nonsense|tools/slurm/campaign --cases=10 --nonsense
found --db=a.db|tools/slurm/campaign --cases=10 --db=a.db
found no adapter|tools/subject
found no file 'none.cpp'|tools/subject none.cpp
unknown option '-lfcl'|tools/subject fuzz/subjects/peers/fcl.cpp -lfcl
found 'fcl.so', expected -- before the compiler's flags|tools/subject fuzz/subjects/peers/fcl.cpp fcl.so
none|tools/subject -o none/a.so fuzz/subjects/peers/fcl.cpp
none|tools/subject -o a.so --pkg-config=none fuzz/subjects/peers/fcl.cpp
found -o without a value|tools/subject -o
unknown option '--nonsense'|tools/test --output-on-failure -R oracle --nonsense
END

((failures == 0)) || exit 1
echo "${#scripts[@]} scripts print their usage and refuse unknown options"

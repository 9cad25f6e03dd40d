#!/usr/bin/env bash
# Runs tools/nightly in a copy of the tree in which set-up and libFuzzer do nothing. Checks exit
# codes and the baseline. Ends some nights by a signal, and others by a full disk. Checks that such
# a night still writes a report, and leaves no process behind. Also interrupts tools/run, and runs
# tools/libfuzzer twice at the same time.
# Usage: nightly_test.sh NEARMISS. Exit code 77: this user cannot mount a small disk; all else was checked.
# shellcheck disable=SC2016  # the command of --notify expands its own variables
set -euo pipefail
source "$(dirname "$0")/../../tools/options.sh"
options '' "$@"
((${#arguments[@]} == 1)) || refuse "expected NEARMISS"
# Only root may mount a disk. Another user becomes root in a new namespace, if the system allows that.
if ((EUID != 0)) && unshare --map-root-user --mount true 2>/dev/null; then exec unshare --map-root-user --mount "$0" "$@"; fi
nearmiss=$(realpath "${arguments[0]}")
source=$(realpath "$(dirname "$0")/../..")
folder=$(mktemp -d)
trap 'cd /; kill $(jobs -pr) 2>/dev/null || true; umount --recursive "$folder" 2>/dev/null || true; rm -rf "$folder"' EXIT
mount -t tmpfs none "$folder" 2>/dev/null || true  # only for speed

fail() { echo "failed: $1"; tail -n 20 "$folder/said" "$folder"/*/last/log 2>/dev/null || true; exit 1; }
expect() { "${@:2}" || fail "$1"; }
expect_said() { expect "expected '$1', found '$(<"$folder/said")'" grep -qE "$1" "$folder/said"; }

mkdir -p "$folder/tree/tools" "$folder/tree/build/release"
cp "$source/tools/"{nightly,run,options.sh,interrupts.sh} "$folder/tree/tools/"
cp -r "$source/corpus" "$folder/tree/"
cd "$folder/tree"
nothing() { printf '#!/bin/sh\n' | tee "$@" >/dev/null; chmod +x "$@"; }
nothing tools/setup tools/libfuzzer

# night CODE OPTIONS...: runs a night. Its campaigns have a limit of a few queries in place of a
# time limit. Expects the exit code CODE.
night() {
  local code=0
  sleep_until_next_second
  tools/nightly --results "$folder/the nights" "${@:2}" &>"$folder/said" || code=$?
  expect "expected exit code $1, found $code" test $code = "$1"
}
sleep_until_next_second() { local now=$EPOCHSECONDS; while ((EPOCHSECONDS == now)); do sleep 0.05; done; }
cat >build/release/nearmiss <<END_OF_SCRIPT
#!/usr/bin/env bash
cases=60
[[ " \$* " != *' --beyond-contract '* ]] || cases=600  # parity misses some of 600 queries
for ((i = 1; i <= \$#; ++i)); do
  if [[ \${!i} == --time ]]; then exec "$nearmiss" "\${@:1:i-1}" --cases \$cases "\${@:i+2}"; fi
done
exec "$nearmiss" "\$@"
END_OF_SCRIPT
chmod +x build/release/nearmiss

mkdir -p "$folder/the" "$folder/the nights/2nd Zoo"  # neither of these folders is a night
night 0 --subject wang
expect "expected a report" test -s "$folder/the nights/last/report/index.html"
# The night also puts root parity on trial. The report shows the collisions that root parity misses, but no
# night raises an alarm for them.
expect_said '^ ok  parity: no miss in [1-9]'
expect_said '^ --  parity \(beyond contract\): MISSED '
night 1 --subject wang,basic
expect_said '^not in the baseline: basic$'
expect "expected no new way to fail" test -z "$(grep '^new:' "$folder/said")"
"$nearmiss" report "$folder/the nights/last/all.db" -o "$folder/second" >"$folder/said" || (($? == 1))
began=$(grep -o '"started": "[^"]*"' "$folder/second/report.json" | sort | head -n 1 | cut -d '"' -f 4)
# The command of --notify gets the verdict and the path of the report's page. A command that fails or hangs
# does not change the night's exit code.
notified() { expect "expected '$1', found '$(<"$folder/notified")'" grep -qE "$1" "$folder/notified"; }
night 1 --subject wang,basic --results "$folder/told" --notify 'printf "%s|%s\n" "$1" "$2" >"'"$folder"'/notified"; exit 7'
notified "^nearmiss: alarm: basic missed .*\|$folder/told/2[^/]*Z/report/index.html$"
expect_said 'failed with exit code 7'
sed 's/ 60 bash/ 1 bash/' tools/nightly >tools/impatient && chmod +x tools/impatient
sleep_until_next_second
tools/impatient --results "$folder/told" --subject wang --notify 'trap "" TERM; sleep 100' &>"$folder/said" || fail "expected exit code 0"
expect_said 'failed with exit code 137'
rm tools/impatient
night 0 --subject wang --results "$folder/told" --notify 'kill -TERM $(ps -o ppid= -p $PPID); yes; rm -r "$(dirname "$2")"'
expect "expected a limit for what --notify prints" test "$(stat -c %s "$folder/told/last/log")" -lt 200000
code=0
tools/nightly --results "$folder/told" --subject ./none.so --notify 'printf "%s" "$1" >"'"$folder"'/notified"' &>"$folder/said" || code=$?
expect "expected exit code 2" test $code = 2
notified "^nearmiss: no report: found --subject './none.so'"
expect "expected a row for each night" test "$(grep -oE '"page": ?"2[^"]*/report/index.html"' "$folder/told/index.html" | sort -u | wc -l)" = 3
# A night raises an alarm for misses even if the baseline has them. The baseline consists of all
# earlier nights, so it has the misses of basic although the last night asked only wang.
night 0 --subject wang
night 1 --subject=wang,basic
expect_said '^lasting: [0-9]* ways to fail of basic, the oldest first seen 20.*Z .version .*.$'
seen=$(sed -nE 's/^lasting: .*, the oldest first seen ([^ ]*) .*/\1/p' "$folder/said")
expect "expected that the oldest was first seen in the second night, at $began, found $seen" test "$seen" = "$began"
# If --subject has root parity, the night treats it like any other subject, and runs no separate campaign.
night 0 --subject wang,parity
expect "expected no sample for root parity" test ! -e "$folder/the nights/last/parity.db"
# With --baseline 1, the baseline consists only of the night before the new one.
night 1 --subject wang,basic --baseline 1
expect_said '^not in the baseline: basic$'
# If a subject sometimes gives no answer, only the first night raises an alarm for this. A later
# night still raises an alarm for the misses of another subject.
fails=$(dirname "$nearmiss")/plugins/fail.so
export NEARMISS_ONE_IN=5
night 1 --subject "wang,$fails" --results "$folder/faults"
expect_said '^FAIL misbehaving: .*NO ANSWER '
expect_said '^alarm: misbehaving failed to answer '
night 0 --subject "wang,$fails" --results "$folder/faults"
expect_said '^FAIL misbehaving: '
night 1 --subject "wang,$fails,basic" --results "$folder/faults"
expect_said '^alarm: basic missed '
expect "expected no alarm for what lasts" test -z "$(grep '^alarm: .*misbehaving' "$folder/said")"
# The baseline leaves out a night that cannot be read. The name of this night has a future date, as
# if the clock had been ahead.
mkdir "$folder/the nights/2999-01-01T000000Z"
echo garbage >"$folder/the nights/2999-01-01T000000Z/all.db"
# The script keeps the night that has just run, although another night has a later date in its name.
night 0 --subject wang --keep 2
expect "expected two nights, found $(ls "$folder/the nights")" test "$(compgen -G "$folder/the nights/2*Z" | wc -l)" = 2
expect "expected that only nights are removed" test -d "$folder/the" -a -d "$folder/the nights/2nd Zoo"
expect "expected the latest night" test -s "$folder/the nights/last/all.db"
before=$(ls "$folder/the nights")
night 2 --subject ''
expect_said "found --subject '', expected CCDs"
night 2 --subject wang,./none.so
expect_said "found --subject 'wang,./none.so', expected CCDs with different names; paths are relative to $PWD"
night 2 --subject wang --results /proc/none
expect_said "found --results '/proc/none', expected a folder that can be made"
expect "expected no night of a CCD that is none" test "$(ls "$folder/the nights")" = "$before"
# The baseline counts a night and the copy of this night as one night. The script frees the disk
# space that a killed night has reserved, and --keep does not count the killed night.
cp -r "$folder/the nights/last/" "$folder/the nights/2001-01-01T000000Z copy"
mkdir "$folder/the nights/2002-01-01T000000Z"
touch "$folder/the nights/2002-01-01T000000Z/.reserve"
rm "$folder/the nights/2999-01-01T000000Z/all.db"
mkfifo "$folder/the nights/2999-01-01T000000Z/all.db"  # a pipe, which would be read for ever
CDPATH=. night 0 --subject wang --keep 3
rm -r "$folder/the nights/2999-01-01T000000Z"
expect "expected a report" test -s "$folder/the nights/last/report/index.html"
expect "expected that the killed night's reserve is given back" test ! -e "$folder/the nights/2002-01-01T000000Z/.reserve"
expect "expected three nights beside the killed one, found $(ls "$folder/the nights")" test "$(compgen -G "$folder/the nights/2[0-9]*Z*" | wc -l)" = 4
# The report of a campaign on a cluster leaves out shards that cannot be read, and copies of other shards.
mkdir "$folder/shards"
cp "$folder/the nights/last/families.db" "$folder/shards/shard-0.db"
cp "$folder/shards/shard-0.db" "$folder/shards/shard-1.db"
: >"$folder/shards/shard-2.db"
code=0
"$source/tools/slurm/report" "$nearmiss" "$folder/shards" &>"$folder/said" || code=$?
expect "expected exit code 2, found $code" test $code = 2
expect_said '^left out: 2 of 3 shards, which cannot be read or are copies$'
expect "expected a report of the other shard" test -s "$folder/shards/report/index.html"
# libFuzzer hunts equally long for each kind of failure of each subject, and for disagreements of the oracle.
cat >tools/libfuzzer <<END_OF_SCRIPT
#!/bin/sh
echo "\$3 \$4 \$5" >>"$folder/hunts"
mkdir -p "\$2/\$3" && cp corpus/cases/rounding/vt-planted.case "\$2/\$3/"
END_OF_SCRIPT
night 0 --subject wang,wang-time --time 100s
expect "expected six hunts of 6 s, found $(<"$folder/hunts")" cmp "$folder/hunts" - <<END_OF_HUNTS
false_negative 6s wang
refuted_bound 6s wang
false_negative 6s wang-time
late 6s wang-time
refuted_bound 6s wang-time
oracle_disagreement 6s 
END_OF_HUNTS
nothing tools/libfuzzer
# The night keeps the inputs that libFuzzer found, and replays them.
"$nearmiss" merge -v "$folder/found.db" "$folder/the nights/last/found.db" >"$folder/said" || fail "expected a replay of what was found"
expect_said '^oracle: 4 queries'
rm -r "$folder/the nights"

# Two hunts that run at the same time share a folder of inputs, but not their findings. Only one of
# the two hunts replaces the inputs.
mkdir -p fuzz build/fuzz "$folder/bin"
cp -r "$source/fuzz/libfuzzer" fuzz/
cp "$source/tools/libfuzzer" tools/
touch build/fuzz/build.ninja
nothing build/fuzz/fuzz_seeds
printf '#!/bin/sh\n! flock --nonblock build/lock true || touch "%s/unlocked"\n' "$folder" >"$folder/bin/cmake"
cat >build/fuzz/fuzz_late <<END_OF_SCRIPT
#!/bin/sh
case "\$*" in
  -help=1) exit ;;
  *-set_cover_merge=1*) echo >>"$folder/replaced"; exit ;;
esac
touch "\$NEARMISS_CASES/a.case"
while ! test -e "$folder/enough"; do sleep 0.05; done
END_OF_SCRIPT
chmod +x build/fuzz/fuzz_late "$folder/bin/cmake"
for each in one other; do
  PATH=$folder/bin:$PATH tools/libfuzzer --jobs 1 --found "$folder/$each" late 100s &>"$folder/$each.said" &
  until [[ -e $folder/$each/late/a.case ]]; do sleep 0.05; done
done
touch "$folder/enough"
wait
for each in one other; do
  cp "$folder/$each.said" "$folder/said"
  expect_said '^1 failures in '
done
expect "expected that one hunt replaces the inputs" test "$(wc -l <"$folder/replaced")" = 1
expect "expected that builds are locked" test ! -e "$folder/unlocked"
nothing tools/libfuzzer

cp build/release/nearmiss quick
ln -sf "$nearmiss" build/release/nearmiss

# Prints the processes whose working directory is this tree, except this script and the subshell that runs
# this function.
left() {
  local each
  for each in /proc/[0-9]*; do
    [[ ${each##*/} == "$$" || ${each##*/} == "$BASHPID" || $(readlink "$each/cwd" 2>/dev/null) != "$PWD" ]] || echo "${each##*/}"
  done
}
# begin RESULTS: starts a night of 100 hours in the background.
begin() {
  results=$folder/$1
  env --default-signal=INT,TERM,HUP tools/nightly --time 100h --subject wang --results "$results" &>"$folder/said" &
  night=$!
}
# until_ COMMAND...: repeats a command until it succeeds. Fails if the night in the background ends first.
until_() { until "$@"; do kill -0 "$night" 2>/dev/null || fail "the night ended before this: $*"; sleep 0.05; done; }
# ends CODE: waits for the night to end. Expects the exit code CODE, and that no process is left running.
ends() {
  local code=0
  wait "$night" || code=$?
  expect "expected exit code $1, found $code" test $code = "$1"
  [[ -z $(left) ]] || sleep 1  # a killed process takes a moment to disappear
  expect "expected that nothing is left running, found $(left)" test -z "$(left)"
}
expect_report() { expect "expected a report" test -s "$results/last/report/index.html"; expect_said '^ ok  wang: no miss in [1-9]'; }
saved() { compgen -G "$results/*/$1.db-wal" >/dev/null; }
exists() { [[ -e $1 ]]; }

# The night passes each signal on to its campaign, and the report shows the results so far.
for signal in TERM INT HUP; do
  begin "at-$signal"
  until_ saved families
  kill -$signal "$night"
  ends 130
  expect_report
  expect "SIG$signal: expected no further part" test -z "$(grep -E 'sweeps|libFuzzer' "$folder/said")"
done

# tools/run reacts to a signal in the same way.
env --default-signal=INT,TERM,HUP tools/run 100h &>"$folder/said" &
night=$!
until_ exists build/run/fuzz.db-wal
kill -TERM "$night"
ends 130
expect "expected a report" test -s build/run/report/index.html

# A signal has the same effect while tools/libfuzzer runs. If a signal comes during the set-up,
# there is no night.
forever() { printf '#!/bin/bash\ntrap "exit 130" TERM\ntouch %s\nwhile :; do sleep 0.1; done\n' "$folder/$1.begun" >"tools/$1"; }
rm build/release/nearmiss
cp quick build/release/nearmiss
forever libfuzzer
begin libfuzzer
until_ exists "$folder/libfuzzer.begun"
kill -TERM "$night"
ends 130
expect_report
forever setup
begin setup
until_ exists "$folder/setup.begun"
kill -TERM "$night"
ends 130
expect "expected no night" test "$(ls "$results")" = lock

# A full disk ends the night with a report of the results so far.
nothing tools/setup tools/libfuzzer
ln -sf "$nearmiss" build/release/nearmiss
mkdir "$folder/disk"
mount -t tmpfs -o size=70m none "$folder/disk" 2>/dev/null || { echo "skipped: a small disk cannot be mounted here"; exit 77; }
begin disk
until_ saved families
! head -c 100M /dev/zero >"$folder/disk/filler" 2>/dev/null || fail "the disk is not full"
ends 2
expect_report
expect_said 'that failed with exit code 2'
umount "$folder/disk"

# A night also writes its report if the disk has no room for a further file.
mount -t tmpfs -o size=1g,nr_inodes=2000 none "$folder/disk"
begin disk
until_ saved families
! touch "$folder/disk/"{1..2000} 2>/dev/null || fail "the disk has room for files"
kill -TERM "$night"
ends 130
expect_report
echo "nights report what there is, and know the last ones"

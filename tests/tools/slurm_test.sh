#!/usr/bin/env bash
# Tests that a campaign on a Slurm cluster gives the same report as one machine, even if one task reaches its
# time limit, one task is killed, and one task is cancelled before it runs. Starts a cluster of one node with
# all of its files in a temporary folder.
# Usage: slurm_test.sh NEARMISS. Exit code 77: there is no Slurm, or it cannot start.
set -euo pipefail
source "$(dirname "$0")/../../tools/options.sh"
options '' "$@"
((${#arguments[@]} == 1)) || refuse "expected NEARMISS"
nearmiss=$(realpath "$1")
tools=$(cd "$(dirname "$0")/../../tools/slurm" && pwd)
folder=$(mktemp -d)
PATH+=:/usr/sbin

daemons=()
clean() {
  local code=$?
  trap - EXIT
  if ((${#daemons[@]} > 1)) && scancel --user="$(id -un)" 2>/dev/null; then wait_until no_jobs || true; fi
  if ((${#daemons[@]})); then
    kill -KILL "${daemons[@]}" || true
    wait "${daemons[@]}" || true
  fi 2>/dev/null
  if ((code != 0 && code != 77)); then
    tail -n 30 "$folder"/*.log "$folder"/shared/*/*.log "$folder"/shared/*/summary.txt 2>/dev/null || true
  fi
  rm -rf "$folder"
  exit $code
}
trap clean EXIT
trap 'exit 130' INT TERM

skip() { echo "skipped: $1"; exit 77; }
fail() { echo "failed: $1"; exit 1; }
# wait_until COMMAND...: repeats a command until it succeeds. Fails after 200 s (the machine may be busy), or
# if a daemon has ended.
wait_until() {
  local end=$((SECONDS + 200))
  until "$@"; do
    for daemon in "${daemons[@]}"; do kill -0 "$daemon" || return 1; done
    ((SECONDS < end)) || return 1
    sleep 0.1
  done &>/dev/null
}
no_jobs() { local jobs; jobs=$(squeue --noheader) && [[ -z $jobs ]]; }

for program in munged slurmctld slurmd; do
  command -v $program >/dev/null || skip "there is no $program, which tools/setup installs"
done
read -r port other_port < <(node -e '
  const servers = [0, 1].map(() => require("net").createServer().listen(0, () => {
    if (servers.every((each) => each.listening)) {
      console.log(servers.map((each) => each.address().port).join(" "));
      process.exit();
    }
  }))')
head -c 128 /dev/urandom >"$folder/key"
chmod 600 "$folder/key"
munged --foreground --force --socket="$folder/munge" --key-file="$folder/key" --pid-file="$folder/munged.pid" \
  --log-file="$folder/munged.log" --seed-file="$folder/seed" &>"$folder/munged.log" &
daemons+=($!)
wait_until test -S "$folder/munge" || skip "munged does not start: $(tail -n 1 "$folder/munged.log")"

export SLURM_CONF=$folder/slurm.conf
mkdir "$folder/state" "$folder/spool"
cat >"$SLURM_CONF" <<END
ClusterName=test
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
# A requeued task waits in the queue until its credential expires, so credentials expire soon here.
AuthInfo=socket=$folder/munge,cred_expire=5
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,bf_interval=1,sched_interval=1
SlurmctldPort=$port
SlurmdPort=$other_port
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmdParameters=config_overrides
NodeName=$(hostname -s) NodeAddr=127.0.0.1 CPUs=2
PartitionName=test Nodes=ALL Default=YES
END
slurmctld -D &>"$folder/slurmctld.log" &
daemons+=($!)
slurmd -D &>"$folder/slurmd.log" &
daemons+=($!)
idle() { [[ $(sinfo --noheader --format=%T) == idle ]]; }
wait_until idle || skip "Slurm does not start: $(grep -h fatal "$folder"/slurm*.log || tail -qn 1 "$folder"/slurm*.log)"

# Makes the expected report: runs the campaign on one machine, and reports it with an earlier
# campaign as the baseline.
fuzz=(--cases 30000 --family uniform,small-integer,planted --subject basic,wang)
expect_code() {
  local code=0
  "${@:2}" &>"$folder/said.log" || code=$?
  ((code == $1)) || fail "expected exit code $1, found $code: ${*:2}"
}
expect_code 0 "$nearmiss" fuzz --cases 100 --db "$folder/earlier.db"
expect_code 1 "$nearmiss" fuzz "${fuzz[@]}" --db "$folder/one.db"
expect_code 1 "$nearmiss" report "$folder/one.db" -o "$folder/one" --baseline "$folder/earlier.db"

results="$folder/shared/two words"
campaign=("$tools/campaign" --nearmiss "$nearmiss" --shards 3 --results "$results")
expect_said() { grep -qF "$1" "$folder/said.log" || fail "expected '$1', found '$(cat "$folder/said.log")'"; }
expect_code 2 "${campaign[@]}" "${fuzz[@]}" --shards none
expect_said "found --shards 'none'"
expect_code 2 "${campaign[@]}" "${fuzz[@]}" --subject none
expect_said "nearmiss: "

# Holds the campaign until the second task is cancelled. Waits until the other two tasks have saved
# something. Then kills the first task, and sends the third task the signal that says that its time
# limit is near.
expect_code 0 "${campaign[@]}" "${fuzz[@]}" -- --hold
IFS=, read -r array report <"$results/jobs"
scancel "${array}_1"
scontrol release "$array" "$report"
expect_code 2 "${campaign[@]}" "${fuzz[@]}"
expect_said "jobs $array,$report still work on"
process_of() {
  local found
  found=$(grep -lsz "^$results/shard-$1.db$" /proc/[0-9]*/cmdline) && basename "${found%/cmdline}"
}
saved() { { "$nearmiss" report "$results/shard-$1.db" -o "$folder/peek" || (($? == 1)); } | grep wang; }
# Whether both the first and the third task have saved something. Stops the processes of both tasks
# while it looks, so that neither task can end. If a task has saved nothing yet, lets both
# processes go on.
both_saved() {
  first=$(process_of 0) && third=$(process_of 2) && kill -STOP "$first" "$third" || return 1
  if saved 0 && saved 2; then return; fi
  kill -CONT "$first" "$third"
  return 1
}
wait_until both_saved || fail "shards 0 and 2 save nothing"
kill -KILL "$first"
scancel --signal=USR1 --batch "${array}_2"
kill -CONT "$third"
wait_until no_jobs || fail "the campaign does not end"
expect_job() { [[ $(scontrol --oneliner show job "$1") == *$2* ]] || fail "job $1 has no $2"; }
expect_job "${array}_2" " JobState=COMPLETED *Restarts=1 "
expect_job "$report" " ExitCode=1:0 "
cp "$results/summary.txt" "$folder/said.log"
expect_said "fuzz: shards 1 of 3 are missing, shards 0 of 3 are not complete"

# The same command completes the missing shards. The script refuses another campaign in the same folder.
expect_code 2 "${campaign[@]}" "${fuzz[@]}" --seed 2
expect_said "found a run with"
expect_code 0 "${campaign[@]}" --baseline "$folder/earlier.db" "${fuzz[@]}"
IFS=, read -r array report <"$results/jobs"
wait_until no_jobs || fail "the campaign does not end"
expect_job "$report" " ExitCode=1:0 "
! grep '^fuzz:' "$results/summary.txt" || fail "something is missing"
node - "$folder/one" "$results/report" <<'END' || fail "the reports differ"
const [one, many] = process.argv.slice(2).map((folder) => {
  const times = ["started", "seconds", "ns_per_query", "times", "front_by_distance", "front_by_rate",
    "changed_times", "compared_times", "slower", "faster"];
  const report = JSON.parse(require("fs").readFileSync(`${folder}/report.json`));
  delete report.headline.text; // it counts slower families
  return JSON.stringify(report, (name, value) => (times.includes(name) ? undefined : value), 1);
});
require("assert").equal(many, one);
END
for cases in cases farthest; do
  diff -r "$folder/one/$cases" "$results/report/$cases" >/dev/null || fail "the $cases differ"
done
echo "a campaign of three shards on Slurm gave the report of one machine"

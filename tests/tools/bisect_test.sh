#!/usr/bin/env bash
# Makes git repositories, and checks that tools/bisect finds the commit that breaks or repairs a CCD.
# Usage: bisect_test.sh NEARMISS
set -euo pipefail
source "$(dirname "$0")/../../tools/options.sh"
options '' "$@"
((${#arguments[@]} == 1)) || refuse "expected NEARMISS"
NEARMISS=$(realpath "${arguments[0]}")
# shellcheck disable=SC2046
unset $(git rev-parse --local-env-vars)
export NEARMISS GIT_ALLOW_PROTOCOL=file GIT_CONFIG_GLOBAL=/dev/null GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a@b GIT_COMMITTER_NAME=a GIT_COMMITTER_EMAIL=a@b
root=$(realpath "$(dirname "$script")/../..")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "FAILED: $*" >&2; exit 1; }
echo '0.25 0.25 1  0 0 0  1 0 0  0 1 0   0.25 0.25 -1  0 0 0  1 0 0  0 1 0' >q.vt

git init -q -b main repository
cd repository
# The CCD is a plug-in in C. Its build replaces ANSWER by the text of the file `answer`: 0 makes the CCD miss
# everything, and other texts make its compilation fail.
cat >ccd.c <<'C'
#include "nearmiss_subject.h"
static void decide(void* s, int kind, size_t n, const double* x, const double* h, int* answer, double* toi) {
  (void)s, (void)kind, (void)x, (void)h, (void)toi;
  for (size_t i = 0; i < n; ++i) answer[i] = ANSWER;
}
const nearmiss_subject* nearmiss_get_subject(size_t index) {
  static const nearmiss_subject subject = {.interface_version = NEARMISS_INTERFACE, .name = "mine",
                                           .kinds = NEARMISS_VERTEX_TRIANGLE, .decide = decide};
  return index == 0 ? &subject : NULL;
}
C
build="cc -shared -fPIC -I$root/ccd -DANSWER=\"\$(cat answer)\" ccd.c -o mine.so"
# commit NUMBER ANSWER
commit() { echo "$2" >answer; echo "$1" >number; git add -A; git commit -qm "commit $1"; }

# Makes two histories of 12 commits. In one history, commit 5 breaks the CCD; in the other, commit 5 repairs
# the CCD. Commits 3 and 8 do not build.
for right in 0 1; do
  git checkout -q --orphan "history$right" 2>/dev/null
  what='first commit with the failure'
  ((!right)) || what='first commit without the failure'
  for ((i = 1; i <= 12; ++i)); do
    if ((i == 3 || i == 8)); then commit $i nonsense; else commit $i $((i < 5 ? !right : right)); fi
  done
  said=$("$root/tools/bisect" --from "history$right~11" --build "$build" --subject ./mine.so ../q.vt | tail -1) || fail "history $right: $said"
  [[ $said == "$what: "*": commit 5" ]] || fail "history $right: expected commit 5, found $said"
  git worktree list | grep -q bisect && fail "a worktree is left"
done

# Commit 2 does not build, so commit 2 or commit 3 may have broken the CCD. tools/bisect prints
# both commits.
git checkout -q --orphan skipped
commit 1 1; commit 2 nonsense; commit 3 0
code=0
said=$("$root/tools/bisect" --from HEAD~2 --build "$build" --subject ./mine.so ../q.vt) || code=$?
((code == 1)) && [[ $said == *'commit 2'*'commit 3'* || $said == *'commit 3'*'commit 2'* ]] || fail "skipped: code $code: $said"

# finds WHAT BUILD NUMBER: expects that tools/bisect searches the last four commits, and finds that the CCD
# first fails with commit NUMBER.
finds() {
  local before said
  before=$(git rev-parse HEAD; git symbolic-ref HEAD)
  said=$("$root/tools/bisect" --from HEAD~3 --build "$2" --subject ./mine.so ../q.vt 2>&1) || fail "$1: $said"
  [[ $said == *"first commit with the failure: "*": commit $3" ]] || fail "$1: expected commit $3, found $said"
  [[ $(git rev-parse HEAD; git symbolic-ref HEAD) == "$before" ]] || fail "$1: the user's HEAD is moved"
  [[ -z $(git status --porcelain) ]] || fail "$1: the user's files are changed"
}

# The build may change files that git tracks, move HEAD, and leave another repository behind.
git checkout -q --orphan odd
commit 1 1; commit 2 1; commit 3 0; commit 4 0
finds 'a build that changes files' "$build && echo changed | tee number answer && git init -q nested" 3
finds 'a build that commits' "$build && echo changed >number && git commit -qam built && git checkout -qb built\$\$" 3
finds 'a build that leaves a repository' "$build && [ ! -e nested ] && git init -q nested" 3

# tools/bisect ignores the variables that git sets for a hook, and runs none of the user's hooks.
printf '#!/bin/sh\ntouch "%s/hooked"\n' "$folder" >.git/hooks/post-checkout
chmod +x .git/hooks/post-checkout
(export GIT_DIR=$PWD/.git GIT_WORK_TREE=$PWD GIT_INDEX_FILE=$PWD/.git/index; finds 'in a hook' "$build" 3)
[[ ! -e $folder/hooked ]] || fail 'a hook of the user has run'
rm .git/hooks/post-checkout

# The hashes of a repository may have 64 digits.
git init -q -b main --object-format=sha256 ../sha256
(cd ../sha256; cp ../repository/ccd.c .; commit 1 1; commit 2 0; commit 3 0; commit 4 0; finds sha256 "$build" 2)

# A clone may have submodules, even nested ones, that are not checked out. Commit 3 replaces the submodule
# `outer` by a folder; both have a file `number`.
git init -q -b main ../inner
(cd ../inner; commit inner 1)
git init -q -b main ../outer
(cd ../outer; git submodule --quiet add ../inner inner; commit outer 1)
git checkout -q --orphan modules
git submodule --quiet add ../outer outer
commit 1 1; commit 2 1
git rm -qf outer; mkdir outer; echo file >outer/number
commit 3 0; commit 4 0
git clone -q -b modules ../repository ../clone
(cd ../clone
 finds submodules "$build && { grep -q file outer/number || [ -e outer/inner/answer ]; }" 3
 ! git config --get-regexp '^submodule' || fail 'a submodule is in the configuration')
git checkout -q -f skipped && git clean -ffdxq

# refused WORDS ARGUMENTS...
refused() {
  local code=0 said words=$1
  said=$("$root/tools/bisect" "${@:2}" 2>&1) || code=$?
  ((code == 2)) && [[ $said == *"$words"* ]] || fail "$*: code $code: $said"
}
refused 'both commits fail' --from HEAD --build "$build" --subject ./mine.so ../q.vt
refused "found --from 'nowhere'" --from nowhere --build "$build" --subject ./mine.so ../q.vt
refused 'found no --build' --from HEAD --subject ./mine.so ../q.vt
refused 'found no case' --from HEAD --build "$build" --subject ./mine.so
refused 'cannot be tried' --from HEAD~1 --build "$build" --subject ./mine.so ../q.vt
# If OLD (--from) or NEW (--to) cannot be built, tools/bisect gives the last line of the build's
# output as the reason, and also prints the last ten lines.
refused '   skipped: the build fails: no such header' --from HEAD~2 --build 'echo no such header; echo; false' --subject ./mine.so ../q.vt
refused $'\n16\n17\n18\n19\n20\n' --from HEAD~2 --build 'seq 20; false' --subject ./mine.so ../q.vt
[[ -z $(git status --porcelain) ]] || fail "the user's files are changed"

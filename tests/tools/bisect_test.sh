#!/usr/bin/env bash
# Lets tools/bisect find the commit that breaks or mends a CCD, in repositories that this test makes.
# Usage: bisect_test.sh NEARMISS
set -euo pipefail
source "$(dirname "$0")/../../tools/options.sh"
options '' "$@"
((${#arguments[@]} == 1)) || refuse "expected NEARMISS"
NEARMISS=$(realpath "${arguments[0]}")
export NEARMISS GIT_CONFIG_GLOBAL=/dev/null GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a@b GIT_COMMITTER_NAME=a GIT_COMMITTER_EMAIL=a@b
root=$(realpath "$(dirname "$script")/../..")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "FAILED: $*" >&2; exit 1; }
echo '0.25 0.25 1  0 0 0  1 0 0  0 1 0   0.25 0.25 -1  0 0 0  1 0 0  0 1 0' >q.vt

git init -q -b main repository
cd repository
# The CCD is a plug-in of C. WRONG makes it miss everything; without a semicolon it cannot be compiled.
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

# 20 histories of 12 commits: the answer changes at commit k, in one of both directions, and some commits do not build.
right=0
for ((k = 1; k <= 20; ++k)); do
  git checkout -q --orphan "history$k" 2>/dev/null
  change=$((2 + k % 11)) broken=$((1 + (5 * k) % 12))
  before=1 after=0 what='first commit with the failure'
  ((k % 2)) || { before=0 after=1 what='first commit without the failure'; }
  for ((i = 1; i <= 12; ++i)); do
    answer=$((i < change ? before : after))
    # The ends, the change and the commit before it can be built.
    if ((i == broken && i != 1 && i != 12 && i != change && i != change - 1)); then commit $i nonsense; else commit $i $answer; fi
  done
  said=$("$root/tools/bisect" --from "history$k~11" --build "$build" --subject ./mine.so ../q.vt | tail -1) || fail "history $k: $said"
  [[ $said == "$what: "*": commit $change" ]] || fail "history $k: expected commit $change, found $said"
  ((++right))
  git worktree list | grep -q bisect && fail "a worktree is left"
done
echo "the right commit in $right of 20"

# Only skipped commits are left: both are printed.
git checkout -q --orphan skipped
commit 1 1; commit 2 nonsense; commit 3 0
code=0
said=$("$root/tools/bisect" --from HEAD~2 --build "$build" --subject ./mine.so ../q.vt) || code=$?
((code == 1)) && [[ $said == *'commit 2'*'commit 3'* || $said == *'commit 3'*'commit 2'* ]] || fail "skipped: code $code: $said"

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
[[ -z $(git status --porcelain) ]] || fail "the user's files are changed"

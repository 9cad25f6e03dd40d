#!/usr/bin/env bash
# Tests the packages in a fresh Debian of this machine's release. Installs them, builds and runs users'
# programs with them, and puts CCDs on trial. Removes the packages again, and checks that no file is left.
# Then installs the packages that the library needs, and builds and installs the library from its
# sources. Takes ten minutes, and needs root, mmdebstrap, and Debian's mirror.
# Usage: debian_test.sh PACKAGES BUILD, the folders of the packages (tools/package) and of a build with tests
#        (tools/setup)
set -euo pipefail
source "$(dirname "$0")/../../tools/options.sh"
options '' "$@"
((${#arguments[@]} == 2)) || refuse "expected PACKAGES BUILD"
packages=$(realpath "${arguments[0]}") plugins=$(realpath "${arguments[1]}")/plugins queries=${arguments[1]}/tests/answered_queries
[[ -x $queries ]] || refuse "found no $queries (tools/setup builds it)"
queries=$(realpath "$queries")
cd "$(dirname "$script")/../.."
source tools/fresh_debian.sh
release=$(source /etc/os-release && echo "${VERSION_CODENAME-}")
folder=$(mktemp -d)
root=$folder/debian
trap 'rm -rf --one-file-system "$folder"' EXIT
trap 'exit 130' INT TERM HUP
fail() { echo "FAILED: $*" >&2; exit 1; }

for each in "$packages"/*.deb; do
  ! dpkg-deb -c "$each" | grep '^d' | grep -v '^drwxr-xr-x root/root ' || fail "$each changes a folder's owner or permissions"
done
make_debian "$release" "$root"
debian() { in_debian "$root" "$@"; }
get() { debian apt-get -qq "$@" >"$folder/log" 2>&1 || fail "apt-get $*: $(tail -20 "$folder/log")"; }
install() { get install -y --no-install-recommends "$@"; }
files() { (cd "$root" && find . -xdev \( -path ./proc -o -path ./tmp -o -path './var/lib/*' -o -path './var/cache/*' -o -path './var/log/*' \) -prune -o -print | sort); }

# Copies the sources as a user gets them, and writes queries with the answers of this source tree.
mkdir "$root/nearmiss"
git ls-files -z --cached --others --exclude-standard | xargs -0 cp --parents -t "$root/nearmiss"
"$queries" 6000 1 >"$root/queries"
cp "$packages"/*.deb "$root/"

# answers PREFIX: builds the project of tests/installed, and runs its programs.
answers() {
  debian cmake -S nearmiss/tests/installed -B "$1" -DCMAKE_BUILD_TYPE=Release >"$folder/log" 2>&1 &&
    debian cmake --build "$1" -j "$(nproc)" >>"$folder/log" 2>&1 || fail "$(tail -20 "$folder/log")"
  local program
  for program in answers_c answers_cpp contact_cpp templates; do
    debian "$1/$program" <"$root/queries" || fail "$program"
  done
}

get update
install g++ cmake make netbase  # Python 3.13 needs netbase; it makes /etc/hosts, and never removes it
files >"$folder/before"
install "$(cd "$root" && ls ./libnearmiss1_*.deb)"
debian sh -c 'ldconfig -p | grep -q libnearmiss.so.1' || fail "the linker does not know the library"
install "$(cd "$root" && ls ./libnearmiss-trial1_*.deb)"
install "$(cd "$root" && ls ./libnearmiss-dev_*.deb)" pkg-config
answers /tmp/packaged
debian sh -c 'gcc -std=c99 nearmiss/tests/installed/answers.c $(pkg-config --cflags --libs nearmiss) -o /tmp/answers && /tmp/answers'
install "$(cd "$root" && ls ./nearmiss_*.deb)" python3  # for the pasted test
debian /nearmiss/tests/installed/tools_test.sh /usr
debian sh -c 'cd /tmp && nearmiss demo'
install libgtest-dev catch2
debian sh -c 'cmake -S nearmiss/tests/installed/trial -B /tmp/trial -DCMAKE_BUILD_TYPE=Release && cmake --build /tmp/trial -j "$(nproc)"' >"$folder/log" 2>&1 ||
  fail "$(tail -20 "$folder/log")"
debian sh -c '/tmp/trial/gtest && /tmp/trial/catch'
get purge -y libgtest-dev catch2
install "$(cd "$root" && ls ./python3-nearmiss_*.deb)"
mkdir "$root/plugins"
cp "$plugins"/{cautious,hang}.so "$root/plugins"
debian python3 -B nearmiss/tests/python/trial_test.py /usr/bin/nearmiss /plugins
rm -r "$root/plugins"
get purge -y nearmiss
answers /tmp/without_tools
get remove -y libnearmiss-dev libnearmiss-trial1 libnearmiss1 pkg-config
debian python3 -B -c 'import nearmiss; assert nearmiss.collides("vt", [[0] * 3] * 8)'
get remove -y python3-nearmiss
debian apt-mark auto python3 >"$folder/log"
get autoremove -y --purge
rm -rf "$root"/tmp/*
files >"$folder/after"
diff "$folder/before" "$folder/after" >&2 || fail "files are left, or lost"
echo "the packages leave no file"

# These packages must be enough to build the library.
install libeigen3-dev libcgal-dev libboost-dev libgmp-dev libmpfr-dev
debian sh -c 'cd /nearmiss && cmake -B build && cmake --build build -j "$(nproc)" && cmake --install build && ldconfig' >"$folder/log" 2>&1 ||
  fail "$(tail -20 "$folder/log")"
answers /tmp/plain
echo "the library is built and installed with g++ cmake make libeigen3-dev libcgal-dev libboost-dev libgmp-dev libmpfr-dev"

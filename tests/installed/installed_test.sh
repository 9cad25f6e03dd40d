#!/usr/bin/env bash
# Installs nearmiss into an empty prefix, moves the prefix, and builds and runs users' programs there: in C
# and C++, with g++ and clang++, and with flags that users may set. Then runs the installed program.
# Usage: installed_test.sh BUILD
set -euo pipefail
source "$(dirname "$0")/../../tools/options.sh"
options '' "$@"
((${#arguments[@]} == 1)) || refuse "expected BUILD"
build=$(realpath "${arguments[0]}")
here=$(dirname "$script")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }
quietly() { "$@" >"$folder/log" 2>&1 || fail "$*: $(tail -30 "$folder/log")"; }

quietly cmake --install "$build" --prefix "$folder/first"
# The target `product` must build every file that is installed, so that a user of tools/run can install
# nearmiss.
ninja -C "$build" -t commands product >"$folder/product"
while read -r each; do
  grep -q -- "-o \S*${each##*/} " "$folder/product" || fail "the target product does not build $each"
done < <(find "$folder/first/bin" "$folder/first/lib" -type f \( -name '*.so*' -o -perm /1 \))
mv "$folder/first" "$folder/prefix"
"$build/tests/answered_queries" 6000 1 >"$folder/queries"

# Installed headers must not include headers by paths that other packages may also have.
! grep -rE '^ *#include "(ccd|oracle)/' "$folder/prefix/include" || fail "an installed header includes a path of the source tree"
! grep -rlE '#include <(CGAL|boost|gmp)' "$folder/prefix/include" || fail "an installed header needs a library that users need not have"

# check NAME COMPILER C-COMPILER FLAGS OPTION...: builds this folder's project, and runs its programs.
check() {
  local name=$1 cxx=$2 cc=$3 flags=$4
  shift 4
  CXX=$cxx CC=$cc cmake -S "$here" -B "$folder/$name" -DCMAKE_PREFIX_PATH="$folder/prefix" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_FLAGS="$flags" -DCMAKE_C_FLAGS="$flags" "$@" >"$folder/log" 2>&1 && cmake --build "$folder/$name" >>"$folder/log" 2>&1 ||
    fail "$name: $(tail -30 "$folder/log")"
  local program
  for program in answers_c answers_cpp contact_cpp templates; do
    [[ -x $folder/$name/$program ]] || continue
    echo -n "$name: "
    "$folder/$name/$program" <"$folder/queries" || fail "$name: $program"
  done
}
check g++ g++ gcc ""
check clang++ clang++ clang ""
check fast-math g++ gcc "-O3 -ffast-math -march=native" -DWITH_TEMPLATES=OFF
# With -march=native, clang 19 warns on some processors about a feature of their vector instructions.
check clang-fast-math clang++ clang "-O3 -ffast-math -march=native -Wno-unknown-warning-option -Wno-invalid-feature-combination" -DWITH_TEMPLATES=OFF

# The templates refuse unsafe flags. With clang++, the templates can recognise only the first two flags below.
refuse_flags() {
  local compiler=$1 flags
  shift
  for flags; do
    ! $compiler -std=c++20 $flags -I"$folder/prefix/include" $(pkg-config --cflags eigen3) -fsyntax-only -Wfatal-errors "$here/templates.cpp" 2>"$folder/log" ||
      fail "with $compiler, the templates accept $flags"
    grep -q 'nearmiss needs IEEE arithmetic: found -ffast-math' "$folder/log" || fail "$(cat "$folder/log")"
  done
}
refuse_flags g++ -ffast-math -ffinite-math-only "-ffast-math -fno-finite-math-only" -funsafe-math-optimizations -freciprocal-math
refuse_flags clang++ -ffast-math -ffinite-math-only

# The library ignores the environment variable NEARMISS_LANES, which only the executable nearmiss reads.
NEARMISS_LANES=16 "$folder/g++/answers_c"

# A user's tests put a CCD on trial: with GoogleTest, Catch2, libFuzzer, and nearmiss_add_trial of CMake.
quietly cmake -S "$here/trial" -B "$folder/trial" -DCMAKE_PREFIX_PATH="$folder/prefix"
quietly cmake --build "$folder/trial"
quietly "$folder/trial/gtest"
quietly "$folder/trial/catch"
quietly ctest --test-dir "$folder/trial" -R another
! ctest --test-dir "$folder/trial" -R mine >"$folder/log" || fail "the test of a CCD with a bug passes"
grep -q '<failure message="missed' "$folder/trial/trial_of_mine.xml" || fail "$(cat "$folder/log")"
clang++ -std=c++20 -fsanitize=fuzzer -I"$folder/prefix/include" "$here/trial/libfuzzer.cpp" -L"$folder/prefix/lib" -lnearmiss-trial -o "$folder/fuzzed"
! (cd "$folder" && LD_LIBRARY_PATH=$folder/prefix/lib ./fuzzed -runs=100) 2>"$folder/log" || fail "libFuzzer finds nothing"
grep -q '^mine failed' "$folder/log" || fail "libFuzzer: $(cat "$folder/log")"

# pkg-config
export PKG_CONFIG_PATH=$folder/prefix/lib/pkgconfig
gcc -std=c99 "$here/answers.c" $(pkg-config --cflags --libs nearmiss) -o "$folder/by_pkg_config"
LD_LIBRARY_PATH=$folder/prefix/lib "$folder/by_pkg_config"
[[ $(pkg-config --modversion nearmiss) == 1.* ]] || fail "the version of pkg-config"

# find_package refuses versions and components that are not installed.
mkdir "$folder/other"
for wanted in "2 COMPONENTS oracle" "1 COMPONENTS oracle fortran"; do
  printf 'cmake_minimum_required(VERSION 3.25)\nproject(other CXX)\nfind_package(nearmiss %s REQUIRED)\n' "$wanted" >"$folder/other/CMakeLists.txt"
  ! cmake -S "$folder/other" -B "$folder/other/b" -DCMAKE_PREFIX_PATH="$folder/prefix" >"$folder/log" 2>&1 || fail "find_package(nearmiss $wanted) succeeds"
done
grep -q 'The component fortran is not installed in' "$folder/log" || fail "$(cat "$folder/log")"

# If the user gives an absolute installation folder, it is used as it is, without the prefix.
quietly cmake -S "$here/../.." -B "$folder/absolute" -DNEARMISS_COMPONENTS=oracle -DCMAKE_INSTALL_LIBDIR=/a/lib -DCMAKE_INSTALL_INCLUDEDIR=/b/include
PKG_CONFIG_PATH=$folder/absolute/install pkg-config --cflags --libs nearmiss >"$folder/log"
grep -q -- '-I/b/include -L/a/lib -lnearmiss' "$folder/log" || fail "$(cat "$folder/log")"

# The library exports the functions of its interface, and nothing else.
shown=$(nm -D --defined-only "$folder/prefix/lib/libnearmiss.so" | awk '$2 == "T" {print $3}' | sed 's/@@NEARMISS_1$//' | sort)
declared=$(grep -ohE '\bnearmiss_[a-z_]+\(' "$folder"/prefix/include/nearmiss/{queries,wang,oracle}.h | tr -d '(' | sort -u |
  grep -vE '^nearmiss_(packed|of_mesh|of_points|vertices)' )
[[ $shown == "$declared" ]] || fail "exported: $shown; declared: $declared"

# A project may have the source tree as a subdirectory.
quietly cmake -S "$here" -B "$folder/subdirectory" -DNEARMISS_SOURCE="$here/../.."

# A build without options needs neither npm nor the libraries of the tools.
quietly cmake -S "$here/../.." -B "$folder/plain"
! grep -qE '^(SQLite|TBB|GTest|NLopt|CLI11)' "$folder/plain/CMakeCache.txt" || fail "a plain build looks for libraries of the tools"

# A build of only the component `trial` defines the macros that its files need.
quietly cmake -S "$here/../.." -B "$folder/only_trial" -DNEARMISS_COMPONENTS=trial
for each in 'NEARMISS_INSTALLED=.*supervisor.cpp' 'NEARMISS_INSTALLED=.*peers.cpp' 'NEARMISS_WORKER_CODE=.*supervisor.cpp'; do
  grep -q "$each" "$folder/only_trial/compile_commands.json" || fail "a build of only the trial has no $each"
done

# A build of only the templates needs no library except Eigen, and compiles nothing.
quietly cmake -S "$here/../.." -B "$folder/headers" -DNEARMISS_COMPONENTS=ccd -DCMAKE_DISABLE_FIND_PACKAGE_CGAL=ON \
  -DCMAKE_DISABLE_FIND_PACKAGE_Boost=ON
quietly cmake --install "$folder/headers" --prefix "$folder/only"
mkdir "$folder/alone"
printf '%s\n' 'cmake_minimum_required(VERSION 3.25)' 'project(alone CXX)' 'find_package(nearmiss 1 REQUIRED COMPONENTS ccd)' \
  'add_executable(alone alone.cpp)' 'target_link_libraries(alone nearmiss::ccd)' >"$folder/alone/CMakeLists.txt"
cat >"$folder/alone/alone.cpp" <<'END'
#include <nearmiss/ccd/wang.hpp>
using nearmiss::Kind;
int main() {
  const nearmiss::Query touching{.kind = Kind::vertex_triangle, .x = {}};
  return nearmiss::wang<Kind::vertex_triangle, double, nearmiss::WangOptions{}>(touching).hit ? 0 : 1;
}
END
quietly cmake -S "$folder/alone" -B "$folder/alone/b" -DCMAKE_PREFIX_PATH="$folder/only"
quietly cmake --build "$folder/alone/b"
quietly "$folder/alone/b/alone"

# CMake refuses unsafe flags and unknown components.
! cmake -S "$here/../.." -B "$folder/parts" -DNEARMISS_COMPONENTS=oracle -DCMAKE_CXX_FLAGS='-ffast-math -fno-finite-math-only' >"$folder/log" 2>&1 ||
  fail "cmake accepts a part of -ffast-math"
! cmake -S "$here/../.." -B "$folder/unknown" -DNEARMISS_COMPONENTS=ccd,oracle >"$folder/log" 2>&1 || fail "cmake accepts unknown components"
grep -q "found 'ccd,oracle', expected some of ccd, oracle" "$folder/log" || fail "$(cat "$folder/log")"

# The program uses its files in the prefix, even if the build folder has the same files. To show this, the
# test replaces the worker in the prefix by a script that notes its call, and a published CCD by an empty
# file.
"$here/tools_test.sh" "$folder/prefix"
private=$folder/prefix/lib/nearmiss
mv "$private/nearmiss-worker" "$private/worker"
printf '#!/bin/sh\ntouch "%s/called"\nexec "%s/worker" "$@"\n' "$folder" "$private" >"$private/nearmiss-worker"
chmod +x "$private/nearmiss-worker"
"$folder/prefix/bin/nearmiss" fuzz --subject fcl --cases 10 >/dev/null || (($? == 1))
[[ -e $folder/called ]] || fail "the program uses another worker"
: >"$private/peers/fcl.so"
! "$folder/prefix/bin/nearmiss" fuzz --subject fcl --cases 10 2>"$folder/log" || fail "the program uses another fcl.so"
grep -q "$private/peers/fcl.so" "$folder/log" || fail "$(cat "$folder/log")"

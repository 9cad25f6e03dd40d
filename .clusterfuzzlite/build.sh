#!/usr/bin/env bash
# Builds the libFuzzer targets the way OSS-Fuzz and ClusterFuzzLite expect: from the current folder, with the
# compilers and flags of the environment. $OUT receives each target, its seeds, its options, its dictionary
# and its libraries. The arguments are names of targets; without arguments, the script builds all targets.
set -euo pipefail
source tools/options.sh
options '' "$@"

# Ubuntu's libraries are built with libstdc++, so a program that links them must use libstdc++, too. With -w,
# warnings of a newer clang do not stop the build.
CXXFLAGS="${CXXFLAGS//-stdlib=libc++/} -w"

build=$WORK/build
cmake -G Ninja -B "$build" -DCMAKE_BUILD_TYPE=None -DNEARMISS_LIBFUZZER=ON -DNEARMISS_FUZZING_ENGINE="$LIB_FUZZING_ENGINE" \
  -DCMAKE_C_FLAGS="$CFLAGS" -DCMAKE_CXX_FLAGS="$CXXFLAGS" -DCMAKE_BUILD_RPATH='$ORIGIN/lib'
cmake --build "$build" --target fuzz_seeds
rm -rf "$WORK/seeds"
"$build/fuzz_seeds" "$WORK/seeds" corpus/cases
(($#)) || set -- $(ls "$WORK/seeds")
cmake --build "$build" --target "${@/#/fuzz_}"

mkdir -p "$OUT/lib"
for target in "$@"; do
  name=fuzz_$target
  cp "$build/$name" "$OUT/"
  (cd "$WORK/seeds/$target" && cmake -E tar cf "$OUT/${name}_seed_corpus.zip" --format=zip .)
  kind=query
  if [[ $target == read_* ]]; then
    kind=reader
    cp fuzz/libfuzzer/reader_target.dict "$OUT/$name.dict"
  fi
  cp "fuzz/libfuzzer/${kind}_target.options" "$OUT/$name.options"
  # Copies the libraries that the target needs. The machine that runs the target may have only the
  # libraries of glibc, so these are not copied.
  ldd "$build/$name" | awk '$2 == "=>" && $1 !~ /^lib(c|m|dl|rt|pthread|resolv)\.so/ {print $3}' |
    xargs cp -Lt "$OUT/lib"
done

#!/usr/bin/env bash
# Runs .clusterfuzzlite/build.sh as OSS-Fuzz does, but without a container. Checks that the built targets run
# without any file of this repository. Arguments name the targets. The default is two targets: one
# tests a reader, and the other decides queries. Keeps the build folder, because the first build
# takes minutes.
set -euo pipefail
source "$(dirname "$0")/../../tools/options.sh"
cd "$(dirname "$0")/../.."
options '' "$@"
(($#)) || set -- read_csv false_negative

fail() { echo "$1" >&2; exit 1; }
command -v clang++ >/dev/null || { echo "no clang++ here"; exit 77; }

# The settings come from the Dockerfile, and from OSS-Fuzz's image base-builder, which sets them
# for libFuzzer and the address sanitizer. Only -O0 differs, because optimisation would double the
# time of the build. The build uses one process, because other tests run at the same time.
root=$PWD/build/clusterfuzzlite
flags="-O0 -fno-omit-frame-pointer -gline-tables-only -DFUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION"
flags+=" -fsanitize=address -fsanitize-address-use-after-scope -fsanitize=fuzzer-no-link"
export SRC=$root/src WORK=$root/work OUT=$root/out
export CC=clang CXX=clang++ CFLAGS=$flags CXXFLAGS="$flags -stdlib=libc++" LIB_FUZZING_ENGINE=-fsanitize=fuzzer
export CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-1}
rm -rf "$SRC" "$OUT"
mkdir -p "$SRC" "$WORK" "$OUT"
cp .clusterfuzzlite/build.sh "$SRC/"
bash -eux "$SRC/build.sh" "$@"

# Moves the targets to another folder, and runs them in another current folder and without
# environment variables.
away=$(mktemp -d)
trap 'rm -rf "$away"' EXIT
mv "$OUT" "$away/out"
mkdir "$away/run"
cd "$away/run"

for target in "$@"; do
  exe=$away/out/fuzz_$target
  strangers=$(env -i /usr/bin/ldd "$exe" | awk -v lib="$away/out/lib/" \
    '$2 == "=>" && $1 !~ /^lib(c|m|dl|rt|pthread|resolv)\.so/ && index($3, lib) != 1 {print $1}')
  [[ -z $strangers ]] || fail "fuzz_$target does not find these in lib: $strangers"

  mkdir seeds
  (cd seeds && cmake -E tar xf "${exe}_seed_corpus.zip")
  seeds=$(find seeds -type f | wc -l)
  ((seeds > 100)) || fail "fuzz_$target has $seeds seeds"

  # Passes the arguments that OSS-Fuzz's image base-runner passes: two of its own, those in the target's
  # .options, and the target's .dict if it exists.
  arguments=(-rss_limit_mb=2560 -timeout=25 $(sed -n 's/^[a-z_]*=/-&/p' "$exe.options"))
  [[ ! -e $exe.dict ]] || arguments+=(-dict="$exe.dict")
  try() {
    env -i "$exe" "${arguments[@]}" "$@" &>log || { cat log; fail "fuzz_$target fails"; }
  }
  try -runs=4
  grep -q "^Done 4 runs" log || fail "fuzz_$target does not run without seeds"
  try -runs=$((seeds + 100)) seeds
  grep -q "seed corpus: files: $seeds " log || { cat log; fail "fuzz_$target does not read its seeds"; }
  if [[ $target != read_* ]]; then
    code=0
    env -i NEARMISS_SUBJECT=none "$exe" -runs=1 &>log || code=$?
    ((code == 2)) && grep -q "^unknown subject 'none'" log || { cat log; fail "fuzz_$target does not refuse an unknown subject"; }
  else
    grep -q "^Dictionary: [1-9]" log || fail "fuzz_$target has no dictionary"
  fi
  echo "fuzz_$target: $seeds seeds, $(grep '^Done' log)"
  rm -r seeds
done

#!/usr/bin/env bash
# Compiles plug-ins with tools/subject. Most plug-ins are three lines of C++ around functions with signatures
# that ccd/nearmiss_functions.hpp knows. These functions are in tests/plugin/foreign.hpp, which stands for a
# user's library. Asks each plug-in queries. Then checks that tools/subject says in one line why it cannot
# compile something.
# Usage: subject_test.sh NEARMISS
set -euo pipefail
source "$(dirname "$0")/../../tools/options.sh"
options '' "$@"
((${#arguments[@]} == 1)) || refuse "expected NEARMISS"
nearmiss=$(realpath "${arguments[0]}")
root=$(realpath "$(dirname "$script")/../..")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

failures=0
fail() { echo "failed: $1"; ((++failures)); }

# Makes the library as a user would have it: compiled, with files for pkg-config and CMake.
mkdir -p lib/cmake/foreign
eigen=$(pkg-config --variable=includedir eigen3)/eigen3
[[ -d $eigen ]] || eigen=/usr/include/eigen3
c++ -std=c++17 -O2 -fPIC -I "$eigen" -c "$root/tests/plugin/foreign.cpp" -o foreign.o
ar rcs lib/libforeign.a foreign.o
printf '%s\n' 'Name: foreign' 'Description: a CCD' 'Version: 1' "Cflags: -I$root/tests/plugin -I$eigen" \
  "Libs: -L$folder/lib -lforeign" >lib/foreign.pc
printf '%s\n' 'add_library(foreign::foreign STATIC IMPORTED)' 'set_target_properties(foreign::foreign PROPERTIES' \
  "  IMPORTED_LOCATION $folder/lib/libforeign.a INTERFACE_INCLUDE_DIRECTORIES \"$root/tests/plugin;$eigen\")" \
  >lib/cmake/foreign/foreignConfig.cmake
export PKG_CONFIG_PATH=$folder/lib CMAKE_PREFIX_PATH=$folder
# These are the flags of a user whose compiler hides symbols. The one function that a plug-in
# exports must still be visible.
by_flags=(-- -fvisibility=hidden -I"$root/tests/plugin" -isystem "$eigen" lib/libforeign.a)

# adapter NAME MEMBERS: writes NAME.cpp, an adapter of three lines.
adapter() { printf '%s\n' '#include "foreign.hpp"' '#include "ccd/nearmiss_functions.hpp"' "NEARMISS_SUBJECT(detector(\"$1\")$2)" >"$1.cpp"; }
# compile NAME OPTIONS...: compiles NAME.cpp, and expects that tools/subject prints the plug-in's path.
compile() {
  local name=$1 said
  shift
  said=$("$root/tools/subject" "${@/ADAPTER/$name.cpp}" 2>&1) || { fail "$name: $said"; return; }
  [[ $said == "./$name.so" && -s $name.so && ! -e $name.so.log ]] || fail "$name: expected ./$name.so, found '$said'"
}
# refused WHAT OPTIONS...: expects that tools/subject prints one line that contains WHAT, and makes no
# plug-in.
refused() {
  local code=0 said
  said=$("$root/tools/subject" "${@:2}" 2>&1) || code=$?
  [[ $code == 2 && $said != *$'\n'* && $said == *"$1"* ]] || fail "${*:2}: expected '$1', found exit code $code, '$said'"
}
# is NAME TEXT: expects that `nearmiss subjects` says TEXT about the plug-in NAME.so.
is() { "$nearmiss" subjects "./$1.so" >said || true; grep -qF -- "$2" said || fail "$1: expected '$2', found $(cat said)"; }
# answers SUBJECT KIND EXPECTED QUERY [OPTION...]: asks a subject one query. Expects that the answer matches
# EXPECTED.
answers() {
  local said
  said=$("$nearmiss" verdict --kind "$2" --subject "$1" "${@:5}" <<<"$4" 2>&1) || said="exit code $?: $said"
  [[ $said =~ ^$3 ]] || fail "$1 $2 ${*:5}: expected $3, found '$said'"
}

declare -A hit=(
  [vt]='0.25 0.25 1  0 0 0  1 0 0  0 1 0   0.25 0.25 -1  0 0 0  1 0 0  0 1 0'
  [ee]='-1 0 1  1 0 1  0 -1 0  0 1 0   -1 0 -1  1 0 -1  0 -1 0  0 1 0'
  [vv]='0 0 1  0 0 0   0 0 -1  0 0 0'
  [ve]='0 0 1  -1 0 0  1 0 0   0 0 -1  -1 0 0  1 0 0'
) miss=(
  [vt]='0.25 0.25 2  0 0 0  1 0 0  0 1 0   0.25 0.25 0.25  0 0 0  1 0 0  0 1 0'
  [ee]='-1 0 2  1 0 2  0 -1 0  0 1 0   -1 0 0.25  1 0 0.25  0 -1 0  0 1 0'
  [vv]='0 0 2  0 0 0   0 0 0.25  0 0 0'
  [ve]='0 0 2  -1 0 0  1 0 0   0 0 0.25  -1 0 0  1 0 0'
)
half='1 unspecified 0x1\.fffffff.*p-2'  # slightly less than 1/2

# The signatures of ipc-toolkit: member functions with default arguments, for all kinds.
narrow=NEARMISS_CALL\(foreign::ipc::Narrow
adapter ipc ".vertex_triangle($narrow().point_triangle_ccd)).edge_edge($narrow().edge_edge_ccd))
  .vertex_edge($narrow().point_edge_ccd)).vertex_vertex($narrow().point_point_ccd))"
compile ipc --pkg-config foreign ADAPTER
is ipc 'vt and ee and vv and ve; 53 bits; a lower bound of the time; takes a separation; batches of 1'
# The signatures of Codim-IPC, with displacements.
adapter accd '.vertex_triangle(foreign::accd::Point_Triangle_CCD<double>).edge_edge(foreign::accd::Edge_Edge_CCD<double>)'
compile accd --cmake 'foreign foreign::foreign' ADAPTER
is accd 'vt and ee; 53 bits; a lower bound of the time; takes a separation; batches of 1'
# The plainest signatures, with pointers, arrays and floats. They also compile as C++20.
adapter plain '.vertex_triangle(foreign::plain::vertex_triangle).edge_edge(foreign::plain::edge_edge)
  .vertex_vertex(foreign::plain::vertex_vertex).set(&nearmiss_subject::bits, 24)'
compile plain ADAPTER "${by_flags[@]}" -std=c++20
is plain 'vt and ee and vv; 24 bits; no time; batches of 1'

# A plug-in with several detectors. "contract" says that its times are lower bounds, although its
# signature implies another sort of time. The functions of "eltopo" are overloaded and take
# indices. "still" is a filter of steps that lets nothing move. "mixed" takes separations for only
# one of its kinds.
cat >all.cpp <<'END'
#include "foreign.hpp"
#include "ccd/nearmiss_functions.hpp"
using namespace nearmiss::plugin;
struct Settings { double gap = 0; };
constexpr std::array<nearmiss::Option<Settings>, 1> settings{{{"gap", &Settings::gap, 0, 1}}};
Answer within_gap(const Settings& set, const Question& q) {
  double toi = 0;
  return Answer::of(with_vertices(q, [&](auto... v) { return foreign::CTCD::edgeEdgeCTCD(v..., set.gap, toi); }));
}
NEARMISS_SUBJECT(
  detector("ctcd").vertex_triangle(foreign::CTCD::vertexFaceCTCD).edge_edge(foreign::CTCD::edgeEdgeCTCD),
  detector("contract").edge_edge(foreign::CTCD::edgeEdgeCTCD).set(&nearmiss_contract::apart_at_start, 1)
    .set(&nearmiss_subject::time_sort, NEARMISS_TIME_LOWER_BOUND).set(&nearmiss_subject::version, "7"),
  detector("eltopo").vertex_triangle(NEARMISS_CALL(foreign::eltopo::point_triangle_collision))
    .edge_edge(foreign::eltopo::segment_segment_collision),
  detector("timed").edge_edge(foreign::plain::edge_edge),
  detector("distances").vertex_vertex(foreign::plain::vertex_vertex)
    .vertex_vertex_distance(foreign::distances::vertex_vertex)
    .vertex_edge_distance(squared(NEARMISS_CALL(foreign::distances::vertex_edge_squared))),
  detector("alone").vertex_vertex_distance(foreign::distances::vertex_vertex),
  detector("still").vertex_vertex_step([](const Question& q, double* y) { std::copy(q.x, q.x + 6, y); return 0.0; }),
  detector("gap").options<settings>().edge_edge(within_gap),
  detector("mixed").edge_edge(foreign::CTCD::edgeEdgeCTCD).vertex_vertex(foreign::plain::vertex_vertex))
END
compile all ADAPTER "${by_flags[@]}"
for each in 'vt and ee; 53 bits; an estimate of the time; takes a separation; batches of 1' \
  'version 7; ee; 53 bits; a lower bound of the time; takes a separation; batches of 1' \
  'presumes: the primitives are apart at t = 0' 'vt and ee; 53 bits; no time; batches of 1' \
  'ee; 53 bits; an estimate of the time; batches of 1' \
  'vv; 53 bits; an estimate of the time; gives distances of vv and ve; batches of 1' \
  'decides nothing; 53 bits; no time; gives distances of vv; batches of 1' \
  'decides nothing; 53 bits; no time; filters steps of vv; batches of 1' \
  'vv; 53 bits; an estimate of the time; takes a separation for ee; batches of 1'; do
  is all "$each"
done
# asked COMMAND OPTION...: runs a command with 2,000 cases, and expects that it finds no failure.
asked() { "$nearmiss" "$@" --cases 2000 >said 2>&1 || fail "$*: $(cat said)"; }
asked distance --subject ./all.so:distances,./all.so:alone
asked step --subject ./all.so:still
"$nearmiss" distance --subject ./all.so:distances --kind ve - <<<"${miss[ve]}" >said && grep -q '^right 0x1p+1 ' said || fail "distances: $(cat said)"
answers ./all.so:gap:gap=0.5 ee 1 "${miss[ee]}"
answers ./all.so:gap ee 0 "${miss[ee]}"
answers ./all.so:gap:gap=2 ee "exit code 2: .*found 'gap=2', expected gap=NUMBER from 0 to 1, once" "${miss[ee]}"
answers ./all.so:gap:gap=0:gap=1 ee "exit code 2: .*found 'gap=1', expected gap=NUMBER" "${miss[ee]}"
answers ./all.so:ctcd:gap=1 ee "exit code 2: .*found the options 'gap=1', expected none" "${miss[ee]}"

for each in ipc accd all:ctcd all:eltopo plain; do
  subject=./${each/:/.so:} timed=$half
  [[ $each == *:* ]] || subject+=.so
  case $each in all:eltopo | plain) timed=1 ;; esac
  for kind in vt ee vv ve; do
    [[ " $("$nearmiss" subjects "$subject") " == *" $kind"[\ \;]* ]] || continue
    answers "$subject" $kind "$timed" "${hit[$kind]}"
    answers "$subject" $kind 0 "${miss[$kind]}"
    case $each in ipc | accd | all:ctcd)  # the distance falls from 2 to 0.25, and is 0.5 at t = 6/7
      answers "$subject" $kind '1 unspecified 0x1\.b6db6db.*p-1' "${miss[$kind]}" --separation 0.5
      answers "$subject" $kind 0 "${miss[$kind]}" --separation 0.125 ;;
    esac
  done
  asked fuzz --subject "$subject"
done
asked fuzz --subject ./ipc.so,./accd.so,./all.so:ctcd --separation drawn
asked fuzz --subject ./all.so:contract

adapter forgotten '.vertex_triangle(foreign::forgotten)'
refused 'the plug-in cannot be loaded: ' forgotten.cpp "${by_flags[@]}"
[[ ! -e forgotten.so ]] || fail "forgotten.so is left"
adapter unusual '.vertex_triangle([](int) { return true; })'
# tools/subject replaces a file only if it is a plug-in.
echo mine >precious.so
refused "found './precious.so', which is no plug-in" -o precious.so unusual.cpp
[[ $(cat precious.so) == mine ]] || fail "precious.so was replaced"
refused "expected FILE.so" -o unusual.cpp unusual.cpp
[[ -s unusual.cpp ]] || fail "unusual.cpp was replaced"
refused 'the function has none of the signatures that nearmiss_functions.hpp lists' unusual.cpp "${by_flags[@]}"
grep -q static_assert unusual.so.log || fail "unusual.so.log: found $(cat unusual.so.log)"
adapter broken '.nothing()'
refused nothing broken.cpp "${by_flags[@]}"
refused "found no file 'none.cpp'" none.cpp
refused "pkg-config: Package none was not found" --pkg-config none ipc.cpp
refused "found no CMake package 'none'" --cmake 'none none::none' ipc.cpp
refused 'CMake: Target "subject" links to: foreign::none but the target was not found.' --cmake 'foreign foreign::none' ipc.cpp
refused "expected 'PACKAGE TARGET...'" --cmake none ipc.cpp
refused "found 'x', expected -- before the compiler's flags" ipc.cpp x

((failures == 0)) || exit 1

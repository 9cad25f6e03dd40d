#!/usr/bin/env bash
# Checks the licence of every header of CGAL, Eigen and Boost that the compiler has read while it
# built the library (oracle/interface/licences.md).
# Usage: licences_test.sh BUILD
set -euo pipefail
source "$(dirname "$0")/../../tools/options.sh"
options '' "$@"
((${#arguments[@]} == 1)) || refuse "expected BUILD"
cd "${arguments[0]}"
headers=$(ninja -t deps | awk '/^[^ ]/ { ours = /^(ccd|oracle)\// } ours && /^ / { print $1 }' | sort -u)
fail() { echo "FAILED: another licence: $*" >&2; exit 1; }
# of LIBRARY LEAST: sets `read` to the headers of LIBRARY that the compiler has read. Ends the test
# if there are fewer than LEAST headers.
of() {
  mapfile -t read < <(grep "^/usr/include/$1/" <<<"$headers")
  ((${#read[@]} >= $2)) || refuse "found only ${#read[@]} headers of $1, expected $2 (tools/setup builds)"
  echo "$1: ${#read[@]} headers"
}
of CGAL 100
others=$(grep -LE '^(//| \*) SPDX-License-Identifier: (LGPL-3.0-or-later( OR LicenseRef-Commercial)?|BSL-1.0)$' "${read[@]}") || true
[[ ! $others ]] || fail "$others"
for library in eigen3 boost; do
  of $library 100
  ! grep -lE '\bL?GPL\b|General Public' "${read[@]}" || fail "$library"
done

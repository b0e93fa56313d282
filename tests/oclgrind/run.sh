#!/bin/sh
# Runs the kernels' small test on Oclgrind's simulated device: run.sh TEST_KERNELS. Any access out of bounds, data race or wrong
# use of the API fails, as does a result that differs from the scalar twins.
# Exit code 0: fine; 1: not; 77: there is no oclgrind.
set -u
[ $# -eq 1 ] || { echo "usage: $0 TEST_KERNELS" >&2; exit 2; }
command -v oclgrind >/dev/null || { echo "skipped: no oclgrind"; exit 77; }
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
# Kernels compiled for this device are of no use to another.
export XDG_CACHE_HOME="$folder"
# Unoptimised: Oclgrind does not know all that a newer compiler leaves in inlined code.
oclgrind --build-options "-O0" --data-races --check-api --max-errors 10000 --log "$folder/log" "$1" "[oclgrind]"
code=$?
# One race is meant: a plain look at a key before atom_min() on it. Keys only fall, so that an old one costs an atomic, no sample.
# Messages start in the first column, what belongs to them is indented.
awk '
    function judge() {
        if (message != "" && !(message ~ /^Read-write data race/ && message ~ /cover_small/ && message ~ /load i64/ && message ~ /atom_min/))
            printf "%s", message
    }
    /^[^ \t]/ { judge(); message = "" }
    /[^ \t]/ { message = message $0 "\n" }
    END { judge() }' "$folder/log" >"$folder/errors"
cat "$folder/errors"
[ $code -eq 0 ] && [ ! -s "$folder/errors" ] || exit 1

#!/bin/sh
# Runs the kernels' small test on Oclgrind's simulated device: run.sh TEST_KERNELS. Any access out of bounds, data race, wrong
# use of the API or value used before it is set fails, as does a result that differs from the scalar twins.
# Exit code 0: fine; 1: not; 77: there is no oclgrind.
set -u
[ $# -eq 1 ] || { echo "usage: $0 TEST_KERNELS" >&2; exit 2; }
command -v oclgrind >/dev/null || { echo "skipped: no oclgrind"; exit 77; }
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
# Kernels compiled for this device are of no use to another.
export XDG_CACHE_HOME="$folder"
oclgrind --data-races --check-api --uninitialized --max-errors 20 --log "$folder/log" "$1" "[oclgrind]"
code=$?
if [ -s "$folder/log" ]; then
    cat "$folder/log"
    exit 1
fi
[ $code -eq 0 ] || exit 1

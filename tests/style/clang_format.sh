#!/bin/sh
# Lists the C++ files that clang-format would write differently: clang_format.sh SOURCE_FOLDER.
# Exit code 0: none; 1: some; 77: there is no clang-format.
set -u
[ $# -eq 1 ] || { echo "usage: $0 SOURCE_FOLDER" >&2; exit 2; }
command -v clang-format >/dev/null || { echo "skipped: no clang-format"; exit 77; }
cd "$1" || exit 2
differ=0
for file in $(find src tests bench -name '*.cpp' -o -name '*.h' | sort); do
    clang-format --dry-run --Werror "$file" >/dev/null 2>&1 || { echo "$file"; differ=$((differ + 1)); }
done
echo "$differ files are not as 'clang-format -i' leaves them"
[ $differ -eq 0 ]

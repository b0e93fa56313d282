#!/bin/sh
# The Debian packages of packages.txt: packages.sh check|install GROUP...
# check: names what is missing, exit code 1. install: fetches what is missing, if that is allowed here.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
usage="usage: $0 check|install build|test|develop..."
[ $# -ge 2 ] || { echo "$usage" >&2; exit 2; }
action=$1
shift
case $action in check | install) ;; *) echo "$usage" >&2; exit 2 ;; esac

# Another system knows these libraries by other names; there CMake says what it does not find.
command -v dpkg-query >/dev/null || exit 0

missing=
for group in "$@"; do
    for package in $(awk -v group="$group" '$1 == group { print $2 }' "$here/packages.txt"); do
        state=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) || state=absent
        [ "$state" = installed ] || missing="$missing $package"
    done
done
[ -n "$missing" ] || exit 0

if [ "$action" = check ]; then
    echo "missing packages:$missing  (\`make packages\` installs them)" >&2
    exit 1
elif [ "$(id -u)" -eq 0 ]; then
    as_root=
elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
    as_root="sudo -n"
else
    echo "missing packages, and no right to install them; please run: sudo apt-get install$missing" >&2
    exit 1
fi

echo "installing:$missing"
apt="$as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=300"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
# Package lists that are there already may do; else they are fetched first.
# shellcheck disable=SC2086  # both variables are lists of words
$apt install -y --no-install-recommends $missing </dev/null >"$log" 2>&1 ||
    { $apt update && $apt install -y --no-install-recommends $missing; } </dev/null >"$log" 2>&1 ||
    { cat "$log" >&2; echo "could not install:$missing" >&2; exit 1; }

#!/bin/sh
# Has other programs read cubes of ours: run.sh TEST_IMAGE, the test program of src/image.
# Exit code 0: all that are installed agree; 1: one does not; 77: none is installed.
set -u
[ $# -eq 1 ] || { echo "usage: $0 TEST_IMAGE" >&2; exit 2; }
program=$1
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT

SPECTRAD_INTEROP=$folder "$program" "[interop]" >"$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }

# The first Python that has a module: distributions keep theirs apart from one in a virtual environment.
python_with() {
    for candidate in "${PYTHON:-python3}" /usr/bin/python3; do
        "$candidate" -c "import $1" 2>/dev/null && { echo "$candidate"; return; }
    done
    echo "${PYTHON:-python3}"
}

run=0 failed=0
judge() { # NAME EXIT-CODE
    case $2 in
        0) echo "$1: fine"; run=$((run + 1)) ;;
        77) echo "$1: skipped" ;;
        *) echo "$1: FAILED"; failed=$((failed + 1)) ;;
    esac
}

"$(python_with OpenImageIO)" "$here/read_exr_oiio.py" "$folder"/*.exr
judge OpenImageIO $?
"$(python_with colour)" "$here/read_exr_colour.py" "$folder"/*.exr
judge colour-science $?
"$(python_with spectral)" "$here/read_envi_spy.py" "$folder"/*.img
judge "Spectral Python" $?
if command -v gdalinfo >/dev/null; then
    gdalinfo "$folder/envi.img" | grep -q 'wavelength=780'
    judge GDAL $?
else
    judge GDAL 77
fi
echo '#include <tinyexr.h>' >"$folder/probe.cpp"
if ${CXX:-c++} -E "$folder/probe.cpp" >/dev/null 2>&1; then
    ${CXX:-c++} -std=c++17 "$here/tinyexr_check.cpp" -o "$folder/tinyexr_check" -ltinyexr &&
        "$folder/tinyexr_check" "$folder"/*.exr
    judge tinyexr $?
else
    judge tinyexr 77
fi

[ $failed -eq 0 ] || exit 1
[ $run -gt 0 ] || exit 77

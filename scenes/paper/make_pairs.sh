#!/bin/sh
# The metameric pairs of figures 2 and 3, made by our own tool: make_pairs.sh [SPECTRAD]
# Columns `original` and `metamerN` of pairs/*.csv; the scenes say which N.
set -e
spectrad=${1:-build/spectrad}
folder=$(dirname "$0")/pairs
mkdir -p "$folder"
# Figure 2: alike under D65, apart under A and a tri-phosphor fluorescent lamp.
for patch in blue-sky light-skin neutral-6.5 orange-yellow; do
    "$spectrad" metamer "charts/colorchecker/$patch" --differ illuminants/A --differ lamps/f32t8-tl841-triphosphor \
        --count 8 --smoothness 3 -o "$folder/lamp-$patch.csv"
done
# Figure 3: alike to CIE 1931 under D65, apart to the camera and the film there.
for patch in bluish-green foliage neutral-6.5 yellow-green; do
    "$spectrad" metamer "charts/colorchecker/$patch" --differ illuminants/D65,cameras/dcs200-like \
        --differ illuminants/D65,films/generic-reversal-layers --count 8 --smoothness 3 -o "$folder/observer-$patch.csv"
done

#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# make_path_traced.sh NORTHLIGHT FOLDER [SAMPLES]: the references of tests/numerics/path_traced, FOLDER/NAME.exr.
# Without SAMPLES a few show that it works; KAAMOS_FULL=1 takes 4,096, which needs hours.
set -eu
northlight=$1
folder=$2
samples=${3:-2}
[ "${KAAMOS_FULL:-0}" = 1 ] && samples=${3:-4096}
mkdir -p "$folder"
for scene in lounge mirror-hall glass-stack sealed-cells thin-dome runner; do
  moment=()
  # Its eighth frame, at 30 frames a second.
  [ $scene = runner ] && moment=(--time 0.233333333)
  "$northlight" --scene $scene --size 320x180 --half --reference-path-traced "$samples" \
    "${moment[@]}" --out "$folder/$scene" | grep '^radiance' | sed "s/radiance/$scene/"
  cp "$folder/$scene/reference.exr" "$folder/$scene.exr"
done

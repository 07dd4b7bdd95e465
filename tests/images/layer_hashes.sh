#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# layer_hashes.sh NORTHLIGHT HASHES [BACKEND...]: renders five scenes with every effect on each backend and
# prints a hash of every EXR layer. Run it before and after a change that must not change a picture, on one
# machine, and compare the two lists with diff. HASHES is the program kaamos-layer-hashes.
set -euo pipefail
northlight=$1
hashes=$2
shift 2
(($#)) || set -- embree vulkan
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# render NAME ARGUMENTS...: the frame at a size that a software driver renders in seconds.
render() {
  local name=$1 backend=$2
  shift 2
  "$northlight" --backend "$backend" --effects all --size 64x36 --gi-cell 1 --gi-bake-samples 4 --seed 7 \
    --layers all "$@" --out "$folder/$name" >"$folder/log" 2>&1 || { cat "$folder/log" >&2; exit 1; }
  find "$folder/$name" -name '*.exr' | sort | while read -r file; do
    "$hashes" "$file" | sed "s|\$| $backend $name ${file#"$folder/$name/"}|"
  done
}

for backend in "$@"; do
  render lounge "$backend" --scene lounge
  render lounge-half "$backend" --scene lounge --half-resolution all --sort-rays origin --denoise temporal
  render runner "$backend" --scene runner --frames 2 --taa
  render glass-stack "$backend" --scene glass-stack --glass-layers 3
  render mirror-hall "$backend" --scene mirror-hall --denoise bilateral
  render oracle-box "$backend" --scene oracle-box --gi-mode hit-black --denoise none
done

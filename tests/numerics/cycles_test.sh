#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# cycles_test.sh NORTHLIGHT COMPARE SCENE [FOLDER]: the path-traced reference of a built-in scene
# against Blender's Cycles, for paths of 0, 1 and any number of bounces. Prints a line for each.
# FOLDER keeps the pictures. KAAMOS_FULL=1: more samples.
# Exits with 77 where there is no Blender 3.4 with what its glTF importer needs.
set -u
northlight=$1
compare=$2
scene=$3
here=$(cd "$(dirname "$0")" && pwd)
size=160x90 ours=64 cycles=64
[ "${KAAMOS_FULL:-0}" = 1 ] && ours=512 cycles=256

bash "$here/cycles_available.sh" || exit $?
if [ $# -gt 3 ]; then
  work=$4
  mkdir -p "$work"
else
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
fi
failures=0

# Runs a command that is silent unless it fails.
quietly() {
  "$@" > "$work/log" 2>&1 && return
  cat "$work/log"
  echo "FAILED: $*"
  exit 1
}

quietly "$northlight" --scene "$scene" --size $size --effects ao --ao-samples 1 \
  --write-glb "$work/scene.glb" --out "$work/frame"
quietly blender -b --factory-startup --python-exit-code 1 --python "$here/cycles_render.py" -- \
  "$work/scene.glb" "$work" --size $size --samples $cycles
echo "$scene, $size, samples: reference 2 x $ours, Cycles 2 x $cycles"
for bounces in 0 1 all; do
  limit=(--bounces "$bounces")
  [ $bounces = all ] && limit=()
  for seed in 1 2; do
    # From the same file, so that it holds all that matters.
    quietly "$northlight" --scene "$work/scene.glb" --size $size --reference-path-traced $ours \
      --seed $seed "${limit[@]}" --out "$work/reference_${bounces}_$seed"
  done
  line=$("$compare" "$work/reference_${bounces}_1/reference.exr" \
    "$work/reference_${bounces}_2/reference.exr" "$work/${bounces}_1.exr" "$work/${bounces}_2.exr" \
    "$work/frame/frame.exr" 0.002 "$work/difference_$bounces.png")
  status=$?
  echo "bounces $bounces: $line"
  [ $status = 0 ] || failures=$((failures + 1))
done
[ $failures = 0 ] || echo "FAILED: $failures of 3 differ by more than their noise"
[ $failures = 0 ]

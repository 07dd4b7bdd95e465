#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# ten_minutes_test.sh CMAKE BUILD SOURCE WORK: runs every command block of examples/d3d12/TEN_MINUTES.md, but those
# by hand, against an installed package, and finds in the output what the page says of it.
set -euo pipefail
cmake=$1 build=$2 source=$3 work=$4
page=$source/examples/d3d12/TEN_MINUTES.md
source "$(dirname "${BASH_SOURCE[0]}")/page.sh"
if ! command -v clang++ > /dev/null; then
  echo "clang is not installed (apt install clang)"
  exit 77
fi
rm -rf "$work"
mkdir -p "$work"
trap 'rm -rf "$work"' EXIT
"$cmake" --install "$build" --prefix "$work/sdk" > /dev/null
export KAAMOS_SDK=$work/sdk KAAMOS_SOURCE=$source

# A backend that is not there, and a debugger, are left out.
blocks_of_page > "$work/blocks.sh"
[[ ${KAAMOS_REQUIRE_VULKAN:-} == 1 ]] || sed -i '/KAAMOS_BACKEND=vulkan/d' "$work/blocks.sh"
command -v gdb > /dev/null || sed -i '/^gdb /,/[^\\]$/d' "$work/blocks.sh"
cd "$work"
if ! bash -euo pipefail blocks.sh > output.txt 2>&1; then
  cat output.txt
  exit 1
fi

while IFS= read -r line; do expect "message of the broken record" "$line"; done \
  < <(shown_by_page)
pictures=(triangle.ppm)
[[ ${KAAMOS_REQUIRE_VULKAN:-} == 1 ]] && pictures+=(vulkan.ppm)
for picture in "${pictures[@]}"; do
  [[ -s my-program/$picture ]] || { echo "the program wrote no $picture"; exit 1; }
done
[[ -s my-program/build/triangle.cso ]] || { echo "no shader object beside the program"; exit 1; }
if command -v gdb > /dev/null; then
  expect "stop in the shader" "triangle.hlsl:39"
  expect "value of the barycentrics" "\$1 = {e = {0."
  expect "call stack" "RayGen"
fi

#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# shader_tests_page_test.sh CMAKE BUILD SOURCE WORK: runs every command block of
# examples/shader-tests/TEN_MINUTES.md against an installed package, and finds in the output what the page shows.
set -euo pipefail
cmake=$1 build=$2 source=$3 work=$4
page=$source/examples/shader-tests/TEN_MINUTES.md
source "$(dirname "${BASH_SOURCE[0]}")/page.sh"
rm -rf "$work"
mkdir -p "$work"
trap 'rm -rf "$work"' EXIT
"$cmake" --install "$build" --prefix "$work/sdk" > /dev/null
export KAAMOS_SDK=$work/sdk PATH=$work/sdk/bin:$PATH

# A backend that is not there is left out.
blocks_of_page > "$work/blocks.sh"
[[ ${KAAMOS_REQUIRE_VULKAN:-} == 1 ]] || sed -i 's/embree,vulkan/embree/' "$work/blocks.sh"
cd "$work"
if ! bash -euo pipefail blocks.sh > output.txt 2>&1; then
  cat output.txt
  exit 1
fi
while IFS= read -r line; do expect "line of the page" "$line"; done < <(shown_by_page)
[[ -s my-shaders/shadow.xml ]] || { echo "no shadow.xml was written"; exit 1; }

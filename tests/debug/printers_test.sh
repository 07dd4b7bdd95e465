#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# printers_test.sh GDB PROGRAM PRINTERS: gdb prints shader values the way HLSL writes them.
set -u
gdb=$1
program=$2
printers=$3

if ! command -v "$gdb" > /dev/null; then
  echo "gdb is not installed (apt install gdb)"
  exit 77
fi
if [ "$("$gdb" -nx -batch -ex 'python print(6 * 7)' 2>&1)" != 42 ]; then
  echo "this gdb has no Python"
  exit 77
fi
commands=()
for name in color pixel matrix list payload hlsl_ray ray view none record linked; do
  commands+=(-ex "print $name")
done
output=$(DEBUGINFOD_URLS='' "$gdb" -nx -batch -ex "source $printers" -ex 'break Stop' -ex run -ex up \
  "${commands[@]}" -ex 'kaamos-record bytes' --args "$program" 2>&1)

failed=0
expect() {
  if ! grep -Fq -- "$1" <<< "$output"; then
    echo "MISSING: $1"
    failed=1
  fi
}
expect ' = float3(1, 2.5, -3)'
expect ' = uint2(812, 440)'
expect ' = float2x3((1, 2, 3), (4, 5, 6))'
expect ' = {int2(1, 2), int2(3, 4)}'
expect ' = Payload = {color = float3(1, 2.5, -3), leaves = 2}'
expect ' = RayDesc origin (0, 1, 2), direction (0, 0, 1), t 0 to 100'
expect ' = RayDesc origin (0, 1, 2), direction (0, 0, 1), t 0.5 to 100'
expect ' = SRV structured buffer, stride 16, at 0x1000, 416 bytes'
expect ' = null descriptor'
expect 'hit group record at 0x'
expect ': any-hit "AlphaTest"'
expect ' = miss "Sky": "Sky", 8 bytes of local arguments'
expect 'identifier 00000000 00000000 00000000 00000000 00000000 00000000 00000000 00000000 (NULL: nothing runs)'
if [ "$failed" != 0 ]; then
  echo "--- gdb said:"
  echo "$output"
fi
exit "$failed"

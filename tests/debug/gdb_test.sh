#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# gdb_test.sh GDB PROGRAM SHADER [PRINTERS]: gdb stops at a breakpoint in an .hlsl file, in code
# called by an any-hit shader, and shows the shader's variables and the whole stack down to the ray
# generation shader.
set -u
gdb=$1
program=$2
shader=$3
printers=${4:-}

if ! command -v "$gdb" > /dev/null; then
  echo "gdb is not installed (apt install gdb)"
  exit 77
fi
line=$(grep -n 'BREAK HERE' "$shader" | cut -d: -f1)
caller=$(grep -n 'CALLED FROM HERE' "$shader" | cut -d: -f1)
name=$(basename "$shader")

output=$(DEBUGINFOD_URLS='' "$gdb" -nx -batch \
  -ex 'set breakpoint pending on' \
  -ex 'handle SIGSEGV nostop noprint pass' \
  -ex "break $name:$line" \
  -ex run -ex backtrace -ex 'info locals' -ex 'print payload' \
  ${printers:+-ex "source $printers" -ex 'print payload' -ex 'print payload.seen'} \
  --args "$program" "$shader" 2>&1)

failed=0
expect() {
  if ! grep -Eq "$1" <<< "$output"; then
    echo "MISSING: $2 (pattern: $1)"
    failed=1
  fi
}
expect "Attenuate .*$name:$line" "the stop in the function of the breakpoint, at its line"
expect "^#[0-9]+ .*ProbeAnyHit.*$name" "the any-hit shader on the stack"
expect "^#[0-9]+ .*ProbeRayGen.*$name:$caller" "the ray generation shader on the stack, at its TraceRay"
expect "transmittance = 1" "the payload's value"
expect "thickness = 1\.25" "a local variable's value"
expect "where = \{e = \{0\.2" "the value of a variable that is not used any more"
if [ -n "$printers" ]; then
  expect " = Payload = \{transmittance = 1, layers = 0, " "the payload by its HLSL name"
  # Embree's reciprocal is inexact on some CPUs.
  expect " = float2\(0\.2(5|49999985), 0\.2(5|49999985)\)" "a vector as HLSL writes it"
fi
if [ "$failed" != 0 ]; then
  echo "--- gdb said:"
  echo "$output"
fi
exit "$failed"

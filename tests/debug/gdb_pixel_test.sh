#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# gdb_pixel_test.sh GDB PROGRAM SHADER: gdb stops at one pixel of a draw, in a function that a pixel
# shader with derivatives calls, and shows its variables and the pixel shader on the stack.
set -u
gdb=$1
program=$2
shader=$3

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
  -ex "break $name:$line if x == 2 && y == 1" \
  -ex run -ex backtrace -ex 'info args' -ex 'info locals' -ex 'print x' -ex 'print y' \
  -ex delete -ex continue \
  --args "$program" "$shader" 2>&1)

failed=0
expect() {
  if ! grep -Eq "$1" <<< "$output"; then
    echo "MISSING: $2 (pattern: $1)"
    failed=1
  fi
}
expect "Shade .*$name:$line" "the stop in the function of the breakpoint, at its line"
expect "^#[0-9]+ .*ProbePixel.*$name:$caller" "the pixel shader on the stack, at its call"
expect "shade = 13" "a local variable, with a derivative in it"
expect "^\\\$1 = 2" "the pixel's x"
expect "^\\\$2 = 1" "the pixel's y"
expect "^6.5" "the picture, after the program went on"
if [ "$failed" != 0 ]; then
  echo "--- gdb said:"
  echo "$output"
fi
exit "$failed"

#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# gdb_break_test.sh GDB PROGRAM SHADER: gdb stops at DebugBreak of an .hlsl file, and goes on;
# without gdb the program runs through.
set -u
gdb=$1
program=$2
shader=$3

if ! command -v "$gdb" > /dev/null; then
  echo "gdb is not installed (apt install gdb)"
  exit 77
fi
line=$(grep -n 'BREAK HERE' "$shader" | cut -d: -f1)
name=$(basename "$shader")

output=$(DEBUGINFOD_URLS='' "$gdb" -nx -batch \
  -ex 'handle SIGSEGV nostop noprint pass' \
  -ex run -ex backtrace -ex continue --args "$program" "$shader" lib_6_10 2>&1)
alone=$("$program" "$shader" lib_6_10 2>&1)

failed=0
expect() {
  if ! grep -Eq "$1" <<< "$3"; then
    echo "MISSING: $2 (pattern: $1)"
    failed=1
  fi
}
expect "SIGTRAP" "the stop" "$output"
expect "^#0 .*Count.*$name:$line" "the line of DebugBreak" "$output"
expect "^#[0-9]+ .*ProbeAnyHit.*$name" "the any-hit shader on the stack" "$output"
expect "^1 after 2 layers" "the result, with IsDebuggingEnabled, when the program goes on" "$output"
expect "^0\.5 after 2 layers" "the result without gdb" "$alone"
if [ "$failed" != 0 ]; then
  echo "--- gdb said:"
  echo "$output"
  echo "--- without gdb:"
  echo "$alone"
fi
exit "$failed"

#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# gdb_test.sh CMAKE BUILD WORK GDB PROGRAM PRINTERS_TEST: the installed package has gdb's printers
# where runtime/shader/gdb/README.md says, gdb loads them with that one command, and they print values
# the way HLSL writes them.
set -eu
cmake=$1
build=$2
work=$3
gdb=$4
program=$5
printers_test=$6

# A path with a blank, as users have them, and nothing else of the source tree beside it.
prefix="$work/installed elsewhere"
rm -rf "$work"
trap 'rm -rf "$work"' EXIT
"$cmake" --install "$build" --prefix "$prefix" > /dev/null
printers="$prefix/share/kaamos/gdb/kaamos_gdb.py"
if [[ ! -f $printers ]]; then
  echo "the package has no $printers; it has:"
  find "$prefix" -name '*gdb*'
  exit 1
fi
if ! command -v "$gdb" > /dev/null; then
  echo "gdb is not installed (apt install gdb)"
  exit 77
fi
if [[ $("$gdb" -nx -batch -ex 'python print(6 * 7)' 2>&1) != 42 ]]; then
  echo "this gdb has no Python"
  exit 77
fi
loaded=$("$gdb" -nx -batch -ex "source $printers" -ex 'info pretty-printer' 2>&1)
if ! grep -Eq '^  kaamos' <<< "$loaded"; then
  echo "gdb has no printer of that name after \"source $printers\":"
  echo "$loaded"
  exit 1
fi
# Everything that would make it skip itself has been checked above.
bash "$printers_test" "$gdb" "$program" "$printers"

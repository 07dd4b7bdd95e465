#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# cpu_levels_test.sh NORTHLIGHT AVX2_OBJECT...: shader libraries for AVX2 give the same bits as
# those for any x86-64, $KAAMOS_CPU_LEVEL chooses between them, and none of their functions can end
# up in code that runs on every processor.
set -u
northlight=$1
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

# The linker keeps one of several weak definitions, from whichever object.
for object in "$@"; do
  weak=$(nm --defined-only "$object" | grep -E ' [VvWwu] ') &&
    fail "$object has definitions that others may be replaced by: $weak"
done

render() {
  KAAMOS_CPU_LEVEL=$1 "$northlight" --effects all --size 48x27 --gi-cell 2 --gi-bake-samples 4 \
    --frames 2 --camera-path dolly --layers all --out "$work/out-$1" > "$work/log-$1" 2>&1 ||
    fail "the whole frame at level \"$1\": $(cat "$work/log-$1")"
}

render fastest
grep -q 'KAAMOS_CPU_LEVEL is "fastest", which is no level; .*Set it to sse2 or avx2' "$work/log-fastest" ||
  fail "an unknown level is not reported: $(cat "$work/log-fastest")"
render sse2
render avx2
if grep -q '^flags.* avx2' /proc/cpuinfo; then
  grep -q KAAMOS_CPU_LEVEL "$work/log-avx2" && fail "a level that there is: $(cat "$work/log-avx2")"
else
  grep -q 'which this processor cannot run' "$work/log-avx2" ||
    fail "a level that this processor lacks is not reported: $(cat "$work/log-avx2")"
fi
for file in frame_0000.png frame_0001.png frame.exr; do
  cmp "$work/out-sse2/$file" "$work/out-avx2/$file" || fail "$file differs between the levels"
done

exit $((failures != 0))

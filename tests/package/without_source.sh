#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# without_source.sh SOURCE BUILD PREFIX PROGRAMS WORK: programs of the package in PREFIX, and those that were built
# against it in PROGRAMS, compile shaders at run time to native code where there is no source tree. SOURCE and BUILD
# are where the package was made.
#
# The source tree is hidden from this process below empty folders, in a mount namespace of its own. Where the system
# allows none, nothing is hidden, and the programs' bytes are searched for its path all the same.
set -euo pipefail
if [[ ${KAAMOS_HIDDEN:-} != 1 ]]; then
  for namespace in "--mount" "--mount --map-root-user"; do
    # shellcheck disable=SC2086
    if unshare $namespace true 2> /dev/null; then
      KAAMOS_HIDDEN=1 exec unshare $namespace bash "$0" "$@"
    fi
  done
  echo "the source tree is not hidden: this system allows no mount namespaces (unshare --mount)"
fi
source=$1 build=$2 prefix=$3 programs=$4 work=$5
rm -rf "$work"
mkdir -p "$work/empty"
cp "$source/tests/package/consumer/squares.hlsl" "$work"
if [[ ${KAAMOS_HIDDEN:-} == 1 ]]; then
  for folder in "$source"/*/; do
    [[ $build/ == "$folder"* ]] || mount --bind "$work/empty" "$folder"
  done
  if [[ -e $source/runtime/shader ]]; then
    echo "$source/runtime/shader is still there"
    exit 1
  fi
fi
export KAAMOS_CACHE_DIR=$work/cache
unset KAAMOS_SHADER_INCLUDE KAAMOS_EFFECTS KAAMOS_D3D12_MESSAGES

fail() {
  echo "$*"
  exit 1
}

# compiles PROGRAM ARGUMENTS...: the program ends well, has shaders compiled and interprets none.
compiles() {
  rm -rf "$KAAMOS_CACHE_DIR"
  "$@" > "$work/output.txt" 2>&1 || fail "$* ends with $?: $(cat "$work/output.txt")"
  if grep -q 'interpreted' "$work/output.txt"; then fail "$* says: $(cat "$work/output.txt")"; fi
  [[ -n $(find "$KAAMOS_CACHE_DIR" -name '*.so') ]] || fail "$* compiled nothing: $(cat "$work/output.txt")"
}

# names_no_source PROGRAM: it does not hold the path of the headers' source folder.
names_no_source() {
  strip --strip-debug -o "$work/stripped" "$1"
  if grep -qF "$source/runtime/shader/include" "$work/stripped"; then fail "$1 names $source/runtime/shader/include"; fi
}

cd "$work"
for program in "$prefix/bin/kaamos-hlsl" "$programs/consumer" "$programs/consumer-d3d12" "$prefix/bin/northlight"; do
  [[ -e $program ]] && names_no_source "$program"
done
compiles "$prefix/bin/kaamos-hlsl" -emit object -Fo squares.so squares.hlsl
[[ -s squares.so ]] || fail "kaamos-hlsl wrote no squares.so"
compiles "$programs/consumer"
[[ ! -e $programs/consumer-d3d12 ]] || compiles "$programs/consumer-d3d12"
[[ -e $prefix/bin/northlight ]] || exit 0
compiles "$prefix/bin/northlight" --checked --effects ao --size 32x18 --out checked

# --watch finds the installed shaders.
"$prefix/bin/northlight" --watch --effects ao --size 32x18 --out watched > watched.txt 2>&1 &
watcher=$!
for ((tenths = 0; tenths < 1200; ++tenths)); do
  grep -qs '^wrote ' watched.txt && break
  kill -0 $watcher 2> /dev/null || fail "northlight --watch ends: $(cat watched.txt)"
  sleep 0.1
done
kill -INT $watcher
wait $watcher || fail "northlight --watch ends with $? after Ctrl-C: $(cat watched.txt)"
grep -q '^wrote ' watched.txt || fail "northlight --watch shows no picture: $(cat watched.txt)"
grep -qF "watching $prefix/include/kaamos/effects" watched.txt || fail "northlight --watch looks elsewhere: $(cat watched.txt)"

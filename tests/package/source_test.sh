#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# source_test.sh SOURCE BUILD WORK VERSION: the source release is the same each time and knows its commit; without a
# build, scripts/package says that there is nothing to make Debian packages of.
set -euo pipefail
source=$1 build=$2 work=$3 version=$4
for tool in dpkg-shlibdeps git xz; do
  command -v $tool >/dev/null || { echo "$tool is not installed (apt install dpkg-dev git xz-utils)"; exit 77; }
done
if [[ ! -e $source/.git || $build != "$source/build/release" ]]; then
  echo "scripts/package makes packages of a clone's build/release"
  exit 77
fi
rm -rf "$work"
mkdir -p "$work/bin"
trap 'rm -rf "$work"' EXIT

fail() {
  echo "$*"
  exit 1
}

# Compressed as little as possible, in a tenth of the time.
printf '#!/bin/sh\nexec "%s" -0 -T1\n' "$(command -v xz)" >"$work/bin/xz"
chmod +x "$work/bin/xz"

# package ARGUMENTS...: scripts/package, whose output is shown if it fails.
package() {
  PATH=$work/bin:$PATH "$source/scripts/package" --no-build --no-install "$@" >"$work/output.txt" 2>&1 ||
    fail "scripts/package $*: $(<"$work/output.txt")"
}

package --source --out "$work/first"
package --source --out "$work/second"
tar=kaamos-$version.tar.xz
cmp "$work/first/$tar" "$work/second/$tar" || fail "two source releases of one commit differ"
commit=$(tar -xJOf "$work/first/$tar" "kaamos-$version/cmake/commit.txt")
[[ $commit == "$(git -C "$source" rev-parse HEAD)" ]] || fail "the source release says that its commit is \"$commit\""

# Without a build there is nothing to package, which is said.
mkdir -p "$work/bare"
cp -r "$source/scripts" "$work/bare/"
mkdir -p "$work/bare/rtapi/include/rtapi"
cp "$source/rtapi/include/rtapi/version.h" "$work/bare/rtapi/include/rtapi/"
if "$work/bare/scripts/package" --debian --no-build --out "$work/none" >"$work/output.txt" 2>&1 ||
  ! grep -q 'holds no build' "$work/output.txt"; then
  fail "without a build scripts/package says: $(<"$work/output.txt")"
fi

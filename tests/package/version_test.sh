#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# version_test.sh VERSION SOURCE BUILD PROGRAM...: the package's version, the headers, the newest entry of
# CHANGELOG.md and each program's --version agree with VERSION, CMake's PROJECT_VERSION.
set -uo pipefail
version=$1 source=$2 build=$3
shift 3
failed=0

# expect WHERE ACTUAL WANTED
expect() {
  [[ $2 == "$3" ]] && return
  echo "$1: \"$2\" instead of \"$3\""
  failed=1
}

[[ $version =~ ^[0-9]+\.[0-9]+\.[0-9]+$ ]] || expect "PROJECT_VERSION" "$version" "three numbers"
header=$source/rtapi/include/rtapi/version.h
numbers=$(sed -nE 's/.* kVersion(Major|Minor|Patch) = ([0-9]+);.*/\2/p' "$header" | paste -sd .)
expect "$header" "$numbers" "$version"
package=$build/kaamosConfigVersion.cmake
expect "$package" "$(sed -nE 's/^set\(PACKAGE_VERSION "(.*)"\)$/\1/p' "$package" | head -n 1)" "$version"
changes=$source/CHANGELOG.md
newest=$(sed -nE 's/^## ([^ ,]+).*/\1/p' "$changes" | head -n 1)
expect "$changes, newest entry" "$newest" "$version"
for program in "$@"; do
  said=$("$program" --version </dev/null) || expect "$program --version, exit status" "$?" 0
  expect "$program --version" "$said" "$(basename "$program") $version"
done
((!failed)) && echo "all of them: $version"
exit "$failed"

#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# format_sources.sh ROOT CLANG_FORMAT [options]: runs clang-format on every C++ source below ROOT. Shaders
# are left alone: clang-format reads HLSL attributes and semantics as C++ and breaks those lines badly.
# Versions of clang-format disagree on some lines, so only the one that .clang-format names runs; any
# other gives exit status 77, which ctest counts as skipped.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)
cd "$1"
clang_format=$2
shift 2

wanted=$(sed -n 's/^# clang-format \([0-9]*\)$/\1/p' "$here/../.clang-format")
version=$("$clang_format" --version 2>/dev/null | sed -nE 's/.*clang-format version ([0-9]+).*/\1/p') || true
if [[ $version != "$wanted" ]]; then
  echo "the sources are formatted by clang-format $wanted, and there is ${version:-none} here"
  exit 77
fi
mapfile -d '' files < <(find . \( -name build -o -name out -o -name .git -o -name .cache \
  -o -name testdata \) -prune -o -type f \( -name '*.cpp' -o -name '*.h' \) -printf '%P\0')
printf '%d files\n' "${#files[@]}"
"$clang_format" "$@" "${files[@]}"

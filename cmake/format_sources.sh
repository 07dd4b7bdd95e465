#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# format_sources.sh CLANG_FORMAT [options]: runs it on every C++ source. Shaders are left alone:
# clang-format reads HLSL attributes and semantics as C++ and breaks those lines badly.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
mapfile -d '' files < <(find rtapi runtime effects examples tests \
  -name testdata -prune -o -type f \( -name '*.cpp' -o -name '*.h' \) -print0)
printf '%d files\n' "${#files[@]}"
"$@" "${files[@]}"

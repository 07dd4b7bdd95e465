#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# shared_test.sh CMAKE BUILD WORK CXX SOVERSION: the installed shared libraries have sonames, show their API and nothing
# else, and a program finds D3D12, DXGI and dxcompiler under their usual names.
set -euo pipefail
cmake=$1 build=$2 work=$3 cxx=$4 soversion=$5
rm -rf "$work"
mkdir -p "$work"
trap 'rm -rf "$work"' EXIT
# Moved, because a library may not know where it was made.
"$cmake" --install "$build" --prefix "$work/first" >/dev/null
mv "$work/first" "$work/sdk"
lib=$work/sdk/lib
if [[ ! -d $lib/kaamos/d3d12 ]]; then lib=$(dirname "$(find "$work/sdk" -name 'libkaamos.so')"); fi

fail() {
  echo "$*"
  exit 1
}

# shows LIBRARY PATTERN SOME: each symbol that it defines matches the pattern; SOME are among them.
shows() {
  local library=$1 pattern=$2 name others
  shift 2
  soname=$(readelf -d "$lib/$library" | sed -n 's/.*(SONAME).*\[\(.*\)\]/\1/p')
  [[ $soname == "$library.$soversion" ]] || fail "$library has the soname \"$soname\""
  nm -D --defined-only "$lib/$library" | cut -d' ' -f3- | c++filt >"$work/symbols.txt"
  others=$(grep -vE "$pattern" "$work/symbols.txt" || true)
  [[ -z $others ]] || fail "$library shows what is not of its API:"$'\n'"$others"
  for name; do grep -qF -- "$name" "$work/symbols.txt" || fail "$library does not show $name"; done
}
shows libkaamos.so '^rtapi::' 'rtapi::CreateDevice(' 'rtapi::CompileShaderLibrary('
shows libkaamos-d3d12.so '^([A-Z][A-Za-z0-9_]*|kaamos_[a-z_0-9]*)$' D3D12CreateDevice DxcCreateInstance kaamos_on_present

"$cxx" -std=c++20 "$(dirname "${BASH_SOURCE[0]}")/loads_d3d12.cpp" -o "$work/loads_d3d12" -ldl
said=$(LD_LIBRARY_PATH=$lib/kaamos/d3d12 "$work/loads_d3d12" 2>&1) || fail "loads_d3d12: $said"
[[ $said == "a factory, a device and a compiler" ]] || fail "loads_d3d12 says \"$said\""

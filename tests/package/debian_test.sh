#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# debian_test.sh SOURCE BUILD WORK VERSION CXX: the Debian packages of this build have what they should, and work where
# they are unpacked.
set -euo pipefail
source=$1 build=$2 work=$3 version=$4 cxx=$5
for tool in dpkg-shlibdeps xz; do
  command -v $tool >/dev/null || { echo "$tool is not installed (apt install dpkg-dev xz-utils)"; exit 77; }
done
if [[ ! -e $source/.git || $build != "$source/build/release" ]]; then
  echo "scripts/package makes packages of a clone's build/release"
  exit 77
fi
rm -rf "$work"
mkdir -p "$work"
trap 'rm -rf "$work"' EXIT

fail() {
  echo "$*"
  exit 1
}

# package ARGUMENTS...: scripts/package, whose output is shown if it fails.
package() {
  "$source/scripts/package" --no-build --no-install "$@" >"$work/output.txt" 2>&1 || fail "scripts/package $*: $(<"$work/output.txt")"
}

export DEBFULLNAME="A Packager" DEBEMAIL=packager@debian.org
package --debian --uncompressed --out "$work/debs"
soversion=${version%.*}
wanted=(kaamos-d3d12 kaamos-doc kaamos-tools "libkaamos$soversion" "libkaamos-d3d12-$soversion" libkaamos-dev)
[[ ! -e $build/python/kaamos/__init__.py ]] || wanted+=(python3-kaamos)
declare -A depends=()
for name in "${wanted[@]}"; do
  deb=$(compgen -G "$work/debs/${name}_$version-1_*.deb") || fail "there is no package $name: $(ls "$work/debs")"
  depends[$name]=$(dpkg-deb -f "$deb" Depends)
  [[ $(dpkg-deb -f "$deb" Maintainer) == "A Packager <packager@debian.org>" ]] || fail "$name has another maintainer"
  dpkg-deb -x "$deb" "$work/root"
  for file in copyright changelog.gz; do
    [[ -s $work/root/usr/share/doc/$name/$file ]] || fail "$name has no $file"
  done
done
[[ $(ls "$work/debs" | wc -l) == "${#wanted[@]}" ]] || fail "more than was wanted: $(ls "$work/debs")"

# What is linked is found by dpkg-shlibdeps; packages of one build belong together.
[[ ${depends[libkaamos$soversion]} == *libembree*libtbb* ]] || fail "the library depends on ${depends[libkaamos$soversion]}"
[[ ${depends[libkaamos-d3d12-$soversion]} == *"libkaamos$soversion (= $version-1)"* ]] ||
  fail "the D3D12 library depends on ${depends[libkaamos-d3d12-$soversion]}"
[[ ${depends[libkaamos-dev]} == *"kaamos-tools (= $version-1)"* ]] || fail "libkaamos-dev depends on ${depends[libkaamos-dev]}"
unnamed=$(sed -n 's/^find_dependency(\([A-Za-z_]*\).*/\L\1/p' "$work/root/usr/lib/cmake/kaamos/kaamosConfig.cmake" |
  sed 's/^threads$/tbb/; s/^nlohmann_json$/nlohmann-json/' |
  while read -r name; do grep -qi "lib$name\|$name" <<<"${depends[libkaamos-dev]}" || echo "$name"; done)
[[ -z $unnamed ]] || fail "libkaamos-dev depends on no package of $unnamed, which kaamosConfig.cmake wants"

# Programs, libraries and the Python package, from there.
usr=$work/root/usr
for program in "$usr"/bin/*; do
  page=$usr/share/man/man1/${program##*/}.1.gz
  [[ -s $page ]] || fail "${program##*/} has no manual page"
  command -v man >/dev/null || continue
  said=$(LC_ALL=C.UTF-8 MANROFFSEQ='' MANWIDTH=120 man --warnings -l "$page" 2>&1 >"$work/page.txt") || fail "man: $said"
  [[ -z $said ]] || fail "man has something to say about ${program##*/}.1: $said"
  "$program" --help >"$work/help.txt"
  while read -r word; do
    grep -qF -e "$word" "$work/page.txt" || fail "the page of ${program##*/} lacks $word"
  done < <(grep -oE -e '(^|[ ,])-[-A-Za-z0-9]+' "$work/help.txt" | tr -d ' ,' | sort -u)
done
env -u KAAMOS_REQUIRE_VULKAN VK_LOADER_DRIVERS_DISABLE='*' "$usr/bin/kaamos-verify" >"$work/output.txt" || fail "kaamos-verify: $(<"$work/output.txt")"
"$cxx" -std=c++20 "$source/tests/package/loads_d3d12.cpp" -o "$work/loads_d3d12" -ldl
LD_LIBRARY_PATH=$usr/lib/kaamos/d3d12:$usr/lib "$work/loads_d3d12" >"$work/output.txt" || fail "loads_d3d12: $(<"$work/output.txt")"
if [[ -e $usr/lib/python3 ]] && /usr/bin/python3 -c 'import numpy' 2>/dev/null; then
  said=$(PYTHONPATH=$usr/lib/python3/dist-packages /usr/bin/python3 -c '
import kaamos
print(kaamos.__file__, kaamos.call("f", "float f(float x) { return x * x; }", [3, 4]).tolist())')
  [[ $said == "$usr/"*" [9.0, 16.0]" ]] || fail "Python says $said"
fi

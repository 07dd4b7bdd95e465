#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# debootstrap_test.sh SOURCE WORK VERSION [DEBS]: makes the Debian packages of the build, lets lintian look at them, installs
# them into a new Debian of this system's release, and uses them there: kaamos-verify, Python, and the project of
# tests/package/consumer. Takes a network. With DEBS, those packages are installed and none are made.
set -euo pipefail
source=$1 work=$2 version=$3 debs=${4:-}
source "$(dirname "${BASH_SOURCE[0]}")/new_debian.sh"

if [[ -z $debs ]]; then
  make_packages
  lintian --fail-on error --tag-display-limit 0 "$debs"/*.deb
fi
make_root
cp -r "$debs" "$root/debs"
cp -r "$source/tests/package/consumer" "$root/consumer"
install() { inside apt-get install -y -q --no-install-recommends "$@" >"$work/apt.txt" 2>&1 || { tail -n 20 "$work/apt.txt"; exit 1; }; }
inside apt-get update -q >"$work/apt.txt" 2>&1 || { cat "$work/apt.txt"; exit 1; }

# Programs, the libraries and Python; no compiler is there, so shaders are interpreted.
mapfile -t packages < <(cd "$root" && ls debs/*.deb | grep -v -- -dev_ | sed 's#^#/#')
install "${packages[@]}"
inside kaamos-verify | tee "$work/verify.txt"
grep -q '^  absent  native code' "$work/verify.txt" || { echo "a compiler was found where none is installed"; exit 1; }
if [[ -e $root/usr/lib/python3/dist-packages/kaamos ]]; then
  said=$(inside python3 -c 'import kaamos; print(kaamos.call("f", "float f(float x) { return x * x; }", [3, 4]).tolist())')
  [[ $said == "[9.0, 16.0]" ]] || { echo "Python says $said"; exit 1; }
fi

# A project that is built against the packages.
install "/debs/libkaamos-dev_$version-1_$(dpkg --print-architecture).deb" g++ cmake ninja-build
inside kaamos-verify --require compiler
targets='kaamos::rtapi;kaamos::shared;kaamos::effects;kaamos::d3d12;kaamos::kaamos-hlsl;kaamos::kaamos-dxc'
inside cmake -S /consumer -B /consumer-build -G Ninja -DCMAKE_BUILD_TYPE=Release "-DKAAMOS_EXPECTED=$targets"
inside cmake --build /consumer-build
inside /consumer-build/consumer
inside /consumer-build/consumer-shared
[[ $(inside ldd /consumer-build/consumer-shared) == *"libkaamos.so.${version%.*} => /lib/"* ]] ||
  { echo "consumer-shared does not find the library of the package"; exit 1; }
inside apt-get purge -y -q kaamos-tools "libkaamos${version%.*}" >"$work/apt.txt" 2>&1
left=$(inside sh -c 'ls -d /usr/bin/kaamos-* /usr/lib/*kaamos* /usr/share/kaamos' 2>/dev/null || true)
[[ -z $left ]] || { echo "the packages leave behind: $left"; exit 1; }

#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# wheel_test.sh SOURCE BUILD WORK PYTHON: the wheel is the same each time; pip installs it without a network into a new
# virtual environment, where it renders a picture, with the libraries that it brings.
set -euo pipefail
source=$1 build=$2 work=$3 python=$4
rm -rf "$work"
mkdir -p "$work/first" "$work/second"
trap 'rm -rf "$work"' EXIT
for tool in patchelf objdump; do
  command -v $tool >/dev/null || { echo "$tool is not installed (apt install patchelf binutils)"; exit 77; }
done
"$python" -c "import ensurepip, numpy" 2>/dev/null || { echo "apt install python3-venv python3-numpy"; exit 77; }
fail() {
  echo "$*"
  exit 1
}

cmake --install "$build" --prefix "$work/staged" --component python --strip >/dev/null
for out in first second; do
  "$python" "$source/python/build_wheel.py" "$work/staged/lib/python3/dist-packages/kaamos" 1.2.3 "$source/LICENSE" "$work/$out" >/dev/null
done
wheel=$(basename "$work/first/"*.whl)
[[ $wheel =~ ^kaamos-1[.]2[.]3-cp3[0-9]+-cp3[0-9]+-manylinux_2_[0-9]+_ ]] || fail "the wheel is called $wheel"
cmp "$work/first/$wheel" "$work/second/$wheel" || fail "two wheels of one package differ"

# numpy is the system's. pip takes nothing from elsewhere.
"$python" -m venv --system-site-packages "$work/venv"
"$work/venv/bin/pip" --disable-pip-version-check install --no-index --quiet "$work/first/$wheel"
"$work/venv/bin/pip" check 2>&1 | grep -i kaamos && fail "pip finds it broken"
cd "$work"
env -u PYTHONPATH KAAMOS_CACHE_DIR="$work/cache" "$work/venv/bin/python" "$source/tests/package/wheel_picture.py" "$work/venv" picture.ppm
[[ $(head -c 2 picture.ppm) == P6 ]] || fail "no picture was written"

# A package without its extension module is refused.
rm "$work/staged/lib/python3/dist-packages/kaamos/"*.so
if "$python" "$source/python/build_wheel.py" "$work/staged/lib/python3/dist-packages/kaamos" 1.2.3 "$source/LICENSE" "$work" 2>output.txt ||
  ! grep -q 'has no extension module' output.txt; then
  fail "without an extension module it says: $(<output.txt)"
fi

#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# verify_test.sh VERIFY CXX WORK: what kaamos-verify says and returns on a sound machine, and where a driver or a
# compiler is broken or absent.
set -uo pipefail
verify=$1 cxx=$2 work=$3
rm -rf "$work"
mkdir -p "$work"
trap 'rm -rf "$work"' EXIT
failed=0

# verify STATUS VARIABLE=VALUE...: runs it; its output must have each line of stdin (a regular expression).
verify() {
  local wanted=$1 status=0 line
  shift
  env -u KAAMOS_REQUIRE_VULKAN -u VK_DRIVER_FILES -u VK_ICD_FILENAMES -u KAAMOS_CXX "$@" "$verify" >"$work/output.txt" 2>&1 || status=$?
  if ((status != wanted)); then
    echo "with $*: status $status instead of $wanted"
    failed=1
  fi
  while IFS= read -r line; do
    grep -qE -- "$line" "$work/output.txt" && continue
    echo "with $*: no line \"$line\""
    failed=1
  done
  if ((failed)); then
    cat "$work/output.txt"
    exit 1
  fi
}

# Without a driver, which the loader is told to ignore, Vulkan is absent.
verify 0 VK_LOADER_DRIVERS_DISABLE='*' KAAMOS_CACHE_DIR="$work/cache" <<'END'
^  Kaamos +[0-9.]+, commit 
^  system +.* Linux 
^  extensions +
^  oneTBB +20
^  environment +KAAMOS_CACHE_DIR=
^ +VK_LOADER_DRIVERS_DISABLE=\*
^  pass +embree: device +.*, Embree [34]
^  pass +embree: picture +2[0-9]{3}|3[0-9]{3} of 3072 texels
^  pass +embree: rules +10 of 10 are kept
^  absent +vulkan: device +KA0950
^  pass +interpreter
^  pass +native code +by /
^This copy works
END
[[ ! -e $work/cache ]] || { echo "it compiled into the user's cache"; exit 1; }

# A driver that cannot be loaded, and one that crashes.
echo '{"file_format_version": "1.0.0", "ICD": {"library_path": "/none.so", "api_version": "1.3.0"}}' >"$work/none.json"
verify 1 VK_ICD_FILENAMES="$work/none.json" <<'END'
^  FAIL +vulkan: device +KA0950
VK_ICD_FILENAMES names a driver
^  pass +native code
checks failed
END
echo '#include <cstdlib>
struct Crash { Crash() { std::abort(); } } crash;' >"$work/crash.cpp"
"$cxx" -shared -fPIC "$work/crash.cpp" -o "$work/crash.so" || exit 1
sed "s#/none.so#$work/crash.so#" "$work/none.json" >"$work/crash.json"
verify 1 VK_ICD_FILENAMES="$work/crash.json" <<'END'
^  pass +embree: rules
^  FAIL +vulkan: device +ended by Aborted
^  pass +interpreter
END

# Compilers that are not there or do not work.
verify 1 VK_LOADER_DRIVERS_DISABLE='*' KAAMOS_CXX=no-such-compiler <<'END'
^  shader compiler +none
^  pass +interpreter
^  FAIL +native code +.*no-such-compiler
^1 of 6 checks failed
END
verify 1 VK_LOADER_DRIVERS_DISABLE='*' KAAMOS_CXX=/bin/false <<'END'
^  FAIL +native code +.*/bin/false failed
END

# What is required may not be absent.
verify 1 VK_LOADER_DRIVERS_DISABLE='*' KAAMOS_REQUIRE_VULKAN=1 <<'END'
^    it is required
END

#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# import_vcxproj_test.sh CMAKE BUILD SOURCE WORK: kaamos-import-vcxproj of an installed package makes a CMakeLists.txt of
# the project in vcxproj/, which is built and run against that package.
set -euo pipefail
cmake=$1 build=$2 source=$3 work=$4
if ! command -v clang++ > /dev/null; then
  echo "clang is not installed (apt install clang)"
  exit 77
fi
rm -rf "$work"
mkdir -p "$work"
trap 'rm -rf "$work"' EXIT
"$cmake" --install "$build" --prefix "$work/sdk" > /dev/null
# In a folder of its own, where its output may stand beside it.
cp -r "$source/tests/package/vcxproj" "$work/my project"
project="$work/my project"
import=$work/sdk/bin/kaamos-import-vcxproj

# fails TEXT COMMAND...: the command fails and says the text.
fails() {
  local text=$1
  shift
  if "$@" > "$work/output.txt" 2>&1 || ! grep -qF -- "$text" "$work/output.txt"; then
    echo "\"$*\" should fail with \"$text\", but:"
    cat "$work/output.txt"
    exit 1
  fi
}

"$import" "$project/Imported.vcxproj" 2> "$work/notes.txt"
diff - "$work/notes.txt" << 'END'
not found, left out:
  None src\data\missing.txt
libraries that Kaamos does not have, left out:
  d2d1.lib
END
fails "exists. Write elsewhere with --out FILE" "$import" "$project/Imported.vcxproj"
"$import" "$project/Imported.vcxproj" --force > /dev/null 2>&1
fails "cannot be read" "$import" "$work/none.vcxproj"

"$cmake" -S "$project" -B "$work/build" -G Ninja "-DCMAKE_PREFIX_PATH=$work/sdk" > "$work/log.txt" 2>&1 &&
  "$cmake" --build "$work/build" >> "$work/log.txt" 2>&1 || { cat "$work/log.txt"; exit 1; }
said=$("$work/build/bin/Imported") || { echo "the imported program ends with $?"; exit 1; }
[[ $said == "imported: 42" ]] || { echo "the imported program says \"$said\""; exit 1; }
echo "changed" > "$project/src/data/kept.txt"
"$cmake" --build "$work/build" > /dev/null
[[ $(cat "$work/build/bin/src/data/kept.txt") == changed ]] || { echo "a changed file was not copied"; exit 1; }

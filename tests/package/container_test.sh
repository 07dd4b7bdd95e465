#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# container_test.sh SOURCE WORK [DEBS]: the last stage of scripts/packaging/Dockerfile, instruction by instruction in a
# new Debian, as docker would run it, and its programs in it, as another user. Takes a network. With DEBS, those
# packages are installed and none are made.
set -euo pipefail
source=$1 work=$2 debs=${3:-}
source "$(dirname "${BASH_SOURCE[0]}")/new_debian.sh"
recipe=$source/scripts/packaging/Dockerfile
stage=$(sed 's/^#.*//' "$recipe" | sed -e ':more' -e '/\\$/{N; s/\\\n//; b more}' | awk '/^FROM /{ text = "" } NF { text = text $0 "\n" } END { printf "%s", text }')
[[ $(head -n 1 <<<"$stage") == "FROM debian:$(sed -n 's/^VERSION_ID="\(.*\)"/\1/p' /etc/os-release)-slim" ]] ||
  { echo "these packages are not for the Debian of $recipe"; exit 77; }

make_packages --uncompressed
make_root
mkdir -p "$root/packages"
folder=/ command='' variables=()
while read -r word rest; do
  case $word in
    FROM) ;;
    COPY)
      [[ $rest == '--from=build /packages/'*' /packages/' ]] || { echo "not understood: $word $rest"; exit 1; }
      files=${rest#--from=build /packages/}
      # shellcheck disable=SC2086
      (cd "$debs" && cp ${files% /packages/} "$root/packages/")
      ;;
    RUN) inside env "${variables[@]}" sh -c "$rest" >"$work/run.txt" 2>&1 || { tail -n 40 "$work/run.txt"; exit 1; } ;;
    ENV) variables+=("$rest") ;;
    WORKDIR)
      folder=$rest
      mkdir -p "$root$folder"
      ;;
    CMD) command=$(tr -d '[]",' <<<"$rest") ;;
    *)
      echo "not understood: $word $rest"
      exit 1
      ;;
  esac
done <<<"$stage"

# As docker run --rm --user ... --volume: a folder of the user's.
cp "$source/examples/shader-tests/"* "$root$folder/"
chmod 0777 "$root$folder"
as_user() {
  chroot --userspec=1234:1234 "$root" env -i PATH=/usr/bin:/bin "${variables[@]}" sh -c "cd $folder && $*"
}
as_user "$command"
as_user kaamos-test brdf_test.hlsl --on interpreter,embree,vulkan
as_user kaamos-conformance --filter SBT-02 --summary
echo '[numthreads(1, 1, 1)] void main() {}' >"$root$folder/empty.hlsl"
as_user kaamos-dxc -T cs_6_0 -E main empty.hlsl -Fo empty.cso
[[ -s $root$folder/empty.cso ]] || { echo "kaamos-dxc wrote nothing"; exit 1; }
[[ ! -e $root/packages ]] || { echo "the image keeps its packages"; exit 1; }

# SPDX-License-Identifier: MIT
# What tests in a new Debian have in common. They set $source, $work and $debs.

for tool in dpkg-shlibdeps lintian debootstrap unshare; do
  command -v $tool >/dev/null || { echo "$tool is not installed (apt install dpkg-dev lintian debootstrap)"; exit 77; }
done
((EUID == 0)) || { echo "debootstrap needs root"; exit 77; }
# In namespaces of its own, so that nothing stays mounted and nothing stays running.
if [[ ${APART:-} != 1 ]]; then
  APART=1 exec unshare --mount --pid --fork bash "$0" "$@"
fi
root=$work/root
rm -rf "$work"
mkdir -p "$work"
trap 'umount "$root/proc" 2>/dev/null || true; rm -rf "$work"' EXIT
export DEBFULLNAME="A Packager" DEBEMAIL=packager@debian.org DEBIAN_FRONTEND=noninteractive LC_ALL=C

# make_packages [OPTION]: those in $debs, or new ones.
make_packages() {
  [[ -z $debs ]] || return 0
  debs=$work/debs
  "$source/scripts/package" --debian --no-build --no-install --out "$debs" "$@"
}

# A Debian of this system's release.
make_root() {
  debootstrap --variant=minbase "$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release)" "$root" >"$work/debootstrap.txt" ||
    { tail -n 5 "$work/debootstrap.txt"; exit 1; }
  mount -t proc proc "$root/proc"
  cp /etc/resolv.conf "$root/etc/"
}

inside() {
  chroot "$root" env -u KAAMOS_REQUIRE_VULKAN -u KAAMOS_CXX -u CXX PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root "$@"
}

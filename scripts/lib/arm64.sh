# SPDX-License-Identifier: MIT
# The folder of Debian's packages for ARM64 that cmake/arm64.cmake builds against. Packages are only
# unpacked: the development packages of two processors often cannot be installed side by side, and apt
# would then remove those of this machine.

arm64_sysroot="$root/build/arm64-sysroot"

# why_no_arm64_packages: why they cannot be had here; nothing if they can.
why_no_arm64_packages() {
  local tool
  for tool in apt-get dpkg-deb; do
    command -v "$tool" >/dev/null || {
      echo "the packages for ARM64 come from Debian, and $(system_name) has no $tool."
      return 0
    }
  done
  [[ -n $(debian_release) ]] || echo "the packages for ARM64 come from Debian 12 or newer, and this is $(system_name)."
}

debian_release() {
  if [[ $(system_fact ID) == debian ]]; then system_fact VERSION_CODENAME; fi
}

# Libraries that a build needs, but not the tools, and not what an optional part needs that is not built
# for another processor.
arm64_packages() {
  list_packages build on-arm64 | cut -f1 | grep -E '^lib|-dev$|^glslang-|^spirv-' |
    grep -vE '^(python3-dev|pybind11-dev|libopenmpi-dev|dpkg-dev)$'
}

# make_arm64_sysroot FOLDER: replaces FOLDER. Returns whether that worked; apt's words are in the log.
make_arm64_sysroot() {
  local folder=$1 work="$1.work" packages server deb
  mapfile -t packages < <(arm64_packages)
  server=$(known_suites | awk -v suite="$(debian_release)/main" '$2 == suite && !n++ { print $1 }')
  rm -rf "$work"
  mkdir -p "$work"/{lists/partial,archives/partial,apt/none,root}
  : >"$work/status"
  printf 'deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] %s %s main\n' \
    "${server:-http://deb.debian.org/debian}" "$(debian_release)" >"$work/apt/sources.list"
  # An apt that knows of no installed package and of nothing but this folder, with this machine's proxies.
  cat >"$work/apt.conf" <<END
APT::Architecture "arm64";
APT::Architectures { "arm64"; };
APT::Sandbox::User "";
Dir::State "$work";
Dir::State::status "$work/status";
Dir::Cache "$work";
Dir::Cache::archives "$work/archives";
Dir::Etc "$work/apt";
Dir::Etc::sourcelist "$work/apt/sources.list";
Dir::Etc::sourceparts "$work/apt/none";
Dir::Etc::preferencesparts "$work/apt/none";
Dir::Etc::main "/etc/apt/apt.conf";
Dir::Etc::parts "/etc/apt/apt.conf.d";
END
  step "Fetching ${#packages[@]} packages for ARM64, and what they depend on, from ${server:-http://deb.debian.org/debian}"
  arm64_apt update || return 1
  arm64_apt install --download-only --no-install-recommends "${packages[@]}" || return 1
  for deb in "$work"/archives/*.deb; do
    dpkg-deb --extract "$deb" "$work/root" >>"$log" 2>&1 || return 1
  done
  # qemu looks for every file that a program opens in this folder first, so it holds nothing else.
  (cd "$work/root" && find . -mindepth 1 -maxdepth 1 ! -name usr ! -name 'lib*' -exec rm -r {} +)
  rm -rf "$work/root/usr/share/"{doc,man,locale}
  relocate_arm64_sysroot "$work/root"
  rm -rf "$folder" && mv "$work/root" "$folder" && touch "$folder" && rm -rf "$work"
}

arm64_apt() {
  APT_CONFIG="$work/apt.conf" run_step apt apt-get -y -q -o Acquire::Retries=2 -o Acquire::http::Timeout=30 \
    -o Dpkg::Use-Pty=0 "$@"
}

# relocate_arm64_sysroot FOLDER: links to absolute paths, and CMake files with such paths, would lead to
# this machine's own libraries.
relocate_arm64_sysroot() {
  local folder=$1 link
  while IFS= read -r -d '' link; do
    ln -sfn --relative "$folder$(readlink "$link")" "$link"
  done < <(find "$folder" -type l -lname '/*' -print0)
  find "$folder/usr" -name '*.cmake' -print0 | xargs -0 sed -i \
    -e 's#set(_IMPORT_PREFIX "/usr")#set(_IMPORT_PREFIX "${CMAKE_SYSROOT}/usr")#' \
    -e 's#"/usr/lib/aarch64-linux-gnu/lib#"${CMAKE_SYSROOT}/usr/lib/aarch64-linux-gnu/lib#g'
}

# SPDX-License-Identifier: MIT
# Debian packages of what is built: their files are staged from CMake's components, the rest is
# scripts/packaging/debian.control. debhelper is not needed, since nothing is compiled here.

# make_debian_packages BUILD OUT: one .deb for each package of control, in OUT.
make_debian_packages() {
  local build=$1 out=$2 package
  deb_work="$out/debian-work"
  rm -rf "$deb_work"
  mkdir -p "$deb_work/debian"
  deb_version="$(package_version)-1"
  soversion=$(package_version | cut -d. -f1,2)
  python_is_built=0
  [[ -f $build/python/kaamos/__init__.py ]] && python_is_built=1
  write_debian_sources

  stage "libkaamos$soversion" runtime
  stage "libkaamos-d3d12-$soversion" d3d12
  stage kaamos-tools tools
  stage libkaamos-dev development
  LD_LIBRARY_PATH="$deb_work/libkaamos$soversion/usr/lib:$deb_work/libkaamos-d3d12-$soversion/usr/lib" write_manual_pages \
    "$deb_work/kaamos-tools/usr/bin" "$deb_work/kaamos-tools/usr/share/man/man1" "$root/scripts/packaging/man_pages.txt" \
    "$(package_version)" "$(date -u -d "@$(source_date)" +%F)"
  packages=("libkaamos$soversion" "libkaamos-d3d12-$soversion" kaamos-d3d12 kaamos-tools libkaamos-dev kaamos-doc)
  mkdir -p "$deb_work/kaamos-d3d12/usr/lib"
  mv "$deb_work/libkaamos-d3d12-$soversion/usr/lib/kaamos" "$deb_work/kaamos-d3d12/usr/lib/"
  rm -rf "$deb_work/libkaamos-dev/usr/share/doc"  # the licence, which is in each package's copyright
  stage_documentation kaamos-doc
  if ((python_is_built)); then
    stage python3-kaamos python
    find "$deb_work/python3-kaamos" -name __pycache__ -prune -exec rm -r {} +
    packages+=(python3-kaamos)
  else
    say "note: the Python package is not built; python3-kaamos is left out."
  fi
  for package in "${packages[@]}"; do make_debian_package "$package" "$out"; done
  rm -rf "$deb_work"
}

# stage PACKAGE COMPONENT
stage() {
  DESTDIR="$deb_work/$1" cmake --install "$build" --prefix /usr --component "$2" --strip >>"$log" ||
    die "cmake --install of the component $2 failed; its message is in \"$log\"." \
      "Is everything built? Without --no-build, $program builds it."
  # What is installed in a system folder finds its libraries without a path.
  find "$deb_work/$1" -name '*.so*' -type f -exec chmod 0644 {} +
}

# The pages, with the pictures and sources that they name.
stage_documentation() {
  local folder="$deb_work/$1/usr/share/doc/$1"
  mkdir -p "$folder"
  (cd "$root" && find README.md CHANGELOG.md CONTRIBUTING.md rtapi runtime d3d12 effects examples python \
    \( -name '*.md' -o -path 'examples/*' -type f \) -type f ! -path '*/testdata/*' -print0 |
    sort -z | xargs -0 cp --parents -t "$folder")
  rm "$folder/CHANGELOG.md"  # as changelog.gz, below
  find "$folder" -type f -exec chmod 0644 {} +
}

write_debian_sources() {
  local name email
  name=${DEBFULLNAME:-$(git -C "$root" config user.name || id -un)}
  email=${DEBEMAIL:-$(git -C "$root" config user.email || echo "$(id -un)@$(uname -n)")}
  sed -e "s/@SOVERSION@/$soversion/g" -e "s/\${kaamos:Maintainer}/$name <$email>/" \
    "$root/scripts/packaging/debian.control" >"$deb_work/debian/control"
  printf 'kaamos (%s) unstable; urgency=medium\n\n  * Version %s; changelog.gz says what changed.\n\n -- %s <%s>  %s\n' \
    "$deb_version" "$(package_version)" "$name" "$email" "$(date -u -R -d "@$(source_date)")" >"$deb_work/debian/changelog"
  printf '%s %s %s (= %s)\n' libkaamos "$soversion" "libkaamos$soversion" "$deb_version" \
    libkaamos-d3d12 "$soversion" "libkaamos-d3d12-$soversion" "$deb_version" >"$deb_work/debian/shlibs.local"
  {
    printf 'Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/\n'
    printf 'Upstream-Name: kaamos\n\nFiles: *\nCopyright: %s\nLicense: Expat\n' \
      "$(sed -n 's/^Copyright (c) //p' "$root/LICENSE")"
    printf '\nFiles: usr/include/kaamos-d3d12/directx/* usr/include/kaamos-d3d12/wsl/*\n'
    printf 'Copyright: Microsoft Corporation\nLicense: Expat\n\nLicense: Expat\n'
    sed -n '/^Permission/,$s/^$/./; /^Permission/,$s/^/ /p' "$root/LICENSE"
  } >"$deb_work/debian/copyright"
}

# make_debian_package PACKAGE OUT: control files, then the archive. Files have the time of the sources.
make_debian_package() {
  local package=$1 out=$2 folder="$deb_work/$1" doc elfs=() arch
  doc="$folder/usr/share/doc/$package"
  mkdir -p "$folder/DEBIAN" "$doc"
  cp "$deb_work/debian/copyright" "$doc/copyright"
  gzip -9nc "$root/CHANGELOG.md" >"$doc/changelog.gz"
  gzip -9nc "$deb_work/debian/changelog" >"$doc/changelog.Debian.gz"
  if [[ -f $root/scripts/packaging/$package.overrides ]]; then
    install -D -m 0644 "$root/scripts/packaging/$package.overrides" "$folder/usr/share/lintian/overrides/$package"
  fi
  : >"$deb_work/debian/$package.substvars"
  mapfile -d '' -t elfs < <(find "$folder/usr" -type f \( -path '*/bin/*' -o -name '*.so*' \) -print0)
  if ((${#elfs[@]})); then
    # What is linked statically has no dynamic section, which it says.
    (cd "$deb_work" && dpkg-shlibdeps -T"debian/$package.substvars" -l"$deb_work/libkaamos$soversion/usr/lib" "${elfs[@]}") \
      >>"$log" 2>&1 || die "dpkg-shlibdeps failed for $package; see the end of \"$log\"."
  fi
  if [[ $package == python3-* ]]; then
    python3_versions >>"$deb_work/debian/$package.substvars"
  fi
  if [[ $package == lib*"$soversion" ]]; then
    grep -F " $package " "$deb_work/debian/shlibs.local" | sed 's/ (= .*//' >"$folder/DEBIAN/shlibs"
    echo 'activate-noawait ldconfig' >"$folder/DEBIAN/triggers"
  fi
  (cd "$folder" && find usr -type f -print0 | sort -z | xargs -0 md5sum) >"$folder/DEBIAN/md5sums"
  chmod 0644 "$folder"/DEBIAN/*
  find "$folder" -type d -exec chmod 0755 {} +
  (cd "$deb_work" && dpkg-gencontrol -p"$package" -P"$folder" -T"debian/$package.substvars") >>"$log" 2>&1 ||
    die "dpkg-gencontrol failed for $package; see the end of \"$log\"."
  SOURCE_DATE_EPOCH=$(source_date) dpkg-deb --root-owner-group "$deb_compression" --build "$folder" "$out" >>"$log" 2>&1 ||
    die "dpkg-deb failed for $package; see the end of \"$log\"."
  arch=$(sed -n 's/^Architecture: //p' "$folder/DEBIAN/control")
  made+=("$out/${package}_${deb_version}_$arch.deb")
}

# The extension module is of one version of Python.
python3_versions() {
  local minor
  minor=$(find "$build/python/kaamos" -name '_kaamos.cpython-3*' | sed -n 's/.*cpython-3\([0-9]*\).*/\1/p')
  printf 'python3:Depends=python3 (>= 3.%s~), python3 (<< 3.%s~)\n' "$minor" "$((minor + 1))"
}

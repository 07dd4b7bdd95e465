# SPDX-License-Identifier: MIT
# Finds which packages of scripts/packages.txt are missing and installs them with apt.

package_list="$root/scripts/packages.txt"

# list_packages PURPOSE...: lines "package<TAB>role".
list_packages() {
  awk -v purposes=" $* " '
    /^[[:space:]]*(#|$)/ { next }
    index(purposes, " " $2 " ") {
      role = $0
      sub(/^[^[:space:]]+[[:space:]]+[^[:space:]]+[[:space:]]+/, "", role)
      print $1 "\t" role
    }' "$package_list"
}

# missing_packages PURPOSE...: the same lines, only those that are not installed.
missing_packages() {
  local installed package role
  # Names come as "libpng-dev"; dpkg-query would fail on those it does not know, so ask for all.
  installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' 2>/dev/null |
    awk '$1 == "installed" { print $2 }')
  while IFS=$'\t' read -r package role; do
    grep -qxF -- "$package" <<<"$installed" || printf '%s\t%s\n' "$package" "$role"
  done < <(list_packages "$@")
}

system_name() {
  (. /etc/os-release 2>/dev/null && printf '%s' "${PRETTY_NAME:-}") || uname -s
}

print_roles() {
  local package role
  while IFS=$'\t' read -r package role; do
    [[ -z $package ]] || say "$(printf '  %-22s %s' "$package" "$role")"
  done <<<"$1"
}

# as_root COMMAND...: plainly for root, through sudo for everybody else.
choose_root() {
  local line="apt-get install --no-install-recommends $1"
  if (($(id -u) == 0)); then
    as_root=(env)
  elif ! command -v sudo >/dev/null; then
    die "packages are missing, and installing them takes root: $(id -un) is not root and there is no sudo." \
      "Have somebody with root run this, then run $program again:" "  $line"
  elif sudo -n true 2>/dev/null; then
    as_root=(sudo -n env)
  elif [[ -t 0 && -t 2 ]]; then
    say "sudo installs them and may ask for your password; nothing else runs as root."
    sudo -v || die "sudo did not let $(id -un) in." \
      "Have somebody with root run this, then run $program again:" "  $line"
    as_root=(sudo env)
  else
    die "packages are missing, and sudo wants a password but has no terminal to ask for it." \
      "Run this first, then $program again:" "  sudo $line"
  fi
}

apt() {
  run_step apt "${as_root[@]}" DEBIAN_FRONTEND=noninteractive apt-get -y -q \
    -o DPkg::Lock::Timeout=300 -o Acquire::Retries=2 -o Acquire::http::Timeout=30 \
    -o Acquire::https::Timeout=30 -o Dpkg::Use-Pty=0 "$@"
}

# Why apt-get failed, from what it wrote into the log after line $1.
explain_apt() {
  local said
  said=$(tail -n "+$1" "$log")
  case $said in
    *'No space left'* | *'enough free space'*)
      die "the disk is full: apt-get could not unpack the packages." "Make room and run $program again." ;;
    *'Temporary failure resolving'* | *'Could not resolve'* | *'Network is unreachable'* | \
      *'Could not connect'* | *'Connection timed out'* | *'connection timed out'*)
      die "the package server cannot be reached: this machine seems to be offline." \
        "Connect it, or set a proxy (http_proxy), and run $program again. What apt-get said is in" \
        "\"$log\"." ;;
    *'Could not get lock'*)
      die "another program is installing packages and did not finish within 5 minutes." \
        "Wait for it and run $program again." ;;
    *'Unable to locate package'* | *'has no installation candidate'*)
      die "apt-get does not know some of these packages on $(system_name):" \
        "$(grep -oE "Unable to locate package .*|Package '.*' has no installation candidate" <<<"$said" |
          sort -u | paste -sd ';')" \
        "Debian 12 has them all. On another system install what stands for them, by the role above," \
        "and run $program --no-install." ;;
  esac
  die "apt-get failed. What it said is in \"$log\"; its last lines:" "$(tail -n 3 "$log")"
}

# Tells what is needed where apt is not at hand. Going on is right: the packages may be there
# under other names, and CMake says which is not.
explain_foreign() {
  say "This is $(system_name): $program installs packages only with apt (Debian and its relatives)."
  say "These are needed, under Debian's names:"
  print_roles "$(list_packages "$@")"
  say "Going on with what is installed."
}

# install_packages PURPOSE...: honours no_install=1 (--no-install, KAAMOS_NO_INSTALL=1).
install_packages() {
  local missing names start
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    explain_foreign "$@"
    return 0
  fi
  missing=$(missing_packages "$@")
  if [[ -z $missing ]]; then
    step "All $(list_packages "$@" | wc -l) needed packages are installed."
    return 0
  fi
  if ((${no_install:-0})); then
    step "Missing, and not installed because you asked for that:"
    print_roles "$missing"
    return 0
  fi
  step "Installing packages with apt-get, and what they depend on:"
  print_roles "$missing"
  mapfile -t names < <(cut -f1 <<<"$missing")
  choose_root "${names[*]}"
  start=$(($(wc -l <"$log") + 1))
  # apt-get update ends well even when servers are out of reach; the install is what tells.
  apt update || true
  apt install --no-install-recommends "${names[@]}" || explain_apt "$start"
  missing=$(missing_packages "$@")
  [[ -z $missing ]] || die "apt-get ended well but these packages are still missing:" "$missing"
  say "    installed."
}

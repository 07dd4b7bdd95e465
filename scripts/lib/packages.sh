# SPDX-License-Identifier: MIT
# Finds which packages of scripts/packages.txt are missing and installs them with apt.

package_list="$root/scripts/packages.txt"

# list_packages PURPOSE...: lines "package<TAB>role".
list_packages() {
  local package purpose role
  if [[ " $* " == *' build '* && $(uname -m) == aarch64 ]]; then set -- "$@" on-arm64; fi
  while read -r package purpose role; do
    [[ $package != '#'* && " $* " == *" $purpose "* && -n $purpose ]] || continue
    printf '%s\t%s\n' "$package" "$role"
  done <"$package_list"
}

# missing_packages PURPOSE...: the same lines, only those that are not installed or are too old.
missing_packages() {
  local -A installed=()
  local state package role name version
  # Asks for all packages at once: dpkg-query would fail on names it does not know.
  while read -r state name version; do
    [[ $state != installed || -n ${installed[$name]:-} ]] || installed[$name]=$version
  done < <(dpkg-query -W -f '${db:Status-Status} ${Package} ${Version}\n' 2>/dev/null)
  while IFS=$'\t' read -r package role; do
    name=${package%>=*}
    version=${installed[$name]:-}
    if [[ -z $version ]]; then
      printf '%s\t%s\n' "$package" "$role"
    elif [[ $package == *'>='* ]] && ! version_at_least "$version" "${package#*>=}"; then
      printf '%s\t%s (installed: %s)\n' "$package" "$role" "$version"
    fi
  done < <(list_packages "$@")
}

version_at_least() { sort -V -C <<<"$2"$'\n'"$1"; }

# system_fact KEY: a value from os-release, without its quotes.
system_fact() {
  cat /etc/os-release 2>/dev/null | sed -n "s/^$1=\"\{0,1\}\([^\"]*\)\"\{0,1\}\$/\1/p"
}

system_name() {
  local name
  name=$(system_fact PRETTY_NAME)
  if [[ -n $name ]]; then printf '%s' "$name"; else uname -s; fi
}

print_roles() {
  local package role line
  while IFS=$'\t' read -r package role; do
    [[ -n $package ]] || continue
    printf -v line '  %-22s %s' "$package" "$role"
    say "$line"
  done <<<"$1"
}

# choose_root PACKAGES: sets as_root to the prefix that runs a command as root: env for root, else
# sudo.
choose_root() {
  local package plain='' lines=()
  for package in $1; do
    if [[ $package != *'>='* ]]; then
      plain+=" $package"
    elif [[ $(system_fact VERSION_CODENAME) == bookworm ]]; then
      lines+=("(with bookworm-backports among apt's sources)"
        "apt-get install --no-install-recommends -t bookworm-backports ${package%>=*}")
    else
      lines+=("apt-get install --no-install-recommends ${package%>=*}  # ${package#*>=} or newer")
    fi
  done
  [[ -z $plain ]] || lines=("apt-get install --no-install-recommends$plain" "${lines[@]}")
  if (($(id -u) == 0)); then
    as_root=(env)
  elif ! command -v sudo >/dev/null; then
    die "packages are missing, and installing them takes root: $(id -un) is not root and there is no sudo." \
      "Have someone with root access run this, then run $program again:" "${lines[@]/#/  }"
  elif sudo -n true 2>/dev/null; then
    as_root=(sudo -n env)
  elif [[ -t 0 && -t 2 ]]; then
    say "sudo installs them and may ask for your password; nothing else runs as root."
    sudo -v || die "sudo refused $(id -un)." \
      "Have someone with root access run this, then run $program again:" "${lines[@]/#/  }"
    as_root=(sudo env)
  else
    die "packages are missing, and sudo wants a password but has no terminal to ask for it." \
      "Run this first, then $program again:" "${lines[@]/#/  sudo }"
  fi
}

apt() {
  run_step apt "${as_root[@]}" DEBIAN_FRONTEND=noninteractive apt-get -y -q \
    -o DPkg::Lock::Timeout=300 -o Acquire::Retries=2 -o Acquire::http::Timeout=30 \
    -o Acquire::https::Timeout=30 -o Dpkg::Use-Pty=0 "$@"
}

# Explains why apt-get failed, from what it wrote into the log after line $1.
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
        "Debian 12 and 13 have them all. On another system, install their counterparts by the roles listed above," \
        "and run $program --no-install." ;;
  esac
  die "apt-get failed. What it said is in \"$log\"; its last lines:" "$(tail -n 3 "$log")"
}

# Lists what is needed on systems without apt, and goes on: the packages may be installed under
# other names, and CMake says which one is missing.
explain_foreign() {
  say "This is $(system_name): $program installs packages only with apt (Debian and its relatives)."
  say "These are needed, under Debian's names:"
  print_roles "$(list_packages "$@")"
  say "Continuing with what is installed."
}

# candidate PACKAGE: the version that apt-get install would bring; empty if there is none.
candidate() {
  { apt-cache policy "$1" 2>/dev/null || true; } |
    awk '$1 == "Candidate:" && $2 != "(none)" { print $2 }'
}

# Prints "server suite/component" for everything that apt knows.
known_suites() { { apt-cache policy 2>/dev/null || true; } | awk '$3 ~ "/" { print $2, $3 }'; }

# add_backports: adds bookworm-backports to apt's sources, from the server that bookworm itself
# comes from. apt takes packages from there only on request (it gives the suite priority 100).
add_backports() {
  local server file=/etc/apt/sources.list.d/kaamos-backports.sources
  server=$(known_suites | awk '$2 == "bookworm/main" && !n++ { print $1 }')
  step "Adding Debian's backports to apt's sources, in $file"
  {
    printf 'Types: deb\nURIs: %s\n' "${server:-http://deb.debian.org/debian}"
    printf 'Suites: bookworm-backports\nComponents: main\n'
    printf 'Signed-By: /usr/share/keyrings/debian-archive-keyring.gpg\n'
  } | "${as_root[@]}" tee "$file" >/dev/null ||
    die "cannot write \"$file\"." "Add bookworm-backports to apt's sources by hand and run $program again."
  apt update || true
}

# install_new_enough PACKAGE VERSION: where apt's own version is too old, installs it from backports
# on Debian 12. Elsewhere only the user can know a source: say what is needed and go on. Whatever
# needs the package will say so again.
install_new_enough() {
  local package=$1 wanted=$2 known start
  start=$(($(wc -l <"$log") + 1))
  known=$(candidate "$package")
  if [[ -n $known ]] && version_at_least "$known" "$wanted"; then
    apt install --no-install-recommends "$package" || explain_apt "$start"
  elif [[ $(system_fact VERSION_CODENAME) == bookworm ]]; then
    if [[ $(known_suites) != *' bookworm-backports/main'* ]]; then add_backports; fi
    step "Installing $package $wanted or newer from bookworm-backports"
    apt install --no-install-recommends -t bookworm-backports "$package" || explain_apt "$start"
  else
    say "note: $package $wanted or newer is needed; apt on $(system_name) has ${known:-none}." \
      "Continuing without it: to run on Vulkan, install it from elsewhere."
  fi
}

# install_packages PURPOSE...: honours no_install=1 (--no-install, KAAMOS_NO_INSTALL=1).
install_packages() {
  local missing needed names name start
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    explain_foreign "$@"
    return 0
  fi
  missing=$(missing_packages "$@")
  if [[ -z $missing ]]; then
    mapfile -t needed < <(list_packages "$@")
    step "All ${#needed[@]} needed packages are installed."
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
  # apt-get update succeeds even when servers are out of reach; only the installation shows it.
  start=$(($(wc -l <"$log") + 1))
  apt update || true
  local plain=()
  for name in "${names[@]}"; do [[ $name == *'>='* ]] || plain+=("$name"); done
  if ((${#plain[@]})); then
    apt install --no-install-recommends "${plain[@]}" || explain_apt "$start"
  fi
  for name in "${names[@]}"; do
    [[ $name != *'>='* ]] || install_new_enough "${name%>=*}" "${name#*>=}"
  done
  missing=$(missing_packages "$@" | grep -v '^[^[:space:]]*>=' || true)
  [[ -z $missing ]] || die "apt-get succeeded, but these packages are still missing:" "$missing"
  say "    installed."
}

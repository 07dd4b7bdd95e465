# SPDX-License-Identifier: MIT
# Configures and builds a preset, and explains the usual failures.

cmake_minimum=3.25  # as in CMakeLists.txt

require_tools() {
  local tool version
  for tool in cmake ctest ninja; do
    command -v "$tool" >/dev/null ||
      die "$tool is not installed (or not in PATH)." \
        "On Debian: apt-get install cmake ninja-build. Or run $program without --no-install."
  done
  read -r _ _ version _ < <(cmake --version) || true
  version_at_least "$version" "$cmake_minimum" ||
    die "CMake $version is too old: $(command -v cmake) is the first in PATH, $cmake_minimum is needed." \
      "Debian brings 3.25 or newer as /usr/bin/cmake. Remove the older one or put /usr/bin before it in PATH."
  # CXX may hold options after the compiler's name.
  if [[ -n ${CXX:-} ]]; then
    command -v "${CXX%% *}" >/dev/null ||
      die "CXX names a compiler that does not exist: \"$CXX\"." "Unset CXX to use the system's, or correct it."
  elif ! command -v c++ >/dev/null && ! command -v g++ >/dev/null && ! command -v clang++ >/dev/null; then
    die "there is no C++ compiler in PATH." "On Debian: apt-get install g++"
  fi
}

# Uses all cores, but starts no more compilers than fit into memory (a large file takes about 1
# GiB). Tests that wait for a group that another job runs leave a core idle; one more job uses it.
choose_jobs() {
  local cores memory
  cores=$(nproc 2>/dev/null || echo 2)
  jobs=$cores
  test_jobs=$((cores + 1))
  memory=$(awk '/^MemAvailable:/ { print int($2 / 1048576) }' /proc/meminfo 2>/dev/null || true)
  if [[ -n $memory ]] && ((memory < cores)); then
    jobs=$((memory > 1 ? memory : 1))
    test_jobs=$jobs
    say "note: $cores cores but only $memory GiB of free memory: building $jobs files at a time."
  fi
}

# A full disk can look like any other failure, so check for it first.
die_build() {
  local free
  free=$(free_mib "$root/build")
  if [[ -n $free ]] && ((free < 50)); then die_disk_full; fi
  if grep -q 'No space left on device' "$log"; then die_disk_full; fi
  die "$@"
}

# configure PRESET FOLDER [cmake arguments]
configure() {
  local preset=$1 folder=$2 home fresh=()
  shift 2
  if [[ -f $folder/CMakeCache.txt ]]; then
    home=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$folder/CMakeCache.txt")
    if [[ $home != "$root" ]]; then
      say "note: \"$folder\" was configured for \"$home\"; configuring it from scratch."
      fresh=(--fresh)
    fi
  fi
  step "Configuring (preset $preset)"
  run_step configure cmake -S "$root" --preset "$preset" "${fresh[@]}" "$@" ||
    die_build "configuring failed; CMake says above what is missing." \
      "scripts/packages.txt says what each package is for. The whole log: \"$log\"."
}

# build PRESET [targets]
build() {
  local preset=$1 arguments=()
  shift
  if (($#)); then arguments=(--target "$@"); fi
  step "Building${*:+ $*} with $jobs jobs"
  NINJA_STATUS='[%f/%t] ' run_step build cmake --build --preset "$preset" -j "$jobs" "${arguments[@]}" ||
    die_build "the build failed; the compiler's message is above." "The whole log: \"$log\"."
  say "    built in $(duration "$step_seconds")."
}

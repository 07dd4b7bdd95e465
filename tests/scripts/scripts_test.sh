#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# scripts_test.sh WORK: runs scripts/test and scripts/demo in a copy of the checkout in which small
# scripts play apt-get, sudo, cmake and ctest, and checks what they answer. Nothing is installed or
# built. One function per rule; its name is the rule.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)
source_root=$(cd "$here/../.." && pwd -P)
work=${1:?scripts_test.sh WORK: a folder that it may empty}
real_cat=$(command -v cat)

# It empties WORK, so it takes only a new folder or one that it made itself.
if [[ -e $work && ! -e $work/.made-by-scripts-test ]]; then
  echo "scripts_test.sh: \"$work\" exists and was not made by this test; name a folder that does not." >&2
  exit 2
fi
failures=0

# fake NAME: puts what stdin holds into PATH under this name.
fake() {
  local text
  IFS= read -r -d '' text
  printf '%s' "$text" >"$bin/$1"
  [[ -x $bin/$1 ]] || chmod +x "$bin/$1"
}

# machine FOLDER: where a rule's checkout, the whole of its PATH, and what its fakes know and note are.
machine() {
  checkout="$1/checkout"
  bin="$1/bin"
  state="$1/state"
}

# A fresh checkout, a machine with everything installed, and root as the user; rules start with copies
# of it. The fakes find its state beside the folder they are in.
make_machine() {
  machine "$work/fresh"
  mkdir -p "$checkout" "$bin" "$state"
  cp -r "$source_root/scripts" "$source_root/.ci" "$checkout/"
  local tool tools=()
  for tool in awk bash cp cut date df dirname env find flock grep head ln mkdir mktemp mv nproc paste readlink rm sed \
    sort tail touch tr uname wc xargs; do
    tools+=("$(type -P "$tool")")
  done
  ln -s "${tools[@]}" "$bin/"
  fake c++ <<<'#!/bin/sh'
  fake ninja <<<'#!/bin/sh'
  user root 0
  # A package "mesa>=24.3" is recorded as "mesa 24.3".
  installed_packages "$(awk '!/^#/ && NF { sub(/>=/, " ", $1); print $1 }' "$source_root/scripts/packages.txt")"
  system Debian bookworm
  fake dpkg-query <<'END'
#!/bin/sh
while read -r name version; do echo "installed $name ${version:-1.0}"; done <"${0%/*}/../state/packages"
END
  fake apt-get <<'END'
#!/bin/sh
state=${0%/*}/../state
echo "apt-get $*" >>"$state/calls"
case " $* " in *' install '*) for p in "$@"; do echo "$p"; done >>"$state/packages";; esac
END
  fake apt-cache <<'END'
#!/bin/sh
state=${0%/*}/../state
case " $* " in
  *' mesa-vulkan-drivers '*) cat "$state/candidate" 2>/dev/null;;
  *) echo ' 500 http://mirror.example/debian bookworm/main amd64 Packages'; cat "$state/suites" 2>/dev/null;;
esac
END
  # Only what is to be written as root goes through tee.
  fake tee <<'END'
#!/bin/sh
state=${0%/*}/../state
echo "tee $*" >>"$state/calls"
exec cat >"$state/tee"
END
  fake cmake <<'END'
#!/bin/sh
echo "cmake $*" >>"${0%/*}/../state/calls"
case $1 in --version) echo 'cmake version 3.25.1';; esac
exit 0
END
  # Writes the results that the test prepared, as ctest --output-junit FILE would.
  fake ctest <<'END'
#!/bin/sh
state=${0%/*}/../state
echo "ctest $*" >>"$state/calls"
case $* in *--show-only=*) if [ -f "$state/limits.json" ]; then cat "$state/limits.json"; fi; exit;; esac
while [ $# -gt 0 ]; do if [ "$1" = --output-junit ]; then junit=$2; fi; shift; done
if [ -n "$junit" ] && [ -f "$state/results.xml" ]; then
  mkdir -p "${junit%/*}" && cat "$state/results.xml" >"$junit"
fi
if [ -f "$state/ctest_status" ]; then read -r status <"$state/ctest_status"; fi
exit "${status:-0}"
END
  results ran ran
  : >"$state/calls"
}

# fresh_machine RULE
fresh_machine() {
  machine "$work/$1"
  cp -r "$work/fresh" "$work/$1"
}

user() {
  fake id <<<"#!/bin/sh
case \$1 in -un) echo $1;; *) echo $2;; esac"
}

# system NAME CODENAME: what os-release says.
system() {
  local id=${1%% *}
  printf 'PRETTY_NAME="%s"\nVERSION_CODENAME=%s\nID=%s\n' "$1" "$2" "${id,,}" >"$state/os-release"
  fake cat <<<"#!/bin/sh
if [ \"\$*\" = /etc/os-release ]; then exec $real_cat \"\${0%/*}/../state/os-release\"; fi
exec $real_cat \"\$@\""
}

# mesa INSTALLED CANDIDATE: sets these versions; an empty one means none.
mesa() {
  sed -i '/^mesa-vulkan-drivers/d' "$state/packages"
  if [[ -n $1 ]]; then echo "mesa-vulkan-drivers $1" >>"$state/packages"; fi
  printf '  Installed: %s\n  Candidate: %s\n' "${1:-(none)}" "${2:-(none)}" >"$state/candidate"
}

installed_packages() { printf '%s\n' "$1" >"$state/packages"; }

# results OUTCOME...: ran, failed or skipped; each makes one test result.
results() {
  local outcome n=0
  {
    printf '<testsuite name="x"\n\ttests="%d"\n\t>\n' "$#"
    for outcome in "$@"; do
      n=$((n + 1))
      case $outcome in
        ran) printf '<testcase name="T%d" classname="T" time="0.%d5" status="run">\n' $n $n ;;
        failed) printf '<testcase name="T%d" classname="T" time="1" status="fail">\n<failure message=""/>\n' $n ;;
        skipped)
          printf '<testcase name="T%d" classname="T" time="0" status="notrun">\n' $n
          printf '<skipped message="SKIP_RETURN_CODE=77"/>\n<system-out>needs a GPU\n</system-out>\n'
          ;;
      esac
      printf '</testcase>\n'
    done
    printf '</testsuite>\n'
  } >"$state/results.xml"
}

# command_ NAME [arguments]: sets output and status. No variable of the caller's (CI, CXX) leaks in.
command_() {
  output=$(cd "$checkout" && env -i PATH="$bin" HOME="$work" "$@" 2>&1 </dev/null)
  status=$?
}
run_test() { command_ "$checkout/scripts/test" "$@"; }
run_demo() { command_ "$checkout/scripts/demo" "$@"; }

fail() {
  printf 'FAILED %s: %s\n--- status %s, output:\n%s\n---\n' "$rule" "$1" "$status" "$output"
  failures=$((failures + 1))
}
expect_status() { [[ $status == "$1" ]] || fail "expected exit status $1"; }
expect() { [[ $output == *"$1"* ]] || fail "expected \"$1\" in the output"; }
expect_not() { [[ $output != *"$1"* ]] || fail "did not expect \"$1\" in the output"; }
# called PATTERN: whether a fake noted such a call.
called() {
  local call
  while IFS= read -r call; do
    if [[ $call =~ $1 ]]; then return 0; fi
  done <"$state/calls"
  return 1
}
expect_call() { called "$1" || fail "expected a call \"$1\" among: $(<"$state/calls")"; }
expect_no_call() { ! called "$1" || fail "unexpected call \"$1\""; }
expect_last_line() { [[ ${output##*$'\n'} == "$1" ]] || fail "expected the last line \"$1\""; }

wrong_option_is_named() {
  run_test --fast
  expect_status 1
  expect 'scripts/test: error: unknown option "--fast".'
  expect 'scripts/test --help lists the options.'
  expect_no_call .
}

label_option_needs_a_label() {
  run_test -L
  expect_status 1
  expect '-L needs a label, for example: scripts/test -L unit'
}

help_builds_nothing() {
  run_test --help
  expect_status 0
  expect 'Usage: scripts/test [--full[=PARTS]] [-L LABEL]'
  run_demo --help
  expect_status 0
  expect 'Usage: scripts/demo [northlight arguments]'
  expect_no_call .
}

unwritable_checkout_is_explained() {
  touch "$checkout/build"  # a file in the folder's place stops even root
  run_test
  expect_status 1
  expect "error: cannot write into \"$checkout/build\": File exists."
  expect 'copy this one to a folder that you own'
}

full_disk_is_said_before_the_build() {
  rm "$bin/df"
  fake df <<<"#!/bin/sh
printf 'Filesystem blocks used available\nx 1 1 7 99%% /\n'"
  run_test
  expect_status 1
  expect 'is full (7 MiB free)'
  expect 'Make room'
  expect_no_call cmake
}

everything_installed_asks_for_no_root() {
  user ada 1000
  run_test
  expect_status 0
  expect_no_call apt-get
  expect "All $(grep -vcE '^(clang-tidy|lintian|debootstrap|g\+\+-aarch64-linux-gnu|qemu-user-static|libsimde-dev)( .*)?$' "$state/packages") needed packages are installed."
}

missing_packages_are_named_and_installed() {
  sed -i '/^libpng-dev$/d; /^gdb$/d' "$state/packages"
  run_test
  expect_status 0
  expect 'Installing packages with apt-get'
  expect 'libpng-dev             libpng: PNG pictures'
  expect_call 'apt-get .*update'
  expect_call 'apt-get .*install --no-install-recommends libpng-dev gdb'
  expect_no_call sudo
}

demo_installs_nothing_that_only_tests_need() {
  sed -i '/^gdb$/d' "$state/packages"
  run_demo
  expect_no_call apt-get
}

only_apt_runs_through_sudo() {
  user ada 1000
  installed_packages ninja-build
  fake sudo <<<"#!/bin/sh
echo \"sudo \$*\" >>$state/calls
if [ \"\$1\" = -n ]; then shift; fi
exec \"\$@\""
  fake true <<<'#!/bin/sh'
  run_test
  expect_status 0
  expect_call 'sudo -n env .*apt-get .*install'
  expect_no_call '^sudo .*(--preset|--output-junit)'
}

no_sudo_says_what_to_run() {
  user ada 1000
  sed -i '/^libpng-dev$/d' "$state/packages"
  run_test
  expect_status 1
  expect 'ada is not root and there is no sudo'
  expect '  apt-get install --no-install-recommends libpng-dev'
}

sudo_without_terminal_says_what_to_run() {
  user ada 1000
  sed -i '/^libpng-dev$/d' "$state/packages"
  fake sudo <<<'#!/bin/sh
exit 1'
  run_test
  expect_status 1
  expect 'sudo wants a password but has no terminal'
  expect '  sudo apt-get install --no-install-recommends libpng-dev'
}

offline_machine_is_told_so() {
  sed -i '/^libpng-dev$/d' "$state/packages"
  fake apt-get <<<'#!/bin/sh
echo "E: Failed to fetch http://deb.debian.org/x.deb  Temporary failure resolving deb.debian.org"
exit 100'
  run_test
  expect_status 1
  expect 'the package server cannot be reached: this machine seems to be offline.'
}

unknown_package_is_told_with_the_system() {
  sed -i '/^libembree-dev$/d' "$state/packages"
  fake apt-get <<<'#!/bin/sh
echo "E: Unable to locate package libembree-dev"
exit 100'
  run_test
  expect_status 1
  expect 'apt-get does not know some of these packages'
  expect 'Unable to locate package libembree-dev'
}

without_apt_the_needed_packages_are_listed() {
  rm "$bin/apt-get"
  run_test
  expect_status 0
  expect 'installs packages only with apt (Debian and its relatives)'
  expect 'libembree-dev          Intel Embree'
  expect 'Continuing with what is installed.'
}

old_mesa_is_replaced_from_backports() {
  mesa 22.3.6-1+deb12u2 22.3.6-1+deb12u2
  run_test
  expect_status 0
  expect "mesa-vulkan-drivers>=24.3 Mesa's lavapipe: Vulkan ray tracing pipelines on a CPU (installed: 22.3.6-1+deb12u2)"
  expect "Adding Debian's backports to apt's sources, in /etc/apt/sources.list.d/kaamos-backports.sources"
  expect_call '^tee /etc/apt/sources.list.d/kaamos-backports.sources$'
  expect_call 'apt-get .*install --no-install-recommends -t bookworm-backports mesa-vulkan-drivers'
  output=$(cat "$state/tee")
  expect $'Types: deb\nURIs: http://mirror.example/debian\nSuites: bookworm-backports\n'
}

backports_are_added_once() {
  mesa '' 22.3.6-1+deb12u2
  echo ' 100 http://mirror.example/debian bookworm-backports/main amd64 Packages' >"$state/suites"
  run_test
  expect_status 0
  expect_no_call '^tee'
  expect_call 'apt-get .*install --no-install-recommends -t bookworm-backports mesa-vulkan-drivers'
}

new_enough_mesa_comes_from_where_apt_has_it() {
  system 'Debian GNU/Linux 13 (trixie)' trixie
  mesa '' 25.0.7-2
  run_test
  expect_status 0
  expect_no_call backports
  expect_call 'apt-get .*install --no-install-recommends mesa-vulkan-drivers'
}

system_without_new_enough_mesa_is_told_and_goes_on() {
  system 'Ubuntu 22.04.5 LTS' jammy
  mesa 23.2.1-1ubuntu3 23.2.1-1ubuntu3
  run_test
  expect_status 0
  expect 'mesa-vulkan-drivers 24.3 or newer is needed; apt on Ubuntu 22.04.5 LTS has 23.2.1-1ubuntu3.'
  expect_no_call 'install .*mesa'
}

backports_are_written_through_sudo() {
  user ada 1000
  mesa '' 22.3.6-1+deb12u2
  fake sudo <<<"#!/bin/sh
echo \"sudo \$*\" >>$state/calls
if [ \"\$1\" = -n ]; then shift; fi
exec \"\$@\""
  fake true <<<'#!/bin/sh'
  run_test
  expect_status 0
  expect_call '^sudo -n env tee /etc/apt/sources.list.d/kaamos-backports.sources'
}

no_sudo_says_how_to_get_mesa() {
  user ada 1000
  mesa 22.3.6-1+deb12u2 22.3.6-1+deb12u2
  run_test
  expect_status 1
  expect "  (with bookworm-backports among apt's sources)"
  expect '  apt-get install --no-install-recommends -t bookworm-backports mesa-vulkan-drivers'
}

demo_needs_mesa_only_for_vulkan() {
  mesa 22.3.6-1+deb12u2 22.3.6-1+deb12u2
  northlight '#!/bin/sh
echo "given: $*"'
  run_demo
  expect_status 0
  expect_no_call apt-get
  run_demo --backend vulkan
  expect_status 0
  expect_call 'apt-get .*install --no-install-recommends -t bookworm-backports mesa-vulkan-drivers'
  expect "given: --backend vulkan --effects all --out $checkout/out/demo"
  expect_call 'cmake .*--preset demo.* -DKAAMOS_VULKAN=ON'
}

demo_keeps_vulkan_in_its_build() {
  northlight '#!/bin/sh'
  run_demo
  expect_no_call 'cmake .*-DKAAMOS_VULKAN=ON'
  echo 'KAAMOS_VULKAN:BOOL=ON' >"$checkout/build/demo/CMakeCache.txt"
  run_demo
  expect_call 'cmake .*--preset demo.* -DKAAMOS_VULKAN=ON'
}

demo_renders_the_whole_frame_unless_told_otherwise() {
  northlight '#!/bin/sh
echo "given: $*"'
  run_demo
  expect 'given: --effects all --out'
  run_demo --scene my.gltf --size=64x64
  expect 'given: --scene my.gltf --size=64x64 --effects all --out'
  run_demo --effects ao
  expect 'given: --effects ao --out'
  run_demo --measure sun --size 64x64
  expect 'given: --measure sun --size 64x64 --out'
}

demo_understands_backend_with_equals() {
  mesa '' 22.3.6-1+deb12u2
  northlight '#!/bin/sh'
  run_demo --backend=vulkan
  expect_status 0
  expect_call 'install --no-install-recommends -t bookworm-backports mesa-vulkan-drivers'
}

no_install_goes_on_with_what_is_there() {
  sed -i '/^libpng-dev$/d' "$state/packages"
  run_test --no-install
  expect_status 0
  expect 'Missing, and not installed because you asked for that:'
  expect_no_call apt-get
}

missing_compiler_is_named() {
  rm "$bin/c++"
  run_test
  expect_status 1
  expect 'there is no C++ compiler in PATH.'
  expect 'apt-get install g++'
}

wrong_compiler_variable_is_named() {
  command_ env CXX='g++-99 -m64' "$checkout/scripts/test"
  expect_status 1
  expect 'CXX names a compiler that does not exist: "g++-99 -m64".'
}

missing_cmake_is_named() {
  rm "$bin/cmake"
  run_test
  expect_status 1
  expect 'cmake is not installed (or not in PATH).'
}

old_cmake_is_named_with_its_path() {
  fake cmake <<<'#!/bin/sh
echo "cmake version 3.18.4"'
  run_test
  expect_status 1
  expect "CMake 3.18.4 is too old: $bin/cmake is the first in PATH, 3.25 is needed."
}

failed_configure_shows_cmakes_words() {
  fake cmake <<<'#!/bin/sh
case $1 in --version) echo "cmake version 3.25.1"; exit 0;; esac
printf "%s\n" "-- Looking" "of no interest" "" "CMake Warning at CMakeLists.txt:3:" "  old file" "" "-- Done"
echo "CMake Error: Could not find a package configuration file provided by \"embree\""
exit 1'
  run_test
  expect_status 1
  expect 'Could not find a package configuration file provided by "embree"'
  expect $'CMake Warning at CMakeLists.txt:3:\n  old file'
  expect_not 'no interest'
  expect 'configuring failed; CMake says above what is missing.'
}

failed_build_shows_the_compilers_words() {
  fake cmake <<<'#!/bin/sh
case $1 in --version) echo "cmake version 3.25.1";;
  --build) echo "[1/9] Building x.cpp.o"; echo "x.cpp:3:1: error: expected expression"; exit 1;; esac'
  run_test
  expect_status 1
  expect 'x.cpp:3:1: error: expected expression'
  expect_not '[1/9] Building'
  expect 'the build failed; the compiler'
}

passing_run_closes_with_its_count() {
  run_test
  expect_status 0
  expect_last_line '2 passed, 0 failed, 0 skipped'
  expect_call 'cmake .*--preset release'
  expect_call 'ctest .*-LE \^full\$'
}

failed_test_fails_the_run() {
  results ran failed skipped
  echo 8 >"$state/ctest_status"
  run_test
  expect_status 1
  expect '  T2: failed'
  expect '  T3: needs a GPU'
  expect_last_line '1 passed, 1 failed, 1 skipped'
}

slowest_tests_are_shown_slowest_first() {
  results ran ran ran failed ran ran ran ran ran ran ran ran
  run_test
  expect $'Slowest tests, in seconds:\n     1.00  T4\n     0.95  T9\n'
  expect_not '  T10'
}

costs_are_summed_by_target_and_program() {
  local folder="$checkout/build/release" link='lib/libsmall.so.1 lib/libsmall.so'
  mkdir -p "$folder"
  {
    echo '# ninja log v5'
    printf '0\t9000\t1\tx/CMakeFiles/small.dir/old.cpp.o\tf\n'   # built again below
    printf '0\t1000\t2\tx/CMakeFiles/small.dir/old.cpp.o\ta\n'
    printf '500\t3000\t3\ty/CMakeFiles/large.dir/a.cpp.o\tb\n'
    printf '3000\t4250\t4\ty/CMakeFiles/large.dir/b.cpp.o\tc\n'
    printf '5000\t5500\t5\t%s\td\n' $link  # one step with two outputs
  } >"$folder/.ninja_log"
  printf '0.25\tslow_test\tA.b\n2\tquick_test\tC.d\n1.5\tslow_test\tA.c\n' >"$folder/test-costs.txt"
  command_ "$checkout/scripts/costs"
  expect_status 0
  expect '     3.75  large (2 steps)
     1.00  small (1 steps)
     0.50  lib/libsmall.so (1 steps)
Dearest steps of the build, in seconds:
     2.50  y/CMakeFiles/large.dir/a.cpp.o
     1.25  y/CMakeFiles/large.dir/b.cpp.o'
  expect 'Dearest test programs, in processor seconds:
     2.00  quick_test (1 tests)
     1.75  slow_test (2 tests)'
  run_test
  expect 'Dearest targets of the build'
}

costs_need_a_build() {
  command_ "$checkout/scripts/costs"
  expect_status 1
  expect "\"$checkout/build/release\" has no .ninja_log: nothing was built there."
}

tests_that_come_near_their_limit_are_named() {
  results ran failed ran failed
  printf '    {\n      "command" : \n      [\n        "--limit",\n        "%s",\n        "x"\n      ],
      "name" : "%s",\n      "properties" : \n      [\n        {\n          "name" : "TIMEOUT",
          "value" : %s\n        }\n      ]\n    },\n' 3 T2 36.0 4 T4 38.0 >"$state/limits.json"
  printf '    {\n      "name" : "%s",\n      "properties" : \n      [\n        {
          "name" : "TIMEOUT",\n          "value" : %s\n        }\n      ]\n    },\n' \
    T1 0.5 T3 2.0 >>"$state/limits.json"
  run_test
  expect 'Took more than a quarter of their limit'
  expect '  T2: 1.00 of 3 s'
  expect '  T1: 0.15 of 0.5 s'
  expect_not 'T3: '
  expect_not 'T4: 1'
}

no_test_is_a_failure() {
  results
  run_test -L unti
  expect_status 1
  expect 'no test ran. Is "-L unti" a label?'
  expect_last_line '0 passed, 0 failed, 0 skipped'
}

only_skips_are_a_failure() {
  results skipped skipped
  run_test
  expect_status 1
  expect 'every test was skipped; nothing is proven.'
  expect_last_line '0 passed, 0 failed, 2 skipped'
}

stopped_ctest_is_a_failure() {
  sed -i '/testsuite>/d' "$state/results.xml"
  run_test
  expect_status 1
  expect 'ends early: ctest was stopped.'
}

ctest_without_results_is_a_failure() {
  rm "$state/results.xml"
  run_test
  expect_status 1
  expect 'ctest wrote no results'
}

ctest_failure_without_failed_test_is_a_failure() {
  echo 8 >"$state/ctest_status"
  run_test
  expect_status 1
  expect 'ctest failed (status 8) although no test failed'
}

every_outcome_of_ctest_is_counted() {
  cp "$here/testdata/every_outcome.xml" "$state/results.xml"
  echo 8 >"$state/ctest_status"
  run_test
  expect_last_line '1 passed, 7 failed, 4 skipped'
  expect '  A.Skip: no Vulkan device: install mesa-vulkan-drivers'
  expect '  t2_NOT_BUILT: Unable to find executable'
  expect '  code: needs a <thing> & more'
}

# vulkan_runs RAN REPEATED: what kaamos-isolate noted while ctest ran.
vulkan_runs() {
  awk -v ran="$1" -v repeated="$2" 'BEGIN {
    for (i = 1; i <= ran; i++) print "ran\tV" i
    for (i = 1; i <= repeated; i++) print "repeated\tV" i "\twas ended by signal 11"
  }' >"$state/runs"
  fake ctest <<<"#!/bin/sh
while [ \$# -gt 0 ]; do
  case \$1 in --output-junit) junit=\$2;; --test-dir) folder=\$2;; esac
  shift
done
mkdir -p \"\$folder\" && cat $state/results.xml >\"\$junit\" && cat $state/runs >\"\$folder/vulkan-runs.txt\""
}

repeated_vulkan_tests_are_named() {
  vulkan_runs 200 2
  run_test
  expect_status 0
  expect 'The Vulkan driver crashed or hung in 2 of 200 tests, which were run a second time:'
  expect '  V2 was ended by signal 11'
}

too_many_repeated_vulkan_tests_fail_the_run() {
  vulkan_runs 199 2
  run_test
  expect_status 1
  expect 'more than 1 % of the Vulkan tests had to be run twice'
}

label_is_passed_to_ctest() {
  run_test -L hlsl
  expect_call 'ctest .*-L hlsl'
}

full_run_adds_every_part() {
  arm64_tools
  run_test --full
  expect_status 0
  expect_last_line '16 passed, 0 failed, 0 skipped'
  expect_call 'ctest .*build/release .*-LE \^full\$'
  expect_call 'ctest .*build/release .*-L \^long\$'
  expect_call 'cmake --build --preset asan'
  expect_call 'cmake --build --preset tsan'
  expect_call 'ctest .*build/asan .*-L \^fuzz\$'
}

release_is_built_once_for_tests_and_long() {
  run_test --full
  [[ $(grep -c 'cmake --build --preset release' "$state/calls") == 1 ]] || fail 'built more than once'
}

full_part_runs_alone() {
  run_test --full=long
  expect_status 0
  expect_last_line '2 passed, 0 failed, 0 skipped'
  expect_call 'ctest .*build/release .*-L \^long\$'
  expect_no_call 'preset (asan|tsan)'
  expect_no_call 'LE \^full'
}

long_part_asks_for_full_size_and_sanitizers_do_not() {
  fake ctest <<<"#!/bin/sh
echo \"size: \$KAAMOS_FULL, \$*\" >>$state/calls
exit 1"
  run_test --full=long,tsan
  expect_call 'size: 1, .*build/release'
  expect_call 'size: , .*build/tsan'
}

sanitizers_leave_out_what_runs_no_program_of_ours() {
  run_test --full=sanitizers
  expect_last_line '4 passed, 0 failed, 0 skipped'
  local sanitizer
  for sanitizer in asan tsan; do
    expect_call "ctest .*build/$sanitizer .*-LE \\^\\(full\\|package\\|vulkan\\)\\\$ -E \\^\\(style\\|scripts\\|debug\\)"
  done
  expect_no_call 'preset release'
}

fuzz_part_builds_the_fuzzer_only() {
  run_test --full=fuzz
  expect_status 0
  expect_call 'cmake --build --preset asan .*--target hlsl_fuzz$'
  expect_call 'ctest .*build/asan .*-L \^fuzz\$'
}

full_parts_go_together_with_a_label() {
  run_test --full=asan -L hlsl
  expect_call 'ctest .*build/asan .*-L hlsl'
}

files_part_installs_and_runs_clang_tidy() {
  sed -i '/^clang-tidy$/d' "$state/packages"
  run_test
  expect_no_call apt-get
  run_test --full=files
  expect_status 0
  expect_call 'apt-get .*install .*clang-tidy'
  expect_call 'ctest .*build/dev .*-L \^unit\$'
  expect_call 'cmake --build --preset dev .*--target tidy-check'
}

packages_part_installs_lintian_and_runs_its_tests_alone() {
  sed -i '/^lintian$/d' "$state/packages"
  run_test
  expect_no_call apt-get
  run_test --full=packages
  expect_status 0
  expect_call 'apt-get .*install .*lintian'
  expect_call 'ctest .*build/release .*-L \^packages\$'
  expect_no_call 'build/(asan|tsan)'
}

# What the part arm64 needs. apt-get brings one package, of which dpkg-deb unpacks what has to be corrected.
arm64_tools() {
  fake aarch64-linux-gnu-g++ <<<'#!/bin/sh'
  fake qemu-aarch64-static <<<'#!/bin/sh'
  fake apt-get <<'END'
#!/bin/sh
echo "apt-get $*" >>"${0%/*}/../state/calls"
case " $* " in *' install --download-only '*) touch "${APT_CONFIG%/*}/archives/libm_arm64.deb";; esac
END
  fake dpkg-deb <<'END'
#!/bin/sh
echo "dpkg-deb $*" >>"${0%/*}/../state/calls"
lib="$3/usr/lib/aarch64-linux-gnu"
mkdir -p "$lib/cmake" "$3/lib/aarch64-linux-gnu" "$3/tmp"
touch "$3/lib/aarch64-linux-gnu/libm.so.6"
ln -s /lib/aarch64-linux-gnu/libm.so.6 "$lib/libm.so"
echo 'set(_IMPORT_PREFIX "/usr") "/usr/lib/aarch64-linux-gnu/libm.so"' >"$lib/cmake/m.cmake"
END
}

arm64_part_unpacks_packages_and_runs_its_tests_alone() {
  arm64_tools
  sed -i '/^g++-aarch64-linux-gnu$/d' "$state/packages"
  run_test --full=arm64
  expect_status 1  # the fake apt-get installs nothing
  expect 'these packages are still missing'
  echo g++-aarch64-linux-gnu >>"$state/packages"
  run_test --full=arm64
  expect_status 0
  expect_call 'apt-get .*install --download-only .*libembree-dev.*libsimde-dev$'
  expect_no_call 'install --download-only .*(pybind11-dev| cmake| g[+][+])'
  expect_call 'cmake .*--preset arm64'
  expect_call 'cmake --build --preset arm64 .*--target emulated-tests$'
  expect_call 'ctest .*build/arm64 .*-L \^\(unit\|hlsl\|conformance\)\$'
  expect_no_call 'preset release'
  : >"$state/calls"
  run_test --full=arm64  # the folder is there
  expect_status 0
  expect_no_call download
}

arm64_packages_refer_to_their_own_folder() {
  arm64_tools
  command_ "$checkout/scripts/arm64-sysroot" "$work/arm64_packages_refer_to_their_own_folder/sysroot"
  expect_status 0
  local folder="$work/arm64_packages_refer_to_their_own_folder/sysroot"
  output=$(readlink "$folder/usr/lib/aarch64-linux-gnu/libm.so")
  expect '../../../lib/aarch64-linux-gnu/libm.so.6'
  [[ -e $folder/usr/lib/aarch64-linux-gnu/libm.so ]] || fail 'the link leads nowhere'
  [[ ! -e $folder/tmp ]] || fail 'qemu would look for files of /tmp there'
  output=$(<"$folder/usr/lib/aarch64-linux-gnu/cmake/m.cmake")
  expect 'set(_IMPORT_PREFIX "${CMAKE_SYSROOT}/usr") "${CMAKE_SYSROOT}/usr/lib/aarch64-linux-gnu/libm.so"'
  command_ "$checkout/scripts/arm64-sysroot" --all
  expect_status 1
  expect 'scripts/arm64-sysroot: error: unknown option "--all".'
}

arm64_part_without_its_packages_is_skipped() {
  arm64_tools
  rm "$bin/qemu-aarch64-static"
  run_test --full=long,arm64
  expect_status 0
  expect '  arm64: qemu-aarch64-static is not installed.'
  expect_last_line '2 passed, 0 failed, 1 skipped'
  fake qemu-aarch64-static <<<'#!/bin/sh'
  fake dpkg-deb <<<'#!/bin/sh
exit 2'
  run_test --full=long,arm64
  expect_status 0
  expect "  arm64: Debian's packages for ARM64 could not be fetched"
  system 'Ubuntu 22.04.5 LTS' jammy
  run_test --full=long,arm64
  expect '  arm64: the packages for ARM64 come from Debian 12 or newer, and this is Ubuntu 22.04.5 LTS.'
  expect_no_call 'preset arm64'
}

package_options_are_named() {
  command_ "$checkout/scripts/package" --help
  expect_status 0
  expect 'Usage: scripts/package [--source] [--debian] [--wheel]'
  command_ "$checkout/scripts/package" --rpm
  expect_status 1
  expect 'scripts/package: error: unknown option "--rpm".'
  command_ "$checkout/scripts/package" --out
  expect_status 1
  expect '--out needs a folder, for example: scripts/package --out packages'
  expect_no_call .
}

unknown_full_part_is_named() {
  run_test --full=long,fast
  expect_status 1
  expect 'scripts/test: error: --full has no part "fast".'
  expect 'Its parts: long, asan, tsan, sanitizers (asan and tsan), files, packages, arm64, fuzz.'
  run_test --full=
  expect_status 1
  expect '--full= needs a part, for example: scripts/test --full=long'
  expect_no_call .
}

ci_requires_vulkan() {
  fake ctest <<<"#!/bin/sh
echo \"required: \$KAAMOS_REQUIRE_VULKAN\" >>$state/calls
exit 1"
  command_ "$checkout/.ci/run"
  expect_call 'required: 1'
}

ci_makes_warnings_errors() {
  command_ "$checkout/.ci/run"
  expect_status 0
  expect_call 'cmake .*--preset ci'
  expect_last_line '2 passed, 0 failed, 0 skipped'
}

# Installs a program in northlight's place that prints its arguments.
northlight() {
  mkdir -p "$checkout/build/demo/bin"
  printf '%s\n' "$1" >"$checkout/build/demo/bin/northlight"
  chmod +x "$checkout/build/demo/bin/northlight"
}

demo_writes_into_out_demo() {
  northlight '#!/bin/sh
echo "given: $*"'
  run_demo --size 64x64
  expect_status 0
  expect_call 'cmake --build --preset demo .*--target northlight'
  expect "given: --size 64x64 --effects all --out $checkout/out/demo"
  expect_last_line "Pictures: $checkout/out/demo"
}

demo_keeps_a_given_out() {
  northlight '#!/bin/sh
echo "given: $*"'
  run_demo --out pictures
  expect 'given: --out pictures'
  expect_not out/demo
  run_demo --out=pictures
  expect 'given: --out=pictures'
}

demo_passes_northlights_failure_on() {
  northlight '#!/bin/sh
echo "northlight: error: out/demo: Permission denied" >&2; exit 3'
  run_demo
  expect_status 3
  expect 'out/demo: Permission denied'
  expect 'northlight ended with status 3'
}

rules=$(sed -n 's/^\([a-z0-9_]*\)() {$/\1/p' "${BASH_SOURCE[0]}" |
  grep -vxE 'fake|machine|make_machine|fresh_machine|called|user|system|mesa|installed_packages|results|command_|fail|northlight|vulkan_runs|arm64_tools')
rm -rf "$work"
mkdir -p "$work"
: >"$work/.made-by-scripts-test"
make_machine
count=0
for rule in $rules; do
  output='' status=
  fresh_machine "$rule"
  "$rule"
  count=$((count + 1))
done
rm -rf "$work"
if ((failures)); then
  printf '%d expectations failed in %d rules\n' "$failures" "$count"
  exit 1
fi
printf '%d rules hold\n' "$count"
((count >= 30))

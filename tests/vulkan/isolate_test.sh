#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# isolate_test.sh KAAMOS_ISOLATE WORK: how kaamos-isolate handles programs that crash once or
# always, hang, fail, or list their tests.
set -uo pipefail
isolate=$1
work=$2
failures=0
rm -rf "$work"
mkdir -p "$work"
export KAAMOS_VULKAN_RUNS="$work/runs.txt"

# program NAME BODY: creates a script that records each of its runs.
program() {
  printf '#!/bin/sh\necho run >>"%s/count"\n%s\n' "$work" "$2" >"$work/$1"
  chmod +x "$work/$1"
}

# check NAME STATUS RUNS LINES -- COMMAND...
check() {
  local name=$1 status=$2 runs=$3 lines=$4 got
  shift 5
  rm -f "$work/count" "$work/crashed" "$KAAMOS_VULKAN_RUNS"
  "$isolate" --limit 2 "$@" >"$work/output" 2>&1
  got="$? $(wc -l 2>/dev/null <"$work/count" || echo 0) $(cut -f1 "$KAAMOS_VULKAN_RUNS" 2>/dev/null | paste -sd,)"
  if [[ $got != "$status $runs $lines" ]]; then
    printf 'FAILED %s: status, runs, lines are "%s", expected "%s"\n' "$name" "$got" "$status $runs $lines"
    cat "$work/output"
    failures=$((failures + 1))
  fi
}

program good 'echo "$KAAMOS_VULKAN_VALIDATION $MESA_SHADER_CACHE_DIR"'
program bad 'exit 1'
program crashing 'kill -SEGV $$'
program crashing_once "[ -e $work/crashed ] || { touch $work/crashed; kill -SEGV \$\$; }"
program hanging_once "[ -e $work/crashed ] || { touch $work/crashed; exec sleep 60; }"
filter=--gtest_filter=Shapes.Vulkan/0
check passes 0 1 ran -- "$work/good" $filter
grep -qE '^1 /.*mesa-cache$' "$work/output" || { echo "FAILED environment: $(cat "$work/output")"; failures=$((failures + 1)); }
check failure_is_not_repeated 1 1 ran -- "$work/bad" $filter
check crash_is_repeated_once 1 2 ran,repeated -- "$work/crashing" $filter
grep -q 'Shapes.Vulkan/0 was ended by signal 11' "$work/output" || { echo "FAILED no name"; failures=$((failures + 1)); }
check second_run_may_pass 0 2 ran,repeated -- "$work/crashing_once" $filter
check hang_is_repeated 0 2 ran,repeated -- "$work/hanging_once" $filter
check other_crash_is_not_repeated 1 1 '' -- "$work/crashing_once" --gtest_filter=Shapes.Embree/0
check listing_is_no_run 0 1 '' -- "$work/good" --gtest_list_tests
export KAAMOS_TEST_COSTS="$work/costs.txt"
check cost_is_noted 0 1 '' -- "$work/good" --gtest_filter=Shapes.Embree/0
unset KAAMOS_TEST_COSTS
grep -qE $'^0[.][0-9]+\tgood\tShapes.Embree/0$' "$work/costs.txt" || { echo "FAILED cost: $(cat "$work/costs.txt")"; failures=$((failures + 1)); }
program greeting 'echo "greeting: $GREETING"'
check words_before_the_program 0 1 '' -- --under env --under GREETING=hello "$work/greeting" --gtest_filter=Shapes.Embree/0
grep -q 'greeting: hello' "$work/output" || { echo "FAILED under: $(cat "$work/output")"; failures=$((failures + 1)); }
check missing_program 127 0 '' -- "$work/absent"

# Programs that speak like GoogleTest: four tests, of which b fails and d is skipped.
export KAAMOS_SHARED_RUNS="$work/shared"
speaking='for word; do case $word in
  --gtest_list_tests) printf "S.\n  a\n  b\n  c  # GetParam() = 1\n  DISABLED_x\n  d\n"; exit 0 ;;
  --gtest_filter=*) IFS=:; set -- ${word#--gtest_filter=} ;;
esac; done
status=0
for name; do
  echo "[ RUN      ] $name"
  [ "$name $#" != "${dies:-} 4" ] || kill -SEGV $$
  case $name in
    S.b) echo "wrong"; echo "[  FAILED  ] $name (1 ms)"; status=1 ;;
    S.d) echo "[  SKIPPED ] $name (1 ms)" ;;
    *) echo "said by $name"; echo "[       OK ] $name (1 ms)" ;;
  esac
done'
program sharing "$speaking; exit \$status"
program dying "$speaking; [ \$# = 1 ] && exit \$status; kill -SEGV \$\$"
program dying_at_c "dies=S.c; $speaking; exit \$status"
program slow_vulkan "dies=S.c; ${speaking/'kill -SEGV $$'/'exec sleep 60'}; exit \$status"
program lying "${speaking/FAILED  ]/     OK ]}; exit 1"

# share PROGRAM TEST STATUS TEXT RUNS: its status, a text of its output, and the processes until then,
# that for the list among them.
share() {
  "$isolate" --limit 2 --share 4 "$work/$1" --gtest_filter="$2" >"$work/output" 2>&1
  local got="$? $(wc -l <"$work/count")"
  if [[ $got != "$3 $5" ]] || ! grep -qF "$4" "$work/output" || [[ $(grep -c 'RUN  ' "$work/output") != 1 ]]; then
    printf 'FAILED share %s: status and runs are "%s", output:\n' "$*" "$got"
    cat "$work/output"
    failures=$((failures + 1))
  fi
}
rm -rf "$work/shared" "$work/count"
share sharing S.c 0 'said by S.c' 2
share sharing S.a 0 'said by S.a' 2
share sharing S.b 1 'wrong' 2
share sharing S.d 0 '[  SKIPPED ] S.d' 2
rm "$work/count"
share dying S.a 0 'said by S.a' 3  # the list, all four, S.a alone
share dying S.b 1 'wrong' 4
rm "$work/count"
share dying_at_c S.a 0 'said by S.a' 2  # the list, those up to c
share dying_at_c S.c 0 'said by S.c' 3  # alone
share dying_at_c S.b 1 'wrong' 3
share dying_at_c S.d 0 '[  SKIPPED ] S.d' 4
rm "$work/count"
export KAAMOS_VULKAN_RUNS="$work/slow-runs.txt"
share slow_vulkan S.a 0 'said by S.a' 2
share slow_vulkan S.c 0 'said by S.c' 3
[[ $(cut -f1 "$KAAMOS_VULKAN_RUNS" | paste -sd,) == ran,ran ]] || { echo "FAILED slow group: $(cat "$KAAMOS_VULKAN_RUNS")"; failures=$((failures + 1)); }
rm "$work/count"
share lying S.a 1 'said by S.a' 3  # a status that no test explains: alone
exit $((failures > 0))

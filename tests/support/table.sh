#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# table.sh SUPPORT_TEST PAGE [--write]: runs the support tests on every backend, makes a table of
# their results, and compares it with the one in PAGE (rtapi/SUPPORT.md), or writes it there (--write).
# Exits with 77 where there is no Vulkan device.
set -euo pipefail
support_test=$1
page=$2
begin='<!-- The results of tests/support; tests/support/table.sh writes them. -->'
end='<!-- End of the results. -->'

results=$("$support_test" --gtest_color=no 2>&1) || true
if [[ $results == *'no device: '* ]]; then
  grep -m 1 'no device: ' <<<"$results"
  exit 77
fi
if [[ $results != *' tests from '*' ran.'* ]]; then
  tail -n 3 <<<"$results"
  echo "$support_test did not finish, so no table can be made."
  exit 1
fi
table=$(awk '
  # "AccelerationStructures" becomes "acceleration structures".
  function words(name) { gsub(/[A-Z]/, " &", name); return tolower(substr(name, 2)) }
  # "Build_triangles" becomes "Build (triangles)".
  function call(name) { if (sub(/_/, " (", name)) { gsub(/_/, " ", name); name = name ")" } return name }
  /^\[ *(OK|SKIPPED|FAILED) *\] Backends\/[A-Za-z]+[.][A-Za-z_]+\/[a-z]+.* ms\)/ {
    match($0, /Backends\/[^ ,]+/)
    split(substr($0, RSTART + 9, RLENGTH - 9), part, /[.\/]/)
    suite = part[1]; name = call(part[2]); backend = part[3]
    if (!(suite in calls)) order[++suites] = suite
    if (!seen[suite, name]++) calls[suite] = calls[suite] (calls[suite] == "" ? "" : ", ") "`" name "`"
    if ($0 ~ /^\[ *OK/) works[suite, backend]++
    else if ($0 ~ /^\[ *SKIPPED/) lacks[suite, backend] = lacks[suite, backend] (lacks[suite, backend] == "" ? "" : ", ") "`" name "`"
    else fails[suite, backend] = fails[suite, backend] " `" name "`"
  }
  function cell(suite, backend,    text) {
    text = lacks[suite, backend] == "" ? "all" : (works[suite, backend] ? "all but " : "not ") lacks[suite, backend]
    if (fails[suite, backend] != "") text = text "; FAILS:" fails[suite, backend]
    return text
  }
  END {
    print "| | calls | Embree | Vulkan |"
    print "|---|---|---|---|"
    for (i = 1; i <= suites; i++)
      print "| " words(order[i]) " | " calls[order[i]] " | " cell(order[i], "embree") " | " cell(order[i], "vulkan") " |"
  }' <<<"$results")
committed=$(awk -v begin="$begin" -v end="$end" '$0 == end { on = 0 } on; $0 == begin { on = 1 }' "$page")
if [[ ${3:-} == --write ]]; then
  written=$(awk -v begin="$begin" -v end="$end" -v table="$table" '
    $0 == end { on = 0 } !on; $0 == begin { on = 1; print table }' "$page")
  printf '%s\n' "$written" >"$page"
elif [[ $committed != "$table" ]]; then
  printf '%s\n' "$table"
  echo "The table in $page differs from the results of the tests, shown above. If those are right:"
  echo "  bash tests/support/table.sh $support_test $page --write"
  exit 1
fi
[[ $table != *FAILS:* ]]

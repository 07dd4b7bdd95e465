# SPDX-License-Identifier: MIT
# Tables of what a build and a test run cost.

# print_table TITLE SHOWN: reads "seconds<TAB>text" and prints the dearest; 0: all.
print_table() {
  local seconds text
  say "$1"
  while IFS=$'\t' read -r seconds text; do
    say "$(printf '%9.2f  %s' "$seconds" "$text")"
  done < <(sort -rn | if (($2)); then head -n "$2"; else cat; fi)
}

# build_steps FOLDER: "seconds<TAB>output" of each step that ninja has on record, once for all outputs
# that it made.
build_steps() {
  awk -F '\t' 'NR > 1 { steps[$4] = $0 }
    END {
      for (output in steps) {
        split(steps[output], field, "\t")
        made = field[1] " " field[2] " " field[5]
        if (!(made in first) || output < first[made]) first[made] = output
      }
      for (made in first) { split(made, field, " "); printf "%.3f\t%s\n", (field[2] - field[1]) / 1000, first[made] }
    }' "$1/.ninja_log"
}

# print_build_costs FOLDER SHOWN: targets and steps. A target is the folder that CMake gives it, or else
# the output itself.
print_build_costs() {
  [[ -f $1/.ninja_log ]] || return 0
  build_steps "$1" | awk -F '\t' '{
      target = $2
      if (match(target, /CMakeFiles\/[^\/]*[.]dir/)) target = substr(target, RSTART + 11, RLENGTH - 15)
      seconds[target] += $1; steps[target]++
    }
    END { for (t in seconds) printf "%.3f\t%s (%d steps)\n", seconds[t], t, steps[t] }' |
    print_table "Dearest targets of the build, in seconds:" "$2"
  build_steps "$1" | print_table "Dearest steps of the build, in seconds:" "$2"
}

# print_program_costs FOLDER SHOWN: kaamos-isolate has written test-costs.txt, a line for each of its
# processes.
print_program_costs() {
  [[ -f $1/test-costs.txt ]] || return 0
  awk -F '\t' '
      { seconds[$2] += $1; tests[$2]++ }
      END { for (p in seconds) printf "%.3f\t%s (%d tests)\n", seconds[p], p, tests[p] }' "$1/test-costs.txt" |
    print_table "Dearest test programs, in processor seconds:" "$2"
}

# print_test_costs FOLDER SHOWN
print_test_costs() {
  [[ -f $1/test-results.xml ]] || return 0
  awk -f "$root/scripts/lib/junit.awk" "$1/test-results.xml" | sed -n 's/^time\t//p' |
    print_table "Slowest tests, in seconds:" "$2"
}

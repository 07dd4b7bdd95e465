# SPDX-License-Identifier: MIT
# Reads what `ctest --show-only=json-v1` prints and, before it, lines "seconds<TAB>name" of tests that
# ran (-v times=FILE). Prints "seconds<TAB>limit<TAB>name" of those that took more than a quarter of their
# limit: on a busy machine they may miss it. kaamos-isolate's limit is the one that counts where a test
# starts through it.
function value(line) {
  sub(/^[^:]*: /, "", line)
  gsub(/^"|"?,?$/, "", line)
  return line
}

BEGIN {
  while ((getline line < times) > 0) {
    at = index(line, "\t")
    took[substr(line, at + 1)] = substr(line, 1, at - 1)
  }
}
/^    [{]/ { name = ""; limit = 0; isolated = 0 }
take_limit { isolated = $1; gsub(/[",]/, "", isolated); take_limit = 0 }
/^ *"--limit",?$/ { take_limit = 1 }
/^      "name" : / { name = value($0) }
/^          "name" : "TIMEOUT"/ { take_timeout = 1; next }
take_timeout && /"value" : / { limit = value($0); take_timeout = 0 }
/^    [}]/ && name in took {
  if (isolated) limit = isolated
  if (limit + 0 > 0 && took[name] * 4 > limit + 0) print took[name] "\t" limit + 0 "\t" name
}

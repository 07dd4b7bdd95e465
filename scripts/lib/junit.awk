# SPDX-License-Identifier: MIT
# Reads ctest's JUnit file. Prints one line per test that did not pass, the time of each test that ran,
# and the counts:
#   failed<TAB>name<TAB>what happened
#   skipped<TAB>name<TAB>reason
#   time<TAB>seconds<TAB>name      GoogleTest's own time where it is known: of tests that share a
#                                  process, the first to be asked for waits for all of them
#   total<TAB>passed<TAB>failed<TAB>skipped
# ctest calls a test "notrun" both when it skipped itself and when it could not be started; only the
# first counts as a skip. A file that ends early or holds fewer tests than it announces is an error.

function unescape(s) {
  gsub(/&lt;/, "<", s); gsub(/&gt;/, ">", s); gsub(/&quot;/, "\"", s); gsub(/&apos;/, "'", s)
  gsub(/&amp;/, "\\&", s)
  return s
}

function attribute(line, name,    at, rest) {
  at = index(line, " " name "=\"")
  if (!at) return ""
  rest = substr(line, at + length(name) + 3)
  return unescape(substr(rest, 1, index(rest, "\"") - 1))
}

# GoogleTest prints the reason after "file:line: Skipped"; other tests print only the reason.
function reason(    n, i, lines, text) {
  n = split(output, lines, "\n")
  text = ""
  for (i = 1; i <= n; i++) {
    if (lines[i] ~ /: Skipped$/) {
      for (i++; i <= n && lines[i] !~ /^\[  SKIPPED \]/; i++)
        if (lines[i] != "") text = text (text == "" ? "" : " ") lines[i]
      return text == "" ? "no reason given" : text
    }
  }
  if (output ~ /\[ RUN      \]/) return "no reason given"
  for (i = 1; i <= n; i++) if (lines[i] != "") text = text (text == "" ? "" : " ") lines[i]
  return text == "" ? "no reason given" : substr(text, 1, 200)
}

# What GoogleTest said that the test took; else the time of its process.
function time_of_test(    at, rest) {
  if (!match(output, /\n\[ (      OK|  FAILED |  SKIPPED) \] [^\n]*\([0-9]+ ms\)\n/)) return seconds + 0
  rest = substr(output, RSTART, RLENGTH)
  sub(/.*\(/, "", rest)
  return rest / 1000
}

function close_test() {
  seen++
  seconds = time_of_test()
  if (seconds + 0 > 0) printf "time\t%.2f\t%s\n", seconds, name
  if (status == "run") passed++
  else if (status == "disabled") { skipped++; print "skipped\t" name "\tdisabled in its source" }
  else if (status == "notrun" && why ~ /^SKIP_/) { skipped++; print "skipped\t" name "\t" reason() }
  else { failed++; print "failed\t" name "\t" (why == "" ? "failed" : why) }
  name = ""
}

BEGIN { passed = failed = skipped = seen = 0 }
!in_test && /^[[:space:]]*tests="[0-9]+"/ { announced = $0; gsub(/[^0-9]/, "", announced) }
!in_output && /^[[:space:]]*<testcase / {
  in_test = 1
  name = attribute($0, "name"); seconds = attribute($0, "time"); status = attribute($0, "status"); why = ""; output = ""
  next
}
!in_output && /^[[:space:]]*<(failure|skipped) message=/ { why = attribute($0, "message"); next }
in_test && !in_output && /^[[:space:]]*<system-out>/ { in_output = 1; sub(/^[[:space:]]*<system-out>/, "") }
in_output {
  at = index($0, "</system-out>")
  if (at) { output = output "\n" unescape(substr($0, 1, at - 1)); in_output = 0 }
  else output = output "\n" unescape($0)
  next
}
/^[[:space:]]*<\/testcase>/ { close_test(); in_test = 0; next }
/^<\/testsuite>/ { complete = 1 }
END {
  print "total\t" passed "\t" failed "\t" skipped
  if (!complete || seen != announced + 0) exit 1
}

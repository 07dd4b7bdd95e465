# SPDX-License-Identifier: MIT
# What tests of pages have in common. They set $page and write the output of the page's blocks to output.txt.

# The blocks of commands, but those by hand.
blocks_of_page() {
  awk '/^<!-- by hand -->/ { skip = 1 }
       /^```sh/ { if (!skip) inside = 1; skip = 0; next }
       /^```/ { inside = 0 }
       inside' "$page"
}

# The lines that the page shows as output.
shown_by_page() {
  awk '/^```text/ { inside = 1; next } /^```/ { inside = 0 } inside' "$page"
}

# expect WHAT TEXT: the output has the text.
expect() {
  grep -qF -- "$2" output.txt && return
  echo "$page: the output has no $1 (\"$2\"):"
  cat output.txt
  exit 1
}

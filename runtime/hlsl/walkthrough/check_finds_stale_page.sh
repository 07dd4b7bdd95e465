#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check_finds_stale_page.sh KAAMOS_HLSL: check_page.sh must fail on testdata/stale.md and name exactly the
# lines in testdata/stale.expected.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)
if output=$(bash "$here/check_page.sh" "$1" "$here/testdata/stale.md"); then
  echo "check_page.sh found nothing in testdata/stale.md"
  exit 1
fi
found=$(grep '^stale\.md:' <<<"$output" | cut -d: -f1,2)
diff - "$here/testdata/stale.expected" <<<"$found" && echo "found: $output"

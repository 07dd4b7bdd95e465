#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check_finds.sh RULE: check.sh must fail on testdata/RULE and name exactly the places in
# RULE.expected.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)
if output=$(bash "$here/check.sh" "$1" "$here/testdata/$1"); then
  echo "rule $1 found nothing in testdata/$1"
  exit 1
fi
diff <(cut -d: -f1,2 <<<"$output") "$here/testdata/$1.expected" && echo "found: $output"

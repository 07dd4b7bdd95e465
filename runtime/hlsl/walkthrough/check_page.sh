#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check_page.sh KAAMOS_HLSL PAGE: runs each ```sh block of PAGE in this folder, and looks for the lines of
# the blocks that follow it in its output. A line "..." stands for any lines between. Prints each line that
# is not there as "PAGE:line: why", and how to mend the page.
set -euo pipefail
PATH=$(cd "$(dirname "$1")" && pwd -P):$PATH
page=$(realpath "$2")
name=${2##*/}
cd "$(dirname "${BASH_SOURCE[0]}")"

command='' output=() compared=0 failures=0

fail() {
  echo "$name:$1: $2"
  failures=$((failures + 1))
}

# The output from line `at` on holds lines $1 to $2 of the page, one after another; moves `at` past them.
find_piece() {
  local first=$1 count=$(($2 - $1 + 1)) start length best=0
  for ((start = at; start + count <= ${#output[@]}; ++start)); do
    for ((length = 0; length < count; ++length)); do
      [[ ${output[start + length]} == "${lines[first + length]}" ]] || break
    done
    if ((length == count)); then
      at=$((start + count))
      compared=$((compared + 1))
      return
    fi
    if ((length > best)); then best=$length; fi
  done
  fail $((first + best + 1)) "the command does not print: ${lines[first + best]}"
}

# Compares lines $1 to $2 of the page, a block, with the output.
check_block() {
  local i first=$1 at=0
  if [[ -z $command ]]; then
    fail $(($1 + 1)) "no \`\`\`sh block says where this block comes from"
    return
  fi
  for ((i = $1; i <= $2 + 1; ++i)); do
    if ((i > $2)) || [[ ${lines[i]} == ... ]]; then
      if ((i > first)); then find_piece "$first" $((i - 1)); fi
      first=$((i + 1))
    fi
  done
}

mapfile -t lines <"$page"
for ((i = 0; i < ${#lines[@]}; ++i)); do
  [[ ${lines[i]} == '```'* ]] || continue
  language=${lines[i]#'```'}
  start=$((i + 1))
  for ((i = start; i < ${#lines[@]}; ++i)); do [[ ${lines[i]} != '```' ]] || break; done
  if [[ $language != sh ]]; then
    check_block "$start" $((i - 1))
    continue
  fi
  command=$(printf '%s\n' "${lines[@]:start:i-start}")
  if ! printed=$(bash -o pipefail -c "$command" 2>&1); then
    fail $((start + 1)) "\"$command\" fails: $printed"
  fi
  mapfile -t output <<<"$printed"
done

if ((failures > 0)); then
  echo "To mend the page, build kaamos-hlsl, put its folder in PATH, run the command above the block in"
  echo "runtime/hlsl/walkthrough, and copy what it prints now. See whether the text around it still holds."
  exit 1
fi
if ((compared == 0)); then
  echo "$name has no block to compare"
  exit 1
fi
echo "$name: $compared excerpts are as the commands print them"

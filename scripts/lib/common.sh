# SPDX-License-Identifier: MIT
# Shared by scripts/test and scripts/demo: messages, the log file, progress lines. The caller sets
# `program` (its name in messages) and sources this file first.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd -P)
build_dir="$root/build/release"
log=/dev/null  # open_log points it into build/

# Messages go to the terminal, and into the log once there is one.
say() {
  printf '%s\n' "$*"
  printf '%s\n' "$*" >>"$log"
}

step() { say "==> $*"; }

complain() {
  printf '%s\n' "$*" >&2
  printf '%s\n' "$*" >>"$log"
}

# die MESSAGE...: one line per argument. The first says what went wrong, the others what to do about
# it.
die() {
  complain "$program: error: $1"
  shift
  local line
  for line in "$@"; do complain "  $line"; done
  exit 1
}

# Opens the log NAME below build/, or dies with the system's reason for not being able to write
# there.
open_log() {
  local reason
  if ! reason=$(mkdir -p "$root/build" 2>&1); then
    reason=${reason##*: }
  elif ! reason=$( (: >"$root/build/$1") 2>&1); then
    reason=${reason##*: }
  else
    log="$root/build/$1"
    printf '%s, %s\n' "$program" "$(date '+%Y-%m-%d %H:%M:%S %z')" >>"$log" 2>/dev/null ||
      die_disk_full
    return 0
  fi
  die "cannot write into \"$root/build\": $reason." \
    "The build and its results go beside the sources, into build/ and out/. Use a checkout that" \
    "$(id -un 2>/dev/null || id -u) may write, or copy this one to a folder that you own."
}

free_mib() { df -Pm "$1" 2>/dev/null | awk 'NR == 2 { print $4 }'; }

die_disk_full() {
  log=/dev/null
  die "the disk that holds \"$root/build\" is full ($(free_mib "$root") MiB free)." \
    "A build needs about 3 GB. Make room, then run $program again: it continues where it stopped."
}

# require_space: checks early, because compilers report a full disk in a dozen odd ways.
require_space() {
  local free
  free=$(free_mib "$root/build")
  [[ -n $free ]] || return 0
  if ((free < 200)); then die_disk_full; fi
  if ((free < 3000)) && [[ ! -e $build_dir/CMakeCache.txt ]]; then
    say "note: $free MiB are free here; a full build needs about 3,000 MiB."
  fi
}

# Only one run at a time may use a build folder.
lock_build() {
  command -v flock >/dev/null || return 0
  exec 8>"$root/build/.lock"
  if ! flock -n 8; then
    say "Another scripts/test or scripts/demo is running in this checkout; waiting for it."
    flock 8
  fi
}

# progress KIND: reads a command's output and writes all of it to the log. Lines that only report
# progress become one changing line on a terminal, and one line every ten seconds elsewhere; all
# other lines (warnings, errors, output of a failed test) are shown as they are.
progress() {
  local kind=$1 line text shown=$SECONDS width=0 quiet note=0 tty=0
  if [[ -t 1 ]]; then
    tty=1
    width=$(tput cols 2>/dev/null || echo 80)
  fi
  while IFS= read -r line || [[ -n $line ]]; do
    printf '%s\n' "$line" >>"$log"
    quiet=1 text=$line
    case $kind in
      build) [[ $line =~ ^\[[0-9]+/[0-9]+ ]] || quiet=0 ;;
      configure)
        # CMake's notes begin with "--" and may continue over several lines; warnings start a new
        # message.
        if [[ $line == --* || $line == 'Preset '* ]]; then
          note=1
        elif [[ $line =~ ^CMake\ [A-Z] ]]; then
          note=0
        fi
        quiet=$note
        ;;
      apt) [[ $line != E:* && $line != *'No space left'* ]] || quiet=0 ;;
      test)
        if [[ $line =~ ^\ *([0-9]+)/([0-9]+)\ Test\ +\#[0-9]+:\ (.*)$ ]]; then
          text="[${BASH_REMATCH[1]}/${BASH_REMATCH[2]}] ${BASH_REMATCH[3]}"
          case $line in
            *'***Skipped'* | *'(Disabled)'*) ;;
            *'***'*) quiet=0 ;;
          esac
        elif [[ $line =~ ^\ +Start\ +[0-9]+: || $line == 'Test project '* || -z $line ||
          $line == 'Internal ctest '* ]]; then
          text=
        else
          quiet=0
        fi
        # The closing report repeats ctest's own summary.
        if [[ $line =~ ^[0-9]+%\ tests\ passed ]]; then
          while IFS= read -r line; do printf '%s\n' "$line" >>"$log"; done
          break
        fi
        ;;
    esac
    if ((quiet)); then
      [[ -n $text ]] || continue
      if ((tty)); then
        printf '\r\033[K%s' "${text:0:width-1}"
      elif ((SECONDS - shown >= 10)); then
        printf '%s\n' "$text"
        shown=$SECONDS
      fi
    else
      ((tty)) && printf '\r\033[K'
      printf '%s\n' "$text"
    fi
  done
  ((tty)) && printf '\r\033[K'
  return 0
}

# run_step KIND COMMAND...: runs the command with its output going through progress, and returns its
# exit status. step_seconds is set to the time it took.
run_step() {
  local kind=$1 start=$SECONDS status
  shift
  printf '+ %s\n' "$*" >>"$log"
  "$@" 2>&1 </dev/null 8>&- | progress "$kind"
  status=${PIPESTATUS[0]}
  step_seconds=$((SECONDS - start))
  return "$status"
}

duration() {
  if (($1 < 60)); then printf '%d s' "$1"; else printf '%d min %d s' $(($1 / 60)) $(($1 % 60)); fi
}

trap 'printf "\n%s: interrupted; run it again to continue from here.\n" "$program" >&2; exit 130' INT TERM

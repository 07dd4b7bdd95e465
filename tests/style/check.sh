#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check.sh RULE ROOT: checks one house rule on the sources below ROOT. Prints each violation as
# "file:line: why" and fails if there is any. Rules: spdx, paths, marks, readme, indexed, length,
# listed, used, told, twice, recipes, documented, layers, pages, ids, named, cited.
set -euo pipefail
rule=$1
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)
cd "$2"

# Test inputs (testdata) break rules on purpose, and an extra line would move the lines they expect.
list_files() {
  find . \( -name build -o -name out -o -name .git -o -name .cache -o -name testdata \) -prune -o \
    -type f \( "$@" \) -printf '%P\n' | LC_ALL=C sort
}
code=(\( -name '*.cpp' -o -name '*.h' -o -name '*.hlsl' -o -name '*.hlsli' -o -name '*.sh' -o -name '*.awk'
  -o -name '*.cmake' -o -name '*.cmake.in' -o -name CMakeLists.txt -o -path './scripts/*' -o -path './.ci/*' \)
  ! -name '*.md')

# Every source begins with its licence line, after "#!" where there is one.
check_spdx() {
  list_files "${code[@]}" | xargs -r -d '\n' awk '
    FNR == 1 && /^#!/ { next }
    FNR <= 2 && !seen[FILENAME]++ {
      if ($0 !~ /^(\/\/|#) SPDX-License-Identifier: MIT\r?$/)
        print FILENAME ":" FNR ": does not begin with \"SPDX-License-Identifier: MIT\" in a comment"
    }'
  # awk never sees a line of an empty file.
  list_files "${code[@]}" -empty | sed 's/$/:1: is empty/'
}

# No source contains a path of one particular machine. The brackets keep the patterns from matching
# themselves.
check_paths() {
  list_files "${code[@]}" -o -name '*.md' -o -name '*.json' -o -name '*.txt' | xargs -r -d '\n' grep -nIHE \
    '(^|[^A-Za-z0-9_.$}])([/]work/|[/]root/|[/]home/[a-z]|[/]tmp/[a-z]|[/]Users/[A-Za-z])' | sed 's/^\([^:]*:[0-9]*\):.*/\1: holds a path of one machine/' || true
}

# A type has one definition: if two types in one namespace share a name, the linker picks the inline
# functions of either. Looks at the first column only, so members and local types do not count;
# neither do forward declarations and stubs ({}).
check_twice() {
  list_files -name '*.cpp' -o -name '*.h' | xargs -r -d '\n' awk '
    FNR == 1 { depth = 0; unnamed = 0 }
    /^namespace( [A-Za-z0-9_:]+)? *\{/ {
      depth++
      spaces[depth] = $2 == "{" ? "" : $2
      if ($2 == "{") unnamed++
      next
    }
    /^}  \/\/ namespace/ && depth > 0 { if (spaces[depth--] == "") unnamed--; next }
    unnamed || depth == 0 || /[{][}];$/ || (/;$/ && !/[{]/) { next }
    /^(struct|class|enum class|enum|union) [^<({:;]*[A-Za-z0-9_]+( final)? *(:[^:]|[{]|$)/ {
      name = $0
      sub(/^(enum class|struct|class|enum|union) +(alignas\([^)]*\) *|\[\[[^]]*\]\] *)*/, "", name)
      sub(/[^A-Za-z0-9_].*/, "", name)
      path = ""
      for (i = 1; i <= depth; ++i) path = path spaces[i] "::"
      key = path name
      if (!(key in where)) where[key] = FILENAME
      else if (where[key] != FILENAME) print FILENAME ":" FNR ": " key " is defined in " where[key] " too"
    }'
}

# What is still to do belongs in an issue, not in a source.
check_marks() {
  list_files "${code[@]}" -o -name '*.md' |
    xargs -r -d '\n' grep -nIHE '\b(TO[D]O|FIX[M]E|XX[X]|HA[C]K)\b' |
    sed 's/^\([^:]*:[0-9]*\):.*/\1: holds a left-over mark/' || true
}

# Pages link to files that exist. A block of code below the line "<!-- From FILE -->" is from that file:
# each of its lines is there, in this order; "..." stands for what is left out.
check_pages() {
  local page line target
  list_files -name '*.md' | while read -r page; do
    awk '
      /^ *```/ { code = !code }
      code { next }
      {
        gsub(/`[^`]*`/, "")
        while (match($0, /\]\([^()]+\)/)) {
          target = substr($0, RSTART + 2, RLENGTH - 3)
          $0 = substr($0, RSTART + RLENGTH)
          sub(/#.*/, "", target)
          if (target != "" && target !~ /^[a-z]+:/) print FNR, target
        }
      }' "$page" | while read -r line target; do
      [[ -e ${page%"${page##*/}"}$target ]] || echo "$page:$line: links to $target, which does not exist"
    done
    awk -v page="$page" '
      /^<!-- From .* -->$/ { source = $3; next }
      /^```/ && code { code = 0; close(source); source = ""; next }
      /^```/ { code = source != ""; next }
      code && !/^[[:space:]]*([.][.][.])?$/ {
        found = 0
        while (!found && (getline text < source) > 0) found = text == $0
        if (!found) { print page ":" FNR ": is not in " source " (or not behind the line above)"; close(source) }
      }' "$page"
  done
}

# A folder of sources has a README.md of at most one page. Folders that only continue the one above
# them (src, include and their contents, one folder per shader or scene) need none.
check_readme() {
  local folder lines
  list_files "${code[@]}" | sed -n 's|^\([^.][^/]*/.*\)/[^/]*$|\1|p; s|^\([^./][^/]*\)/[^/]*$|\1|p' |
    grep -vE '(^|/)(src|include|lib|shaders|testing|consumer)(/|$)' | LC_ALL=C sort -u |
    while read -r folder; do
      if [[ ! -f $folder/README.md ]]; then
        echo "$folder:1: has no README.md: what lives here, what it may include, where to start reading"
        continue
      fi
      lines=$(wc -l <"$folder/README.md")
      if ((lines > 60)) && [[ $folder != . ]]; then
        echo "$folder/README.md:$lines: is longer than a page (60 lines)"
      fi
    done
}

# The README of these folders has a row (a line of a table or list) for each sub-folder, beginning
# with its name as `name/`, and no row for a folder that does not exist. Two folders may share a
# row.
check_indexed() {
  local folder readme rows name line
  for folder in tests effects runtime examples d3d12; do
    [[ -d $folder ]] || continue
    readme=$folder/README.md
    rows=$(grep -nE '^[|*-] ' "$readme" 2>/dev/null |
      sed -nE 's/^([0-9]+):[|*-] +(\[?`[A-Za-z0-9_.-]+\/`[^|:]*).*/\1 \2/p' |
      while read -r line text; do grep -oE '`[A-Za-z0-9_.-]+/`' <<<"$text" | tr -d '`/' | sed "s/^/$line /"; done) || true
    list_files -path "./$folder/*/*" | cut -d/ -f2 | LC_ALL=C sort -u | while read -r name; do
      grep -qE "^[0-9]+ ${name//./[.]}\$" <<<"$rows" || echo "$readme:1: has no row for $name/"
    done
    while read -r line name; do
      [[ -z $name || -d $folder/$name ]] || echo "$readme:$line: lists $name/, which does not exist"
    done <<<"$rows"
  done
}

# Past 500 lines, ask what second noun lives in the file. This only warns and never fails.
check_length() {
  list_files "${code[@]}" | xargs -r -d '\n' wc -l |
    awk '$2 != "total" && $1 > 500 { print "warning: " $2 ":" $1 ": has more than 500 lines" }' >&2
}

# Lines "package kind pattern" of package_uses.txt; kind is needed or optional.
list_uses() { grep -vE '^(#|$)' tests/style/package_uses.txt; }
list_cmake() { list_files \( -name CMakeLists.txt -o -name '*.cmake' \) ! -path './tests/package/consumer/*'; }

# Whatever CMake looks for comes from a package in scripts/packages.txt; otherwise a fresh Debian
# could not build.
check_listed() {
  local file line text pattern
  list_cmake | xargs -r -d '\n' grep -nHE '^ *(find_package|find_program|find_path|find_library|pkg_[a-z_]+) ?\(' |
    while IFS=: read -r file line text; do
      while read -r package kind pattern; do
        if [[ $text =~ $pattern ]]; then
          if [[ $kind == needed ]] && ! grep -qE "^${package//+/[+]}(>=[0-9.:]+)? " scripts/packages.txt; then
            echo "$file:$line: needs $package, which scripts/packages.txt does not list"
          fi
          continue 2
        fi
      done < <(list_uses)
      echo "$file:$line: no line of tests/style/package_uses.txt says which package this is from:$text"
    done
}

# Prints the lines of the test or function NAME in FILE, from its first line to the closing brace in
# column one.
body_of() {
  awk -v name="$2" '
    !inside && ($0 ~ "^TEST.*, *" name "\\)" || $0 ~ "^(void|bool|static .*) " name "\\(") { inside = 1 }
    inside { print }
    inside && /^}/ { exit }' "$1"
}

# Each class of errors has a row in tests/checks/ERRORS.md, and the test that a row names contains
# its message id.
check_errors() {
  local file=tests/checks/ERRORS.md line class id test path name wanted
  [[ -f $file ]] || return 0
  for wanted in $(seq -f 'ERR-%02g' 1 32); do
    grep -q "^| $wanted |" "$file" || echo "$file:1: has no row of $wanted"
  done
  grep -nE '^\| ((ERR|DRW)-[0-9]+)? ?\|' "$file" | while IFS=: read -r line row; do
    IFS='|' read -r _ class _ id test _ <<<"$row"
    id=${id// /} test=${test# } test=${test% }
    [[ -n $id ]] || continue
    path=${test%%:*} name=${test#*: }
    if [[ ! -f $path ]]; then
      echo "$file:$line: there is no $path"
    elif ! body_of "$path" "$name" | grep -qF "$id"; then
      echo "$file:$line: \"$name\" of $path does not hold $id"
    fi
  done
}

# Some test contains the id of each checked-mode message; tests/conformance/err*.cpp, tests/checks
# and tests/checked_code provoke them.
check_told() {
  check_errors
  local file=runtime/checks/messages.inc line text id held
  held=$(list_files -name '*_test.cpp' -o -path './tests/conformance/err*.cpp' |
    xargs -r -d '\n' grep -ohE '"KA[0-9]{4}' | sort -u)
  grep -nE '^KAAMOS_MESSAGE\(' "$file" | while IFS=: read -r line text; do
    text=${text#'KAAMOS_MESSAGE('}
    printf -v id 'KA%04d' "${text%%,*}"
    [[ $held == *"\"$id"* ]] || echo "$file:$line: no test holds $id"
  done
}

# An error's id comes from its layer's table: code that spells one out would not show in rtapi/ERRORS.md. The
# pattern is a string literal with an id, after any other literals of its line and outside of comments.
check_ids() {
  list_files -name '*.cpp' -o -name '*.h' | grep -E '^(rtapi|runtime|effects)/' |
    grep -vE '(_test\.cpp|_fixture\.h|/testing/.*|_test_support\.h)$' | xargs -r -d '\n' grep -nHE \
    '^([^"/]|/[^/]|"([^"\\]|\\.)*")*"([^"\\]|\\.)*KA[0-9]{4}' |
    sed 's/^\([^:]*:[0-9]*\):.*/\1: spells out the id of an error; take it from the table/' || true
}

# No package is installed that nothing uses.
check_used() {
  local package pattern sources
  mapfile -t sources < <(list_files \( -name CMakeLists.txt -o -name '*.cmake' -o -name 'CMakePresets.json' \
    -o -name '*.cpp' -o -name '*.h' \))
  awk '!/^#/ && NF { sub(/>=.*/, "", $1); print $1 }' scripts/packages.txt | while read -r package; do
    pattern=$(list_uses | awk -v package="$package" '$1 == package { sub(/^[^ ]+ +[^ ]+ +/, ""); print; exit }')
    if [[ -z $pattern ]]; then
      echo "scripts/packages.txt:1: tests/style/package_uses.txt does not say what uses $package"
    elif ! grep -qsE -- "$pattern" /dev/null "${sources[@]}"; then
      echo "scripts/packages.txt:1: nothing uses $package: no source matches \"$pattern\""
    fi
  done
}

# The recipes of CONTRIBUTING.md name files of this tree: `folder/file` and `folder/`, with * as in a shell. What
# has <...> in it is for the reader to fill in; build/ is made.
check_recipes() {
  local file=CONTRIBUTING.md line name
  [[ -f $file ]] || return 0
  grep -noE '`[.A-Za-z0-9_*-]+/[.A-Za-z0-9_*/-]*`|`[A-Z]+\.md`' "$file" | tr -d '`' |
    while IFS=: read -r line name; do
      [[ $name == build/* || -n $(compgen -G "${name%/}") ]] || echo "$file:$line: there is no $name"
    done
}

# The headers that the reference manual is made of, by the project's Doxyfile.
list_public_headers() {
  local patterns pattern hidden=()
  patterns=$(sed -n '/^EXCLUDE_PATTERNS/,/[^\\]$/{s/^[A-Z_]* *=//; s/\\$//; p}' "$here/../../cmake/Doxyfile")
  while read -r pattern; do
    hidden+=(! -path "$pattern")
  done < <(tr -s ' ' '\n' <<<"$patterns" | grep .)
  list_files \( -path './rtapi/include/*.h' -o -path './effects/*.h' -o -path './d3d12/include/win/kaamos_present.h' \) "${hidden[@]}"
}

# What Doxygen says of these headers by the project's own settings: every public type, function and member has
# a comment, and Doxygen understands it.
check_comments() {
  local scratch
  scratch=$(mktemp -d)
  {
    cat "$here/../../cmake/Doxyfile"
    echo "INPUT = $(list_public_headers | tr '\n' ' ')"
    echo "USE_MDFILE_AS_MAINPAGE ="
    echo "GENERATE_HTML = NO"
    echo "GENERATE_XML = YES"
    echo "XML_PROGRAMLISTING = NO"
    echo "WARN_AS_ERROR = NO"
    echo "WARN_LOGFILE = \"$scratch/warnings\""
  } >"$scratch/Doxyfile"
  KAAMOS_MANUAL_DIR=$scratch KAAMOS_VERSION=0 doxygen "$scratch/Doxyfile" >"$scratch/log" 2>&1 ||
    sed 's/^/cmake\/Doxyfile:1: /' "$scratch/log"
  sed -n "s|^$PWD/||; s/: warning: /: /p" "$scratch/warnings" | LC_ALL=C sort -u
  rm -rf "$scratch"
}

# What Doxygen does not ask for: @file, without which it passes over a header's functions; and the errors of each
# call that returns a Result or a Status, behind @errors, in rtapi with their ids. @overload points at another.
check_errors_of_calls() {
  list_public_headers | xargs -r -d '\n' awk '
    function close_file() { if (last != "" && !has_file) print last ":1: has no @file" }
    FNR == 1 { close_file(); last = FILENAME; has_file = 0; comment = ""; hidden = 0 }
    /^\/\/\/ @file/ { has_file = 1 }
    /^ *\/\/\// { comment = comment $0; next }
    /^ *(private|protected):/ { hidden = 1 }
    /^ *public:|^[}]/ { hidden = 0 }
    /^ *(template <|\[\[)/ && !/[(]/ { next }
    !hidden && /^ *(static |inline )?(rtapi::)?(Result<.*>|Status)( [A-Za-z_]+\(|$)/ {
      errors = FILENAME ~ /^rtapi/ ? "@errors.*KA[0-9][0-9][0-9][0-9]" : "@errors ."
      if (comment !~ /@overload/ && comment !~ errors && !/Status failure/)
        print FILENAME ":" FNR ": returns an error, and its comment names none by @errors"
    }
    { comment = "" }
    END { close_file() }'
}

# Public headers are the contract: what is in them is said there, for the reference manual too.
check_documented() {
  if ! command -v doxygen >/dev/null; then
    echo "cmake/Doxyfile:1: doxygen is missing, which reads the comments: apt-get install doxygen"
    return
  fi
  check_comments
  check_errors_of_calls
}

# No arrow upward: includes and CMake's links go only where layers.txt says, and READMEs say the same. Tests
# include what they like.
check_layers() {
  {
    list_files -name '*.cpp' -o -name '*.h' -o -name '*.inc' -o -name '*.hlsl' -o -name '*.hlsli' |
      grep -E '^(rtapi|runtime|d3d12|effects|examples)/' | grep -vE '(_test\.cpp|_fixture\.h|/testing/.*|_test_support\.h)$'
    list_files -name CMakeLists.txt -o -name README.md | grep -E '^(rtapi|runtime|d3d12|effects|examples)/'
  } | awk -f "$here/layers.awk" tests/style/layers.txt - | LC_ALL=C sort
}

# Comments and pages cite what a reader can find: a page is one of this tree, and so is a document that is cited by
# a name with hyphens, before a number of its sections or the end of a line.
check_cited() {
  list_files "${code[@]}" -o -name '*.md' -o -name '*.glsl' -o -name '*.inc' -o -name '*.py' | xargs -r -d '\n' grep -noHE \
    '\b([A-Z_]{2,}|([a-z0-9]+-)+[a-z0-9]+)[.]md\b|([[(]|; )[a-z]+(-[a-z0-9]+)+ (part |section )?([A-Z]{0,2}[0-9]|[A-Z][.:])|[[(][a-z]+(-[a-z0-9]+)+$' |
    awk -F: '
      FNR == NR { sub(/.*\//, ""); pages[$0]; next }
      { name = $3; sub(/^[[(;] ?/, "", name); sub(/[. ].*/, "", name) }
      !(name ".md" in pages) { print $1 ":" $2 ": cites " name ", which this tree does not have" }' \
      <(list_files -name '*.md') -
}

# The pages that lead through the sources name files and functions that exist.
check_named() {
  local page
  for page in runtime/RAY.md runtime/hlsl/WALKTHROUGH.md; do
    if [[ -f $page ]]; then
      awk -f "$here/named.awk" "$page"
    else
      echo "$page:1: there is no such page"
    fi
  done
}

case $rule in
  spdx | paths | marks | readme | indexed | length | listed | used | told | twice | recipes | documented | layers | \
    pages | ids | named | cited) ;;
  *) echo "check.sh: unknown rule \"$rule\"" >&2; exit 2 ;;
esac
found=$("check_$rule")
if [[ -n $found ]]; then
  printf '%s\n' "$found"
  exit 1
fi
echo "rule $rule holds"

# SPDX-License-Identifier: MIT
# Reads layers.txt, then a list of sources, CMakeLists.txt and README.md files; prints each include and each
# link that layers.txt does not allow, and each README that says something else, as "file:line: why".

# The most specific folder of layers.txt that holds a path; empty where none does.
function layer_of(path,    folder) {
  folder = path
  while (sub(/\/[^\/]*$/, "", folder)) {
    if (folder in known) return folder
  }
  return ""
}

# Whether a source of one layer may use another. A folder may use itself.
function allowed(from, to, kind) {
  return from == to || (from, to, "include") in rule || (from, to, kind) in rule
}

function check_source(file,    line, number, target, from, to) {
  from = layer_of(file)
  if (from == "") return
  while ((getline line < file) > 0) {
    number++
    if (line !~ /^ *# *include [<"]/) continue
    target = line
    sub(/^ *# *include [<"]/, "", target)
    sub(/[>"].*/, "", target)
    if (target ~ /^rtapi\/[^\/]*\.h$/) target = "rtapi/include/" target
    if (target ~ /^kaamos\/shader\//) target = "runtime/shader/include/" target
    to = layer_of(target)
    if (to != "" && !allowed(from, to, "include")) {
      print file ":" number ": " from " must not include " to
    }
  }
  close(file)
}

# What a README says its folder may include: "May include `a`, `b` and `c`.", up to the end of the sentence. Each
# is below the root, beside the folder or a file in it. In runtime/ all are named that layers.txt allows the folder.
function check_readme(file,    line, number, start, text, from, folder, name, to, named, key, pair) {
  folder = file
  sub(/\/README\.md$/, "", folder)
  from = layer_of(file)
  if (from == "") return
  while ((getline line < file) > 0) {
    number++
    if (!start && match(line, /May include /)) {
      start = number
      line = substr(line, RSTART)
    }
    if (start && text !~ /[.;:]$/) text = text " " line
    if (match(text, /[.;:]( |$)/)) text = substr(text, 1, RSTART)
  }
  close(file)
  if (!start) return
  while (match(text, /`[^`]*`/)) {
    name = substr(text, RSTART + 1, RLENGTH - 2)
    text = substr(text, RSTART + RLENGTH)
    sub(/\/$/, "", name)
    to = layer_of(name "/")
    if (to == "") {
      sub(/^\.\.\//, "", name)
      to = layer_of(substr(folder, 1, match(folder, /[^\/]*$/) - 1) name "/")
    }
    if (to == "" && name !~ /\//) to = from
    named[to]
    if (to == "") print file ":" start ": may include " name ", which is no folder of layers.txt"
    else if (!allowed(from, to, "include")) print file ":" start ": names " name "; " from " must not include " to
  }
  if (folder !~ /^runtime\// || folder != from) return
  for (key in rule) {
    split(key, pair, SUBSEP)
    if (pair[1] == from && pair[3] == "include" && !(pair[2] in named))
      print file ":" start ": does not name " pair[2] ", which " from " may include"
  }
}

# Remembers which folder makes a library, and who links what where.
function read_cmake(file,    line, number, text, start, word, count, i, name, scope) {
  while ((getline line < file) > 0) {
    number++
    sub(/(^|[ \t])#.*/, "", line)
    if (text == "" && line !~ /^ *(add_library|target_link_libraries) *\(/) continue
    if (text == "") start = number
    text = text " " line
    if (line !~ /\)[ \t]*$/) continue
    count = split(text, word, /[ \t()]+/)
    i = word[1] == "" ? 2 : 1
    name = word[i + 1]
    if (word[i] == "add_library") {
      home[name] = layer_of(file)
    } else {
      for (i += 2; i <= count; i++) {
        if (word[i] ~ /^[A-Za-z0-9_-]+$/ && word[i] !~ /^(PUBLIC|PRIVATE|INTERFACE)$/) {
          links++
          link_file[links] = file; link_line[links] = start
          link_from[links] = name; link_to[links] = word[i]
        }
      }
    }
    text = ""
  }
  close(file)
}

FNR == 1 { files++ }
files == 1 && (/^#/ || NF == 0) { next }
files == 1 {
  kind = $2 == "links" ? "link" : "include"
  sub(/:$/, "", $1)
  if (kind == "include") known[$1] = 1
  for (i = kind == "link" ? 3 : 2; i <= NF; i++) rule[$1, $i, kind] = 1
  next
}
/CMakeLists\.txt$/ { read_cmake($0); next }
/README\.md$/ { check_readme($0); next }
{ check_source($0) }
END {
  for (i = 1; i <= links; i++) {
    from = home[link_from[i]]
    to = home[link_to[i]]
    if (from != "" && to != "" && !allowed(from, to, "link")) {
      print link_file[i] ":" link_line[i] ": " link_from[i] " of " from " must not link " link_to[i] " of " to
    }
  }
}

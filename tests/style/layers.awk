# SPDX-License-Identifier: MIT
# Reads layers.txt, then lists of "F file" (a source; its lines follow through getline) and CMakeLists.txt
# files; prints each include and each link that layers.txt does not allow, as "file:line: why".

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

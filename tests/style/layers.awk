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

# The most specific folder with rules for links that holds a CMakeLists.txt, else the layer that does.
function home_of(file,    folder) {
  folder = file
  while (sub(/\/[^\/]*$/, "", folder)) {
    if (folder in known || folder in linking) return folder
  }
  return ""
}

# A folder may use itself, and what is below a folder that it may use.
function allowed(from, to, kind,    folder) {
  if (from == to) return 1
  folder = to
  do {
    if ((from, folder, "include") in rule || (from, folder, kind) in rule) return 1
  } while (sub(/\/[^\/]*$/, "", folder))
  return 0
}

function folder_of(path) {
  sub(/\/[^\/]*$/, "", path)
  return path
}

# The path that an include names, from the root of the tree.
function resolve(target, file,    folder) {
  if (target ~ /^rtapi\/[^\/]*\.h$/) return "rtapi/include/" target
  if (target ~ /^kaamos\/shader\//) return "runtime/shader/include/" target
  if (target !~ /^\.\.\//) return target
  folder = folder_of(file)
  while (sub(/^\.\.\//, "", target)) folder = folder_of(folder)
  return folder "/" target
}

function check_source(file,    line, number, target, from, to, pair) {
  from = layer_of(file)
  if (from == "") {
    print file ":1: " folder_of(file) " is not in layers.txt, nor is a folder above it"
    return
  }
  while ((getline line < file) > 0) {
    number++
    if (line !~ /^ *# *include [<"]/) continue
    target = line
    sub(/^ *# *include [<"]/, "", target)
    sub(/[>"].*/, "", target)
    target = resolve(target, file)
    to = layer_of(target)
    if (to == "") continue
    if (!allowed(from, to, "include")) print file ":" number ": " from " must not include " to
    pair = folder_of(file) SUBSEP folder_of(target)
    if (folder_of(file) != folder_of(target) && !(pair in arrow)) {
      arrow[pair] = file ":" number
      node[folder_of(file)]; node[folder_of(target)]
      reaches[pair]
    }
  }
  close(file)
}

# Prints the arrows between two folders that reach each other, each at its first include.
function check_circles(    a, b, c, pair, ends) {
  for (b in node) for (a in node) if ((a, b) in reaches) for (c in node) if ((b, c) in reaches) reaches[a, c]
  for (pair in arrow) {
    split(pair, ends, SUBSEP)
    if ((ends[2], ends[1]) in reaches)
      print arrow[pair] ": " ends[1] " includes " ends[2] ", which reaches it again"
  }
}

# What a README says its folder may include: "May include `a`, `b` and `c`.", up to the end of the sentence. Each
# is below the root, below or beside the folder, or a file in it. In runtime/ all are named that layers.txt allows the folder.
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
    if (to == "" && (folder "/" name) in known) to = folder "/" name
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
      home[name] = home_of(file)
      if (name ~ /_headers$/) home[name] = home[name] "/include"
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
  else linking[$1] = 1
  for (i = kind == "link" ? 3 : 2; i <= NF; i++) rule[$1, $i, kind] = 1
  next
}
/CMakeLists\.txt$/ { read_cmake($0); next }
/README\.md$/ { check_readme($0); next }
{ check_source($0) }
END {
  check_circles()
  for (i = 1; i <= links; i++) {
    from = home[link_from[i]]
    to = home[link_to[i]]
    if (from != "" && to != "" && !allowed(from, to, "link")) {
      print link_file[i] ":" link_line[i] ": " link_from[i] " of " from " must not link " link_to[i] " of " to
    }
  }
}

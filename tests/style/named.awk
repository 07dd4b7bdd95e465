# SPDX-License-Identifier: MIT
# Reads pages and looks up what they name in backticks outside code blocks: a file, as `folder/file.h` from
# the root or from the page's folder, and a function or member, as `name()` or `Type::name`, in one of the
# files that its line names. Prints what is not there as "page:line: why".

# What stands in a file, without its comments; empty where there is no such file.
function code_of(file,    line, code) {
  if (file in codes) return codes[file]
  while ((getline line < file) > 0) {
    sub(/\/\/.*/, "", line)
    code = code line "\n"
  }
  close(file)
  codes[file] = code
  return code
}

function resolve(path,    folder) {
  folder = FILENAME
  sub(/[^\/]*$/, "", folder)
  if (code_of(path) != "") return path
  return code_of(folder path) != "" ? folder path : ""
}

# Whether the code has every part of `name`; a function also has to be followed by its parentheses.
function has(code, name,    is_function, parts, count, i, after) {
  is_function = sub(/\(\)$/, "", name)
  count = split(name, parts, "::")
  for (i = 1; i <= count; i++) {
    after = is_function && i == count ? "(<[^;()]*>)?\\(" : "([^A-Za-z0-9_]|$)"
    if (code !~ ("(^|[^A-Za-z0-9_])" parts[i] after)) return 0
  }
  return 1
}

FNR == 1 { in_block = 0 }
/^```/ { in_block = !in_block; next }
in_block { next }
{
  count = split($0, piece, "`")
  files = 0
  for (i = 2; i < count; i += 2) {
    if (piece[i] !~ /^[A-Za-z0-9_.\/-]+\/[A-Za-z0-9_.-]+\.(cpp|h|inc|hlsl|hlsli|glsl|sh|txt|md)$/) continue
    found = resolve(piece[i])
    if (found == "") print FILENAME ":" FNR ": there is no " piece[i]
    file[++files] = found
  }
  for (i = 2; i < count; i += 2) {
    is_call = piece[i] ~ /^[A-Za-z_][A-Za-z0-9_:]*\(\)$/
    if (!is_call && piece[i] !~ /^[A-Z][A-Za-z0-9]*(::[A-Za-z0-9_]+)+$/) continue
    for (j = 1; j <= files; j++) {
      if (file[j] != "" && has(code_of(file[j]), piece[i])) break
    }
    if (j > files) print FILENAME ":" FNR ": no file that this line names has " piece[i]
  }
}

# SPDX-License-Identifier: MIT
# Manual pages of programs: what --help prints, between the headings that man expects.

# write_manual_page PROGRAM SUMMARY VERSION DATE: the page of a program, on standard output. It runs with
# LD_LIBRARY_PATH as it is.
write_manual_page() {
  local program=$1 summary=$2 version=$3 date=$4 name help
  name=${program##*/}
  help=$("$program" --help) || die "$name --help failed: $help"
  printf '.TH %s 1 %s "kaamos %s" "User Commands"\n' "${name^^}" "$date" "$version" | sed 's/-/\\-/g'
  printf '.SH NAME\n%s \\- %s\n.SH DESCRIPTION\n.nf\n' "${name//-/\\-}" "$summary"
  # roff takes a backslash for itself, a line that begins with a dot or quote for a request, and a hyphen
  # for something that nobody can search for or paste.
  sed -e 's/\\/\\e/g' -e 's/-/\\-/g' -e "s/^[.']/\\\\\&&/" <<<"$help"
  printf '.fi\n.SH SEE ALSO\n/usr/share/doc/kaamos\\-doc\n'
}

# write_manual_pages PROGRAMS PAGES LIST VERSION DATE: a page in the folder PAGES, compressed, for each program
# of the folder PROGRAMS. LIST says what each does.
write_manual_pages() {
  local programs=$1 pages=$2 list=$3 version=$4 date=$5 program name summary
  mkdir -p "$pages"
  for program in "$programs"/*; do
    name=${program##*/}
    summary=$(sed -n "s/^$name  *//p" "$list")
    [[ -n $summary ]] || die "\"$list\" has no line for $name."
    write_manual_page "$program" "$summary" "$version" "$date" | gzip -9n >"$pages/$name.1.gz"
  done
}

#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# study_test.sh NORTHLIGHT CHROMIUM: a small study goes on where it was stopped, and its report works in a
# browser: no script fails, every picture loads, and sliders, choices and plots answer.
set -uo pipefail
northlight=$1
browser=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0
fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

study=(--study lounge --quick --size 32x18 --repeats 1 --measure-reference 16 --measure-truth 4
  --gi-cell 2 --gi-bake-samples 1 --out "$work/out")
"$northlight" "${study[@]}" --families shadows,contact,ao > "$work/log" 2>&1 || fail "a study: $(cat "$work/log")"
for file in study.html study.csv study.json study-shadows.svg study-ao.svg study/ao-truth.png study-figure-18.csv; do
  [ -s "$work/out/$file" ] || fail "$file is missing"
done
grep -q 'Ambient occlusion within 4 m: .* settings are worth their time' "$work/log" || fail "no findings: $(cat "$work/log")"
head -1 "$work/out/study.csv" | grep -q '^family,technique,setting,ms' || fail "study.csv has other columns"
grep -q '^contact,screen-space contact shadows,' "$work/out/study.csv" || fail "study.csv lacks marches of contact shadows"
grep -q '<h2>The survey.s figure 18' "$work/out/study.html" || fail "the report lacks the survey's figure 18"
grep -q '^shadows,sun shadow,' "$work/out/study.csv" || fail "study.csv lacks the ray traced sun"
grep -q 'no reason is known' "$work/out/study.csv" && fail "settings without effect: $(grep 'no reason' "$work/out/study.csv")"
grep -q 'Measured on .* Command: northlight --study lounge --quick' "$work/out/study.html" || fail "the report does not say how it was made"
# A row's own command measures it alone.
command=$(grep '^shadows,sun shadow,4 rays' "$work/out/study.csv" | sed 's/.*,"northlight \(.*\)"$/\1/; s/""/"/g')
eval "\"\$northlight\" $command --out \"\$work/row\"" > "$work/log" 2>&1 || fail "the command of a row, $command: $(cat "$work/log")"
[ "$(grep -c '^shadows,' "$work/row/study.csv")" = 1 ] || fail "a row's command measured others: $(cat "$work/row/study.csv")"
same=$(cut -d, -f6 <(grep '^shadows,sun shadow,4 rays' "$work/out/study.csv") <(grep '^shadows,' "$work/row/study.csv") | uniq | wc -l)
[ "$same" = 1 ] || fail "a row measured alone has another error"
# What is there is not measured again.
cp "$work/out/study.csv" "$work/before.csv"
"$northlight" "${study[@]}" --families shadows,contact,ao > /dev/null 2>&1 || fail "the study again"
cmp -s "$work/before.csv" "$work/out/study.csv" || fail "families were measured again"
rm "$work/out/study/ao.json"
"$northlight" "${study[@]}" --families shadows,contact,ao > /dev/null 2>&1 || fail "the study with a family left"
diff <(grep ^shadows "$work/before.csv") <(grep ^shadows "$work/out/study.csv") > /dev/null || fail "shadows were measured again"
cmp -s "$work/before.csv" "$work/out/study.csv" && fail "the family that was missing was not measured"
"$northlight" --study lounge --scene runner > /dev/null 2> "$work/log" && fail "--study and --scene"
"$northlight" --quick > /dev/null 2>&1 && fail "--quick alone"
[ "$failures" = 0 ] || exit 1

[ -x "$browser" ] || {
  [ "${CI:-}" = true ] && { echo "FAILED: chromium is not installed (scripts/packages.txt)"; exit 1; }
  echo "skipped: chromium is not installed, so the report was not opened"
  exit 77
}
# Does what a reader does, and writes what happened into the page.
cat > "$work/probe.html" <<'END'
<script>
window.probed = [];
window.addEventListener("error", event => probed.push("error: " + event.message));
window.addEventListener("load", async () => {
  const check = (what, holds) => probed.push((holds ? "ok: " : "BAD: ") + what);
  for (const section of document.querySelectorAll("section")) {
    const id = section.id, images = [...section.querySelectorAll(".split img")];
    await Promise.all(images.map(image => image.decode().catch(() => {})));
    check(id + " pictures", images.length == 2 && images.every(image => image.naturalWidth > 0));
    for (const family of study.filter(each => each.family === id)) {
      const all = family.rows.flatMap(row => [row.picture, row.difference]).concat(family.truth_picture);
      const loads = await Promise.all(all.map(source => new Promise(done => {
        const image = new Image();
        image.onload = () => done(image.naturalWidth > 0);
        image.onerror = () => done(false);
        image.src = source;
      })));
      check(id + " all " + all.length + " pictures load", loads.every(Boolean));
    }
    const slider = section.querySelector("input[type=range]"), before = images[1].style.clipPath;
    slider.value = 20;
    slider.dispatchEvent(new Event("input"));
    check(id + " slider", images[1].style.clipPath !== before);
    const shown = images[1].src, marks = section.querySelectorAll("svg [data-key]");
    marks[marks.length - 1].dispatchEvent(new Event("click"));
    check(id + " click on a mark", images[1].src !== shown);
    marks[0].dispatchEvent(new MouseEvent("mousemove", {clientX: 5, clientY: 5}));
    check(id + " hover", document.querySelector(".tip").style.display === "block" &&
      section.querySelector("tr.lit") !== null);
    const wanted = section.querySelector("input.wanted");
    wanted.value = 1e9;
    wanted.dispatchEvent(new Event("input"));
    check(id + " advice", section.querySelector(".advice").textContent.startsWith("take "));
    wanted.value = 0;
    wanted.dispatchEvent(new Event("input"));
    check(id + " no advice", section.querySelector(".advice").textContent.startsWith("nothing"));
  }
  const out = document.createElement("pre");
  out.id = "probed";
  out.textContent = "\n" + probed.join("\n") + "\nend of probe\n";
  document.body.replaceChildren(out);
});
</script>
END
sed -e "/<\/head>/{
r $work/probe.html
}" "$work/out/study.html" > "$work/probed.html"
timeout 120 "$browser" --headless --no-sandbox --disable-gpu --user-data-dir="$work/profile" \
  --virtual-time-budget=20000 --dump-dom "file://$work/probed.html" > "$work/dom" 2> "$work/log"
grep -q '^end of probe' "$work/dom" || fail "the page's probe did not run: $(tail -3 "$work/log")"
grep -E '^(BAD|error): ' "$work/dom" && fail "the report"
[ "$(grep -c '^ok: ' "$work/dom")" = 28 ] || fail "not all was probed: $(grep '^ok: ' "$work/dom")"
[ "$failures" = 0 ]

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

study=(--study matched-box --quick --size 32x18 --repeats 1 --measure-reference 16 --measure-truth 4
  --gi-cell 2 --gi-bake-samples 1 --out "$work/out")
"$northlight" "${study[@]}" --families contact,ao > "$work/log" 2>&1 || fail "a study: $(cat "$work/log")"
for file in study.html study.csv study.json study-contact.svg study-ao.svg study/ao-truth.png; do
  [ -s "$work/out/$file" ] || fail "$file is missing"
done
grep -q 'Ambient occlusion within 4 m: .* settings are worth their time' "$work/log" || fail "no findings: $(cat "$work/log")"
head -1 "$work/out/study.csv" | grep -q '^family,technique,setting,ms' || fail "study.csv has other columns"
grep -q '^contact,screen-space contact shadows,' "$work/out/study.csv" || fail "study.csv lacks marches of contact shadows"
grep -q 'no reason is known' "$work/out/study.csv" && fail "settings without effect: $(grep 'no reason' "$work/out/study.csv")"
grep -q 'Measured on .* Command: northlight --study matched-box --quick' "$work/out/study.html" || fail "the report does not say how it was made"
# A row's own command measures it alone.
command=$(grep '^ao,ambient occlusion,4 rays' "$work/out/study.csv" | sed 's/.*,"northlight \(.*\)"$/\1/; s/""/"/g')
eval "\"\$northlight\" $command --out \"\$work/row\"" > "$work/log" 2>&1 || fail "the command of a row, $command: $(cat "$work/log")"
[ "$(grep -c '^ao,' "$work/row/study.csv")" = 1 ] || fail "a row's command measured others: $(cat "$work/row/study.csv")"
same=$(cut -d, -f6 <(grep '^ao,ambient occlusion,4 rays' "$work/out/study.csv") <(grep '^ao,' "$work/row/study.csv") | uniq | wc -l)
[ "$same" = 1 ] || fail "a row measured alone has another error"
# The survey's figure 18. A scene without a sun says so in each row, and --sun gives it one.
figure_18=(--rows 'sun-map/2048 x 2048' --rows 'sun/1 ray' --rows 'adaptive-sun/5 rays at most'
  --rows 'adaptive-sun/8 rays at most')
for scene in lounge pub; do
  "$northlight" --study $scene --quick --size 16x9 --repeats 1 --measure-truth 2 --families shadows \
    "${figure_18[@]}" --out "$work/$scene" > "$work/log" 2>&1 || fail "$scene: $(cat "$work/log")"
  grep -q '<h2>The survey.s figure 18' "$work/$scene/study.html" || fail "the report lacks the survey's figure 18"
done
[ -s "$work/lounge/study-shadows.svg" ] || fail "study-shadows.svg is missing"
grep -q 'not measured' "$work/lounge/study-figure-18.csv" && fail "figure 18: $(cat "$work/lounge/study-figure-18.csv")"
[ "$(grep -c 'not measured: the scene has no sun' "$work/pub/study-figure-18.csv")" = 4 ] \
  || fail "figure 18 without a sun: $(cat "$work/pub/study-figure-18.csv")"
"$northlight" --study pub --sun 30,50 --quick --size 16x9 --repeats 1 --measure-truth 2 --families shadows \
  "${figure_18[@]}" --out "$work/pub" > "$work/log" 2>&1 || fail "pub with a sun: $(cat "$work/log")"
grep -q 'not measured' "$work/pub/study-figure-18.csv" && fail "figure 18 with a sun: $(cat "$work/pub/study-figure-18.csv")"
# Four lights, over both G-buffers; a scene without a sun says so.
figure_18=(--quick --size 16x9 --repeats 1 --measure-truth 2 --families figure-18)
"$northlight" --study pub --sun 30,50 "${figure_18[@]}" --out "$work/four" > "$work/log" 2>&1 || fail "four lights: $(cat "$work/log")"
[ "$(wc -l < "$work/four/study-figure-18-lights.csv")" = 8 ] || fail "figure 18: $(cat "$work/four/study-figure-18-lights.csv")"
grep -q '^PCSS,.*,-,-,' "$work/four/study-figure-18-lights.csv" || fail "figure 18: $(cat "$work/four/study-figure-18-lights.csv")"
grep -q 'not measured' "$work/four/study-figure-18-lights.csv" && fail "figure 18: $(cat "$work/four/study-figure-18-lights.csv")"
"$northlight" --study pub "${figure_18[@]}" --out "$work/dark" > "$work/log" 2>&1 || fail "four lights without a sun: $(cat "$work/log")"
grep -q 'Not measured: the scene has no sun' "$work/dark/study.html" || fail "four lights without a sun"
# What is there is not measured again.
cp "$work/out/study.csv" "$work/before.csv"
"$northlight" "${study[@]}" --families contact,ao > /dev/null 2>&1 || fail "the study again"
cmp -s "$work/before.csv" "$work/out/study.csv" || fail "families were measured again"
rm "$work/out/study/ao.json"
"$northlight" "${study[@]}" --families contact,ao > /dev/null 2>&1 || fail "the study with a family left"
diff <(grep ^contact "$work/before.csv") <(grep ^contact "$work/out/study.csv") > /dev/null || fail "contact shadows were measured again"
cmp -s "$work/before.csv" "$work/out/study.csv" && fail "the family that was missing was not measured"
"$northlight" --study lounge --scene runner > /dev/null 2> "$work/log" && fail "--study and --scene"
"$northlight" --quick > /dev/null 2> "$work/log" && fail "--quick alone"
grep -q 'quick requires --study or --measure' "$work/log" || fail "--quick alone: $(cat "$work/log")"
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
    await Promise.all(images.filter(image => !image.complete).map(image => new Promise(done => {
      image.onload = image.onerror = done;
    })));
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
# Headless Chromium has printed the page before its probe was through, on a machine with much to do: a page without
# a result is asked again.
for attempt in 1 2 3; do
  timeout 120 "$browser" --headless --no-sandbox --disable-gpu --user-data-dir="$work/profile-$attempt" \
    --virtual-time-budget=20000 --dump-dom "file://$work/probed.html" > "$work/dom" 2> "$work/log"
  status=$?
  grep -q '^end of probe' "$work/dom" && break
done
grep -q '^end of probe' "$work/dom" \
  || fail "the page's probe did not run: exit $status, $(wc -c < "$work/dom") bytes of page, $(tail -3 "$work/log")"
grep -E '^(BAD|error): ' "$work/dom" && fail "the report"
[ "$(grep -c '^ok: ' "$work/dom")" = 21 ] || fail "not all was probed: $(grep '^ok: ' "$work/dom")"
[ "$failures" = 0 ]

// SPDX-License-Identifier: MIT
#include "effects/measure/study/page.h"

namespace kaamos::measure {

const char* const kPageStyle = R"css(
body { font: 15px/1.45 sans-serif; max-width: 1100px; margin: 2em auto; padding: 0 1em; color: #222; }
h1 { font-size: 24px; } h2 { font-size: 19px; margin-top: 2em; border-top: 1px solid #ccc; padding-top: 1em; }
table { border-collapse: collapse; font-size: 13px; } td, th { padding: 2px 9px; text-align: right; }
td:first-child, td:nth-child(2), th:first-child, th:nth-child(2) { text-align: left; }
thead th { border-bottom: 1px solid #888; } tbody tr:hover, tr.lit { background: #fff3c4; }
tr.front td:first-child::before { content: "\25CF "; color: #0072b2; }
figure { margin: 1em 0; } figcaption { color: #555; font-size: 13px; }
svg { max-width: 100%; height: auto; } [data-key] { cursor: pointer; } [data-key].lit { stroke: #000; stroke-width: 3; }
.tip { position: fixed; background: #222; color: #fff; padding: 3px 8px; font-size: 12px; border-radius: 3px; pointer-events: none; display: none; }
.split { position: relative; width: 720px; max-width: 100%; line-height: 0; }
.split img { width: 100%; image-rendering: pixelated; } .split img + img { position: absolute; left: 0; top: 0; }
.split .line { position: absolute; top: 0; bottom: 0; width: 1px; background: #fff; }
.controls { margin: .4em 0; } input[type=range] { width: 720px; max-width: 100%; margin: 0; }
)css";

const char* const kPageScript = R"js(
"use strict";
const tip = document.createElement("div");
tip.className = "tip";
document.body.append(tip);

function number(value) { return Number(value).toPrecision(3); }

// The marks of a plot and the rows of its table belong together; a click shows the picture.
function connect(family, section) {
  const rows = section.querySelectorAll("tbody.settings tr");
  const marks = section.querySelectorAll("svg [data-key]");
  const of = key => [...marks].filter(mark => mark.dataset.key === key);
  const light = (key, on) => {
    rows[key].classList.toggle("lit", on);
    for (const mark of of(key)) mark.classList.toggle("lit", on);
  };
  rows.forEach((row, i) => {
    row.addEventListener("mouseenter", () => light(String(i), true));
    row.addEventListener("mouseleave", () => light(String(i), false));
    row.addEventListener("click", () => show(section, i));
  });
  for (const mark of marks) {
    const key = mark.dataset.key, row = family.rows[key];
    mark.addEventListener("mousemove", event => {
      tip.textContent = `${row.technique}, ${row.setting}: ${number(row.ms)} ms, error ${number(row.rmse)}`;
      tip.style.display = "block";
      tip.style.left = event.clientX + 12 + "px";
      tip.style.top = event.clientY + 12 + "px";
      light(key, true);
    });
    mark.addEventListener("mouseleave", () => { tip.style.display = "none"; light(key, false); });
    mark.addEventListener("click", () => show(section, Number(key)));
  }
}

function show(section, row) {
  const left = section.querySelector("select.left");
  left.value = String(row);
  left.dispatchEvent(new Event("change"));
}

// Two pictures, of which the slider shows one to the left of it and the other to the right.
function split(family, section) {
  const box = section.querySelector(".split");
  if (!box) return;
  const [under, over] = box.querySelectorAll("img"), line = box.querySelector(".line");
  const slider = section.querySelector("input[type=range]");
  const [left, right] = [section.querySelector("select.left"), section.querySelector("select.right")];
  const source = value => value === "truth" ? family.truth_picture : value.startsWith("d")
    ? family.rows[value.slice(1)].difference : family.rows[value].picture;
  const draw = () => {
    over.src = source(left.value);
    under.src = source(right.value);
    over.style.clipPath = `inset(0 ${100 - slider.value}% 0 0)`;
    line.style.left = slider.value + "%";
  };
  for (const element of [slider, left, right]) element.addEventListener("input", draw);
  for (const element of [left, right]) element.addEventListener("change", draw);
  draw();
}

// For an error below X take Y.
function advise(family, section) {
  const input = section.querySelector("input.wanted"), out = section.querySelector(".advice");
  const tell = () => {
    const wanted = Number(input.value);
    const fit = family.rows.filter(row => row.rmse <= wanted).sort((a, b) => a.ms - b.ms)[0];
    out.textContent = fit ? `take ${fit.technique}, ${fit.setting} (${number(fit.ms)} ms, error ${number(fit.rmse)})`
      : "nothing measured here is as good";
  };
  input.addEventListener("input", tell);
  tell();
}

for (const family of study.filter(each => each.rows.some(row => row.missing === ""))) {
  const section = document.getElementById(family.family);
  connect(family, section);
  split(family, section);
  advise(family, section);
}
)js";

}  // namespace kaamos::measure

#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# northlight_test.sh NORTHLIGHT SOURCE_FOLDER [SECONDS]: what northlight says when something is
# wrong, that earlier results survive, and --watch. SECONDS: when the run is interrupted.
set -u
northlight=$1
source_folder=$2
interrupt_after=${3:-2}  # rendering has surely begun by then
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export KAAMOS_CACHE_DIR=$work/cache
failures=0

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

# expect_error EXIT_CODE PATTERN arguments...: exits with that code and prints something that
# matches.
expect_error() {
  local code=$1 pattern=$2 output status
  shift 2
  output=$("$northlight" --out "$work/out" "$@" 2>&1)
  status=$?
  [ "$status" = "$code" ] || fail "$*: exit code $status, expected $code"
  grep -Eq -- "$pattern" <<< "$output" || fail "$*: does not say $pattern but: $output"
}

expect_error 1 'cannot open .*nothere.gltf' --scene nothere.gltf
printf 'no scene' > "$work/broken.glb"
expect_error 1 'broken.glb.*neither' --scene "$work/broken.glb"
head -c 200 "$northlight" > "$work/binary.gltf"
expect_error 1 'binary.gltf' --scene "$work/binary.gltf"
expect_error 2 'is not a size' --size 0x9
expect_error 2 'is not an effect' --effects ao,fog
expect_error 2 'ao-samples is 0; choose 1 to 65536 rays' --ao-samples 0
expect_error 2 'is not a radius' --ao-radius far
expect_error 2 'not in range' --sun-angle 400
expect_error 2 'no place of the sun: give degrees' --sun 30
expect_error 2 'not in range' --denoise-passes 9
expect_error 2 'not expected' --no-such-option
expect_error 2 '--probes: .*found,camera' --probes everywhere
expect_error 2 'is not a pixel' --pixel 12
expect_error 2 'outside the picture' --size 64x36 --pixel 64,3
expect_error 2 '--measure: fog not in .*svgf' --measure fog
expect_error 2 '--measure: local not in .*ssr' --measure local
expect_error 1 'no local light to measure' --measure screen-contact --scene terrain --size 8x8
expect_error 2 'not in range' --measure ao --repeats 0
expect_error 2 'not in range' --measure svgf --seeds 1
expect_error 2 '--split: fog not in' --split fog
expect_error 2 '"fog" is no layer: there are depth, .*normal, .*ao, ao_denoised, .*gtao, .*all and none' --layers ao,fog
expect_error 1 'KA3046 .*no layer "gtao" but depth, .*, ao, sun, radiance' --effects ao,sun --layers normal,gtao --size 16x9
expect_error 1 'KA3046 .*no layer "ao_denoised" but' --effects ao,sun --layers ao_denoised --size 16x9
expect_error 1 'no pixel shows glass.*--material' --measure transparent --scene lounge --size 8x8 --gi-cell 2 --gi-bake-samples 1
expect_error 1 'unknown backend.*embree' --backend nothing
expect_error 2 'not in range 1 to 100000' --frames 0
expect_error 2 'camera-path requires --frames' --camera-path orbit
expect_error 2 'taa requires --frames' --taa
expect_error 2 'exclude each other' --frames 2 --watch
# More local lights than there are shadow maps: that is a failure, not an interruption.
{
  printf '{"asset":{"version":"2.0"},"extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point"}]}},'
  printf '"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAAAAAIA/"}],'
  printf '"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],'
  printf '"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}'
  for _ in $(seq 4097); do printf ',{"extensions":{"KHR_lights_punctual":{"light":0}}}'; done
  printf ']}'
} > "$work/lights.gltf"
expect_error 1 '4097 local lights' --scene "$work/lights.gltf" --effects local --size 16x9
printf '{"asset":{"version":"2.0"},"buffers":[{"uri":"/","byteLength":9}]}' > "$work/folder.gltf"
expect_error 1 'folder.gltf.*cannot read' --scene "$work/folder.gltf"
expect_error 1 'no camera path "roundabout".*still, dolly, orbit' --frames 2 --size 16x9 --camera-path roundabout
printf '0 0 1 5 0 1 0\n1 0 1 x 0 1 0\n' > "$work/path"
expect_error 1 'path:2: "x" is not a number' --scene runner --frames 2 --size 16x9 --camera-path "$work/path"
expect_error 2 'surfaces-order is "length"; choose pixels, direction, origin or termination' --sort-rays length
expect_error 2 'surfaces-primary is "points"; choose rays or raster' --primary points
expect_error 2 'exclude each other' --sort-rays origin --explain 3,4 --size 16x9
expect_error 2 'explain 64,3 is outside the picture' --size 64x36 --explain 64,3
expect_error 2 'tables and --explain exclude each other' --tables --explain 3,4 --size 16x9
expect_error 2 'pixel and --heatmap exclude each other' --pixel 3,4 --heatmap rays --size 16x9
expect_error 2 'overdraw counts .*add --primary raster' --heatmap overdraw --size 16x9
expect_error 2 'json requires --explain' --json --size 16x9
expect_error 2 'reference-path-traced and --frames exclude each other' --reference-path-traced 4 --frames 2
expect_error 2 'reference-path-traced and --explain exclude each other' --reference-path-traced 4 --explain 3,4 --size 16x9
expect_error 2 'bounces requires --reference-path-traced' --bounces 2
expect_error 2 'not in range' --reference-path-traced 1
expect_error 1 'measure frame needs a truth' --measure frame --measure-truth 0

# Settings: by option, by --set, from a file; what is wrong with each.
expect_error 2 'gtao-slices is 0; choose 1 to 1024' --gtao-slices 0
expect_error 2 'nearest option is --gtao-slices' --gtao-slcies 3
expect_error 2 'no setting "gtao-slcies"; the nearest is "gtao-slices"' --set gtao-slcies=3
expect_error 2 'give NAME=VALUE' --set gtao-slices
expect_error 2 'gtao-slices has no value; choose 1 to 1024' --gtao-slices
printf '{"gtao": {"slcies": 3}}' > "$work/settings.json"
expect_error 2 'settings.json: there is no setting "gtao.slcies"; the nearest is "gtao.slices"' --settings "$work/settings.json"
printf '{"gtao": {"slices": 5, "steps": 6, "radius": 1}, "denoise": {"method": "control"}}' > "$work/settings.json"
"$northlight" --settings "$work/settings.json" --gtao-steps 7 --set gtao-radius=2 --denoise-alpha 0.5 --print-settings > "$work/printed.json" || fail "--print-settings"
for line in '"slices": 5' '"steps": 7' '"radius": 2.0' '"method": "control"' '"alpha": 0.5' '"sigma-pixels": 24.0'; do
  grep -qF -- "$line" "$work/printed.json" || fail "--print-settings has no $line"
done
"$northlight" --settings "$work/printed.json" --print-settings | cmp -s - "$work/printed.json" || fail "printed settings do not read as they are"
"$northlight" --ao-radius inf --denoise-passes 2 --sun-at-hits map --fireflies keep --half-resolution ao --glass-layers 3 --print-settings > "$work/printed.json"
for line in '"radius": "inf"' '"first-passes": 2' '"sun-map": 2048' '"fireflies": "keep"' '"half-resolution": true' '"sorted-layers": 3'; do
  grep -qF -- "$line" "$work/printed.json" || fail "short options do not set $line"
done
help=$("$northlight" --help) || fail "--help"
[ "$(wc -l <<< "$help")" -lt 100 ] || fail "--help is longer than what most people need"
grep -q -- '--gtao-slices' <<< "$help" && fail "--help shows every setting"
"$northlight" --help=gtao | grep -q -- '--gtao-slices (3)' || fail "--help=gtao"
"$northlight" --help=effects | grep -q "sun-pcss .*in the place of sun" || fail "--help=effects"
"$northlight" --help measuring | grep -q -- '--study' || fail "--help measuring"
"$northlight" --help=all | grep -q -- '--sun-pcss-blocker-taps' || fail "--help=all"
expect_error 2 'no topic "gtoa"; the nearest is "gtao"' --help=gtoa

# Techniques by what was measured: a study with two settings of the sun's shadow.
row='"command":"","missing":"","note":"","ms_spread":0,"flip":0,"ssim":1,"energy":1,"flicker":-1,"also":[],"picture":"","difference":""'
printf '[{"family":"shadows","title":"","key":"","scene":"lounge","backend":"embree","width":64,"height":36,"subtitle":"","signal":"","truth":"","truth_picture":"","truth_rmse":0,"about":[],"rows":[{"effect":"sun","technique":"sun shadow","setting":"4 rays",%s,"ms":8,"rays":4,"rmse":0.01},{"effect":"sun-map","technique":"sun shadow by a depth map","setting":"1024 x 1024",%s,"ms":2,"rays":0,"rmse":0.2}]}]' "$row" "$row" > "$work/fronts.json"
chosen=(--effects sun --size 64x36 --out "$work/chosen" --fronts "$work/fronts.json")
said=$("$northlight" "${chosen[@]}" --quality low 2>&1) || fail "--quality low: $said"
grep -q 'shadows: sun shadow by a depth map, 1024 x 1024 .*: 2 ms, error 0.2: the fastest of 1 without rays' <<< "$said" || fail "--quality low: $said"
[ -s "$work/chosen/sun_map.png" ] || fail "--quality low renders no sun-map"
said=$("$northlight" "${chosen[@]}" --quality ultra 2>&1) || fail "--quality ultra: $said"
grep -q 'shadows: sun shadow, 4 rays .*: 8 ms, error 0.01: the least error of 2 settings' <<< "$said" || fail "--quality ultra: $said"
said=$("$northlight" "${chosen[@]}" --budget 5ms 2>&1) || fail "--budget: $said"
grep -q 'shadows: sun shadow by a depth map, .*within the budget' <<< "$said" || fail "--budget 5ms: $said"
expect_error 2 '"soon" is no time: give milliseconds' --budget soon
expect_error 2 'fronts requires --quality or --budget' --fronts "$work/fronts.json"
expect_error 2 'quality and --measure exclude each other' --quality low --measure ao
expect_error 2 'low,medium,high,ultra' --quality best
said=$("$northlight" --scene mirror-hall --quality low --size 64x36 --out "$work/tree" 2>&1) || fail "--quality low of the tree's fronts: $said"
grep -q 'chosen from .*study/fronts/mirror-hall.json' <<< "$said" || fail "--quality low measures what the tree has: $said"
grep -q 'lamps: .*--effects' <<< "$said" || fail "--quality low chooses no shadows of lamps: $said"
grep -q 'denoise: .*--denoise' <<< "$said" || fail "--quality low chooses no denoiser: $said"
expect_error 1 'no study.json of this version' --quality low --size 64x36 --fronts "$work/settings.json"

touch "$work/file"
said=$("$northlight" --out "$work/file/below" --size 16x9 2>&1) && fail "an output folder below a file"
grep -q 'cannot make the folder' <<< "$said" || fail "an output folder below a file: $said"

devices=$("$northlight" --list-devices) || fail "--list-devices"
grep -q '^embree   .*Embree' <<< "$devices" || fail "--list-devices does not name Embree: $devices"
grep -q '^vulkan   ' <<< "$devices" || fail "--list-devices says nothing of Vulkan: $devices"
pixel=$("$northlight" --size 64x36 --out "$work/none" --pixel 32,18) || fail "--pixel"
grep -Eq '^ao +[0-9.]+$' <<< "$pixel" || fail "--pixel does not show ao: $pixel"
[ ! -e "$work/none" ] || fail "--pixel wrote files"

# Scenes without alpha-tested geometry run their rays eight at a time, which is explained too.
for scene in lounge glass-stack; do
  said=$("$northlight" --scene $scene --size 64x36 --effects ao --explain 32,18) || fail "--explain in $scene"
  grep -q 'TraceRay\|ray 0\|hit' <<< "$said" || fail "--explain in $scene shows no rays: $said"
  grep -q 'ended:' <<< "$said" && fail "--explain in $scene: $said"
done

# A complete run, then one that fails and one that is interrupted: the results stay.
small=(--size 64x36 --out "$work/out")
"$northlight" "${small[@]}" > /dev/null || fail "a plain run"
for file in frame.png frame.exr ao.png sun.png stats.json; do
  [ -s "$work/out/$file" ] || fail "$file is missing"
done

# files_are FOLDER NAMES...: the folder holds exactly these.
files_are() {
  local folder=$1 found
  shift
  found=$(ls "$folder")
  [ "$found" = "$(printf '%s\n' "$@" | LC_ALL=C sort)" ] || fail "$folder holds" $found
}
export LC_ALL=C
# Layers are those that somebody names; else the signals of effects that are named.
"$northlight" --size 64x36 --out "$work/default" > /dev/null || fail "the default layers"
files_are "$work/default" ao.png frame.exr frame.png stats.json sun.png
"$northlight" --size 64x36 --layers normal,sun --out "$work/named" > "$work/log" || fail "--layers normal,sun"
files_are "$work/named" frame.exr frame.png normal.png stats.json sun.png
grep -q '^wrote .*/frame.png, frame.exr, stats.json, normal.png, sun.png; --layers all' "$work/log" || fail "does not say what is written: $(cat "$work/log")"
"$northlight" --size 64x36 --layers none --out "$work/bare" > /dev/null || fail "--layers none"
files_are "$work/bare" frame.exr frame.png stats.json
"$northlight" --size 64x36 --layers all --out "$work/every" > /dev/null || fail "--layers all"
files_are "$work/every" ao.png base_color.png depth.png emissive.png frame.exr frame.png ids.png material.png normal.png \
  position.png shading_normal.png stats.json sun.png view_z.png
for file in frame.png normal.png sun.png; do
  cmp -s "$work/named/$file" "$work/every/$file" || fail "--layers changes $file"
done
"$northlight" --size 32x18 --effects local --layers none --frames 2 --out "$work/bare" > /dev/null || fail "--layers none --frames 2"
files_are "$work/bare" frame.exr frame.png frame_0000.png frame_0001.png stats.json

# --profile: the steps of all parts together take as long as the run, which takes no longer than
# this program waits.
start=$(date +%s%N)
"$northlight" --size 64x36 --profile --out "$work/named" > "$work/log" || fail "--profile"
waited=$((($(date +%s%N) - start) / 1000000))
for step in scene 'bottom levels' 'shader libraries' G-buffer 'sun shadow' 'read back' 'encode and write' other; do
  grep -Eq "^  $step +[0-9]+ +[0-9.]+ +[0-9.]+ +[0-9.]+ %$" "$work/log" || fail "--profile has no $step: $(cat "$work/log")"
done
sed -n '/^profile /,$p' "$work/log" | awk -v waited="$waited" '
  { wall = $(NF - 3); cpu = $(NF - 2) }
  /^  / { steps += wall; steps_cpu += cpu; next }
  /^total / { total = wall; total_cpu = cpu; next }
  /^(start-up|frame|files|rest) / { parts += wall }
  function near(a, b) { return a - b < 0.03 * b + 1 && b - a < 0.03 * b + 1 }
  END { exit !(total > 0 && near(steps, total) && near(parts, total) && near(steps_cpu, total_cpu) && total <= waited) }' ||
  fail "--profile does not add up, or is longer than the $waited ms that it took: $(cat "$work/log")"

# Drawn surfaces: the same picture but for pixels at edges, and what both ways took.
"$northlight" --size 64x36 --primary raster --out "$work/drawn" > "$work/log" || fail "--primary raster"
grep -Eq '^G-buffer resolve ' "$work/log" || fail "--primary raster's table lacks passes: $(cat "$work/log")"
grep -Eq 'covered pixels show another triangle than rays hit' "$work/log" || fail "--primary raster says no difference: $(cat "$work/log")"
grep -q '"ray_ms"' "$work/drawn/stats.json" || fail "stats.json has no times of both: $(cat "$work/drawn/stats.json")"

"$northlight" --size 64x36 --primary raster --heatmap overdraw --out "$work/drawn" > "$work/log" || fail "--heatmap overdraw"
grep -Eq 'heatmap-overdraw.png.*the most is [1-9]' "$work/log" || fail "--heatmap overdraw counts nothing: $(cat "$work/log")"

# The whole frame. Its volume of indirect light is saved, read again, and refused when damaged.
whole=(--effects all --size 64x36 --gi-bake-samples 1 --gi-cell 1 --gi-volume "$work/lounge.gi")
"$northlight" "${whole[@]}" --out "$work/bare_whole" > /dev/null || fail "the whole frame"
files_are "$work/bare_whole" frame.exr frame.png stats.json
"$northlight" "${whole[@]}" --layers all --out "$work/whole" > "$work/log" || fail "the whole frame"
grep -Eq '^denoise [0-9] signals' "$work/log" || fail "the whole frame's table lacks passes: $(cat "$work/log")"
for file in frame.png reflection.png indirect_denoised.png local_lights.png contact.png; do
  [ -s "$work/whole/$file" ] || fail "the whole frame's $file is missing"
done
cmp -s "$work/whole/frame.png" "$work/bare_whole/frame.png" || fail "the kept volume gives another picture"
for threads in 1 4; do
  "$northlight" "${whole[@]}" --layers all --threads $threads --out "$work/again" > /dev/null || fail "the whole frame on $threads threads"
  for file in "$work/whole"/*.png "$work/whole/frame.exr"; do
    cmp -s "$file" "$work/again/${file##*/}" || fail "${file##*/} of the whole frame depends on the threads"
  done
done
echo damage >> "$work/lounge.gi"
expect_error 1 'KA3045 .*lounge.gi.*bake it again' "${whole[@]}"

# A sequence: the same on any number of threads, a line for each frame, and no frames of a longer
# one left.
moving=(--scene runner --effects all --taa --gi-bake-samples 1 --gi-cell 2 --size 64x36)
"$northlight" "${moving[@]}" --frames 4 --threads 1 --out "$work/one" > "$work/log" || fail "a sequence: $(cat "$work/log")"
grep -q '^frame .*[0-9] .*[0-9]$' <<< "$(grep -A9 '^flicker' "$work/log")" || fail "no flicker: $(cat "$work/log")"
grep -Eq '^structures: .* updated, .* rebuilt' "$work/log" || fail "no structures: $(cat "$work/log")"
"$northlight" "${moving[@]}" --frames 4 --threads 3 --out "$work/three" > /dev/null || fail "a sequence on 3 threads"
for i in 0 1 2 3; do
  cmp -s "$work/one/frame_000$i.png" "$work/three/frame_000$i.png" || fail "frame $i depends on the threads"
done
cmp -s "$work/one/frame.png" "$work/one/frame_0003.png" || fail "frame.png is not the last frame"
cmp -s "$work/one/frame_0000.png" "$work/one/frame_0003.png" && fail "nothing moves"
[ "$(grep -c '"frame":' "$work/one/stats.json")" -ge 4 ] || fail "stats.json lacks frames: $(cat "$work/one/stats.json")"
"$northlight" "${moving[@]}" --frames 2 --out "$work/one" > /dev/null || fail "a shorter sequence"
[ ! -e "$work/one/frame_0002.png" ] || fail "a frame of the longer sequence is left"
cmp -s "$work/one/frame_0001.png" "$work/three/frame_0001.png" || fail "frame 1 depends on how many follow"
printf '0 0 1 5 0 1 0\n0.02 0 2 5 0 1 0 cut\n' > "$work/path"
"$northlight" --scene runner --size 32x18 --frames 3 --camera-path "$work/path" --out "$work/cut" > /dev/null || fail "a path's file"
grep -q '"cut": true' "$work/cut/stats.json" || fail "no cut: $(cat "$work/cut/stats.json")"

# What stands still is the same wherever the camera came from: lights and the volume move along with
# it.
printf '0 -5.5 1.7 4.6 0.3 1.3 -0.8\n0.02 3 1.5 3 0 1 0 cut\n' > "$work/two"
printf '0 3 1.5 3 0 1 0\n' > "$work/one_key"
steady=(--effects gi,local --gi-mode direct --denoise none --gi-cell 1 --gi-bake-samples 1 --size 64x36 --layers all --gi-volume "$work/steady.gi")
"$northlight" "${steady[@]}" --frames 2 --camera-path "$work/two" --out "$work/moved" > /dev/null || fail "a cut"
"$northlight" "${steady[@]}" --frames 1 --camera-path "$work/one_key" --out "$work/there" > /dev/null || fail "one frame"
cmp -s "$work/moved/frame.exr" "$work/there/frame.exr" || fail "a frame behind a cut is not the frame there"

# The order of rays and meshes in pieces do not change the picture.
"$northlight" --size 96x54 --out "$work/plain" > "$work/log" || fail "a plain frame"
grep -q 'left out: skinning' "$work/log" || fail "does not say what was left out: $(cat "$work/log")"
"$northlight" --size 96x54 --sort-rays direction --out "$work/sorted" > "$work/log" || fail "--sort-rays"
grep -q 'ambient occlusion order' "$work/log" || fail "--sort-rays: no line for the sort"
cmp -s "$work/plain/frame.png" "$work/sorted/frame.png" || fail "--sort-rays changes the picture"
"$northlight" --size 96x54 --pieces 4096 --out "$work/pieces" > /dev/null 2> "$work/log" || fail "--pieces"
grep -q 'meshes split' "$work/log" || fail "--pieces: says nothing"
cmp -s "$work/plain/frame.png" "$work/pieces/frame.png" || fail "--pieces changes the picture"
said=$("$northlight" --size 32x18 --effects ao,transparent --gi-bake-samples 1 --measure-left-out) || fail "--measure-left-out"
grep -q '^glass ' <<< "$said" || fail "--measure-left-out: $said"

# What the sources say in numbers has a measured one beside it; on the CPU alone, which takes a second.
VK_LOADER_DRIVERS_DISABLE='*' "$northlight" --claims --scene glass-stack --size 32x16 --repeats 1 --gi-cell 2 --gi-bake-samples 1 \
  --out "$work/claims" > "$work/log" 2>&1 || fail "--claims: $(cat "$work/log")"
for row in 'sun shadow, 2 | 0.9 | 0.434, 0.217' 'contact shadows and denoising, 2 | 1.4 | 0.675, 0.338' 'reflections and denoising, 1 | 4.4 | 2.12, 2.12'; do
  grep -Eq "^\| ${row//|/\\|} \| [0-9.e+]+ \| [0-9.e+]+, [0-9.e+]+ \| [0-9.e+]+ \|$" "$work/claims/claims.md" || fail "--claims: no numbers beside \"$row\""
done

before=$(cd "$work/out" && find . -type f -exec sha256sum {} + | sort | sha256sum)
"$northlight" "${small[@]}" --scene nothere.gltf > /dev/null 2>&1
timeout --preserve-status -s INT "$interrupt_after" "$northlight" --out "$work/out" --ao-samples 65536 > /dev/null 2> "$work/log"
[ $? = 130 ] || fail "Ctrl-C: exit code is not 130"
grep -q 'interrupted: nothing was written' "$work/log" || fail "Ctrl-C: $(cat "$work/log")"
timeout --preserve-status -s INT "$interrupt_after" "$northlight" --out "$work/out" --size 320x180 --frames 5000 > /dev/null 2>&1
[ $? = 130 ] || fail "Ctrl-C in a sequence: exit code is not 130"
[ "$before" = "$(cd "$work/out" && find . -type f -exec sha256sum {} + | sort | sha256sum)" ] || fail "earlier results changed"
[ -z "$(find "$work/out" -name '.*' -type d -mindepth 1)" ] || fail "a working folder was left over"

# A reference that is interrupted keeps what it has; it goes on to the same bits, and only where it
# fits.
path=(--scene mirror-hall --size 64x36)
for later in 1 4 16; do  # the first samples are there
  timeout --preserve-status -s INT $((interrupt_after * later)) "$northlight" "${path[@]}" --out "$work/out" --reference-path-traced 1000000 > /dev/null 2> "$work/log"
  [ $? = 130 ] || fail "Ctrl-C in a reference: exit code is not 130"
  [ -s "$work/out/reference.sums" ] && break
done
grep -Eq 'stopped at [0-9]+ of 1000000 samples; .*--resume' "$work/log" || fail "Ctrl-C in a reference: $(cat "$work/log")"
done_so_far=$(sed -n 's/.*stopped at \([0-9]*\) of.*/\1/p' "$work/log")
wanted=$((done_so_far + 32 - done_so_far % 32))
"$northlight" "${path[@]}" --out "$work/out" --reference-path-traced "$wanted" --resume > "$work/log" || fail "--resume: $(cat "$work/log")"
grep -q "^$wanted samples a pixel" "$work/log" || fail "--resume: $(cat "$work/log")"
for file in reference.exr reference.sums reference_radiance.png reference_indirect.png; do
  [ -s "$work/out/$file" ] || fail "the reference's $file is missing"
done
"$northlight" "${path[@]}" --out "$work/reference2" --reference-path-traced "$wanted" --threads 1 > /dev/null || fail "a reference on one thread"
cmp -s "$work/out/reference.exr" "$work/reference2/reference.exr" || fail "a resumed reference differs from one that was not stopped"
expect_error 1 'KA3048 .*its seed is 0, not 3' --scene mirror-hall --size 64x36 --reference-path-traced 64 --resume --seed 3
expect_error 1 'KA3048 .*64x36, not of 32x18' --scene mirror-hall --size 32x18 --reference-path-traced 64 --resume
expect_error 1 'KA3048 .*another scene' --scene glass-stack --size 64x36 --reference-path-traced 64 --resume
rm "$work/out/reference.sums"
expect_error 1 'KA3000 .*reference.sums' --scene glass-stack --size 64x36 --reference-path-traced 64 --resume

# --watch: editing a shader changes the picture.
mkdir "$work/effects"
cp -r "$source_folder"/effects/{shaders,surfaces,occlusion,shadows,composition} "$work/effects"
KAAMOS_EFFECTS=$work/effects "$northlight" --watch --size 320x180 --out "$work/watch" > "$work/log" 2>&1 &
watcher=$!
wait_for() {  # wait_for SECONDS command...
  local tenths=$(($1 * 10))
  shift
  until "$@"; do
    tenths=$((tenths - 1))
    [ "$tenths" -gt 0 ] || return 1
    sleep 0.1
  done
}
frame_differs() { [ -s "$work/watch/frame.png" ] && ! cmp -s "$work/watch/frame.png" "$work/first.png"; }
: > "$work/first.png"
if wait_for 100 frame_differs; then
  sleep 0.3
  cp "$work/watch/frame.png" "$work/first.png"
  start=$(date +%s%N)
  sed -i 's/float3 from_sky = /float3 from_sky = 0.1 * /' "$work/effects/composition/composite/composite.hlsl"
  wait_for 60 frame_differs || fail "--watch: no new picture"
  echo "edit to picture at 320x180: $((($(date +%s%N) - start) / 1000000)) ms"
  echo 'this is no HLSL' >> "$work/effects/composition/composite/composite.hlsl"
  wait_for 60 grep -q 'composite.hlsl:.*error' "$work/log" || fail "--watch: no message for a broken shader"
else
  fail "--watch: no first picture: $(cat "$work/log")"
fi
kill -INT "$watcher"
wait "$watcher" || fail "--watch: Ctrl-C ends with $?"

[ "$failures" = 0 ] && echo "northlight's command line is as expected"
exit "$((failures > 0))"

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs scripts/gltf-sheet ROOT with a program of its own in northlight's place."""
import json
import pathlib
import subprocess
import sys
import tempfile

FAKE = """#!/bin/sh
# Writes a picture for good.gltf, refuses bad.gltf, and ends by a signal for worse.gltf.
case "$*" in
  *good.gltf*)
    grep -q '"camera"' "$2" && grep -q '"name": "kept"' "$2" || exit 9
    mkdir -p "$4" && echo picture >"$4/frame.png" ;;
  *bad.gltf*) echo "northlight: KA3020 it is bad" >&2; exit 1 ;;
  *) kill -SEGV $$ ;;
esac
"""


def run(root, place, names):
    models = [{"fileName": name, "sampleImageName": "sample.png",
               "camera": {"translation": [0.0, 20.0, -20.0]}} for name in names]
    group = place / "checkout" / "Group"
    group.mkdir(parents=True, exist_ok=True)
    for name in names:
        (group / name).write_text(json.dumps({"asset": {"version": "2.0"},
                                              "nodes": [{"name": "kept"}],
                                              "scenes": [{"nodes": [0]}]}))
    (group / "sample.png").write_text("sample")
    # A group has a list of its own, which is another kind of file.
    (group / "Manifest.json").write_text(json.dumps({"folder": "Group"}))
    (place / "checkout" / "Manifest.json").write_text(
        json.dumps([{"folder": "Group", "models": models}]))
    fake = place / "northlight"
    fake.write_text(FAKE)
    fake.chmod(0o755)
    return subprocess.run([root / "scripts" / "gltf-sheet", place / "checkout", place / "out",
                           "--northlight", fake], capture_output=True, text=True, check=False)


def main():
    root = pathlib.Path(sys.argv[1])
    with tempfile.TemporaryDirectory() as temporary:
        place = pathlib.Path(temporary)
        done = run(root, place, ["good.gltf", "bad.gltf"])
        assert done.returncode == 0, done
        assert "1 rendered, 1 refused, 0 broken" in done.stdout, done.stdout
        sheet = (place / "out" / "sheet.html").read_text()
        for part in ("Group/good/frame.png", "Group/sample.png", "KA3020 it is bad"):
            assert part in sheet, (part, sheet)
        done = run(root, place, ["worse.gltf"])
        assert done.returncode == 1 and "1 broken" in done.stdout, done
        assert run(root, place, []).returncode == 1, "a folder without models is a mistake"


if __name__ == "__main__":
    main()

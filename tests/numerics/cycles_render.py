# SPDX-License-Identifier: MIT
"""blender -b --factory-startup --python cycles_render.py -- SCENE.glb FOLDER [options]

Renders a .glb of `northlight --write-glb` with Cycles: FOLDER/BOUNCES_SEED.exr, for paths of 0, 1
and any number of bounces after what the camera sees, and two seeds.
"""

import argparse
import os
import sys

sys.dont_write_bytecode = True  # no folder beside the sources
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import cycles_scene  # noqa: E402

UNLIMITED = 1024  # Cycles' own limit


def parse(arguments):
    parser = argparse.ArgumentParser(prog="cycles_render.py")
    parser.add_argument("scene")
    parser.add_argument("folder")
    parser.add_argument("--size", default="320x180")
    parser.add_argument("--samples", type=int, default=64, help="of each seed")
    parser.add_argument("--threads", type=int, default=0, help="0: all")
    parser.add_argument("--bounces", default="0,1,all")
    parser.add_argument("--seeds", default="1,2")
    return parser.parse_args(arguments)


def main():
    options = parse(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])
    try:
        cycles_scene.load(options.scene)
    except cycles_scene.NotMatched as error:
        sys.exit(f"cycles_render.py: {error}")
    size = [int(part) for part in options.size.split("x")]
    cycles_scene.set_up_cycles(size, options.samples, options.threads)
    for bounces in options.bounces.split(","):
        for seed in options.seeds.split(","):
            path = os.path.join(os.path.abspath(options.folder), f"{bounces}_{seed}.exr")
            limit = UNLIMITED if bounces == "all" else int(bounces)
            cycles_scene.render(path, int(seed), limit)


main()

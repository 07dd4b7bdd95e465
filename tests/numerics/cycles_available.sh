#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Exits with 77, and says why, where Blender cannot render with Cycles as cycles_scene.py needs it.
set -u
command -v blender > /dev/null || {
  echo "skipped: Blender is not installed (Debian: blender, python3-numpy)"
  exit 77
}
said=$(blender -b --factory-startup --python-expr "import bpy, numpy
print('cycles', bpy.app.build_options.cycles, '%d.%d' % bpy.app.version[:2])" 2>&1)
grep -q '^cycles True 3\.4$' <<< "$said" && exit 0
echo "skipped: the pictures are matched to Blender 3.4 with Cycles and numpy, not to: $said"
exit 77

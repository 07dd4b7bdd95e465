# SPDX-License-Identifier: MIT
"""Northlight's frame."""

from . import _kaamos


def scenes():
    """The names of the scenes that are built in."""
    return _kaamos.scene_names()


def frame_settings():
    """Every setting of a frame and of its effects: dicts of `name`, `topic`, `default`, `allowed` values,
    what it is `about`, and the `source` of the default, "" for this project's own."""
    return _kaamos.described_settings()


class FrameRenderer:
    """The frame of a scene with Northlight's ray traced effects: G-buffer, shadows, ambient occlusion,
    indirect light, reflections, glass, denoised and put together.

        frame = kaamos.FrameRenderer(kaamos.Device(), "lounge", 320, 180)
        frame.render()
        ao = frame.layer("ao")

    `scene`: one of scenes(), or a glTF file. `effects`: "all", or names such as "ao", "sun", "gi".
    `settings`: values by the names of frame_settings(), as {"ao-radius": 0.5}. The same seed gives the
    same frame. Raises Error (KA3046 an unknown effect, KA3049 an unknown setting or value)."""

    def __init__(self, device, scene="lounge", width=640, height=360, effects=("all",), seed=0,
                 settings=None):
        effects = [effects] if isinstance(effects, str) else list(effects)
        texts = {name: _text(value) for name, value in (settings or {}).items()}
        self._native = _kaamos.Frame(device._session, str(scene), width, height, effects, seed, texts)

    @property
    def layers(self):
        """The names of the pictures that a frame consists of: the G-buffer's, each effect's, raw and
        denoised, and "radiance"."""
        return self._native.layers()

    def render(self, progress=None):
        """Renders the frame. `progress`: called as progress(what, done), `done` from 0 to 1. Ctrl-C
        stops it."""
        self._native.render(progress)

    def layer(self, name):
        """A layer as float32 of shape (height, width) or (height, width, channels): linear values, with
        all bits. Renders the frame if it has not been. Raises Error (KA3046) for an unknown name."""
        return self._native.layer(name)

    def picture(self):
        """The frame as a screen shows it: uint8 of shape (height, width, 3)."""
        return self._native.picture()

    def _repr_png_(self):
        from . import _png
        return _png(self.picture())


def _text(value):
    """A value as command lines have it."""
    if isinstance(value, bool):
        return "on" if value else "off"
    return str(value)

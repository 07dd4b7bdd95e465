# SPDX-License-Identifier: MIT
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

__version__: str

class Error(RuntimeError):
    id: str

class CheckError(Error): ...

class Library:
    @property
    def exports(self) -> list[str]: ...
    @property
    def resources(self) -> list[str]: ...

class Buffer:
    @property
    def nbytes(self) -> int: ...
    def numpy(self, dtype: npt.DTypeLike = None, shape: Sequence[int] | None = None) -> np.ndarray: ...

class MappedBuffer(Buffer):
    @property
    def array(self) -> np.ndarray: ...

class Sampler:
    def __init__(self, filter: str = "linear", address: str = "wrap", compare: str | None = None,
                 border: Sequence[float] = (0, 0, 0, 0), bias: float = 0.0,
                 lod: Sequence[float] = (0.0, 1000.0)) -> None: ...

class Texture:
    @property
    def shape(self) -> tuple[int, ...]: ...
    def numpy(self) -> np.ndarray: ...

class AccelerationStructure: ...

class Instance:
    bottom_level: AccelerationStructure
    transform: npt.ArrayLike | None
    id: int
    mask: int
    hit_group: int
    flags: int
    def __init__(self, bottom_level: AccelerationStructure, transform: npt.ArrayLike | None = None, id: int = 0,
                 mask: int = 0xFF, hit_group: int = 0, flags: int = 0) -> None: ...

class Picture:
    array: np.ndarray
    zoom: int
    def __init__(self, array: npt.ArrayLike, zoom: int = 1) -> None: ...

class Explanation:
    text: str
    @property
    def tree(self) -> dict[str, Any]: ...

_Constants = bytes | bytearray | np.ndarray | int | float | bool | Sequence[Any]
_Resource = Buffer | Texture | AccelerationStructure | Sampler | _Constants
_Record = str | None | tuple[str, _Constants]

class Device:
    backend: str
    interprets: bool
    on_print: Callable[[str], Any] | None
    def __init__(self, backend: str = "embree", interpret: bool | None = None, checked: bool = False,
                 threads: int = 0, on_print: Callable[[str], Any] | None = print) -> None: ...
    def compile(self, source: str = "", file: str = "shader.hlsl", target: str = "lib_6_6",
                include: Iterable[str] = (), define: Mapping[str, Any] | None = None) -> Library: ...
    def buffer(self, array: npt.ArrayLike) -> Buffer: ...
    def mapped_buffer(self, array: npt.ArrayLike) -> MappedBuffer: ...
    def texture(self, array: npt.ArrayLike) -> Texture: ...
    def bottom_level(self, vertices: npt.ArrayLike | None = None, indices: npt.ArrayLike | None = None,
                     boxes: npt.ArrayLike | None = None, opaque: bool = True) -> AccelerationStructure: ...
    def top_level(self, instances: Iterable[Instance | AccelerationStructure]) -> AccelerationStructure: ...
    def dispatch(self, library: Library, entry: str, groups: int | Sequence[int],
                 **resources: _Resource) -> None: ...
    def dispatch_rays(self, library: Library, ray_generation: str, size: int | Sequence[int],
                      miss: Iterable[_Record] = (), hit_groups: Iterable[_Record] = (),
                      callable: Iterable[_Record] = (), groups: Mapping[str, Sequence[str]] | None = None,
                      local: Iterable[str] = (), payload_bytes: int = 64, attribute_bytes: int = 8,
                      recursion: int = 1, **resources: _Resource) -> None: ...
    def explain_rays(self, library: Library, ray_generation: str, size: int | Sequence[int],
                     at: int | Sequence[int], miss: Iterable[_Record] = (),
                     hit_groups: Iterable[_Record] = (), callable: Iterable[_Record] = (),
                     groups: Mapping[str, Sequence[str]] | None = None, local: Iterable[str] = (),
                     payload_bytes: int = 64, attribute_bytes: int = 8, recursion: int = 1,
                     **resources: _Resource) -> Explanation: ...
    def draw(self, library: Library, vertex: str, pixel: str | None, vertices: int,
             targets: Texture | Iterable[Texture], instances: int = 1, topology: str = "triangles",
             clear: Sequence[float] | None = None, depth: bool = False, cull: str = "none",
             blend: str = "none", wireframe: bool = False, **resources: _Resource) -> None: ...

class FrameRenderer:
    def __init__(self, device: Device, scene: str = "lounge", width: int = 640, height: int = 360,
                 effects: str | Iterable[str] = ("all",), seed: int = 0,
                 settings: Mapping[str, Any] | None = None) -> None: ...
    @property
    def layers(self) -> list[str]: ...
    def render(self, progress: Callable[[str, float], Any] | None = None) -> None: ...
    def layer(self, name: str) -> np.ndarray: ...
    def picture(self) -> np.ndarray: ...

def scenes() -> list[str]: ...
def frame_settings() -> list[dict[str, str]]: ...
def call(function: str, source: str, *arguments: npt.ArrayLike, device: Device | None = None,
         target: str = "lib_6_6", include: Iterable[str] = ()) -> np.ndarray: ...

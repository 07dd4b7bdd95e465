// SPDX-License-Identifier: MIT
//
// Records the rays that shaders trace, between the shaders and their backend: a listening library
// passes its ray generation shaders services of its own, whose TraceRay notes the ray and then
// calls the backend's. Shaders that these rays call inherit the services.
#pragma once

#include <rtapi/rtapi.h>

#include <vector>

#include "embree_loops.h"

namespace kaamos::bench {

// `library` with ray generation shaders that listen while a RayRecording exists. At other times
// they cost a call and a load for each row of a tile. `library` must be built into the program.
rtapi::ShaderLibrary listening_library(const rtapi::ShaderLibrary& library);

// Only one may exist, and no dispatch may be running when it begins or ends.
class RayRecording {
 public:
  RayRecording();
  ~RayRecording();
  RayRecording(const RayRecording&) = delete;
  RayRecording& operator=(const RayRecording&) = delete;

  // All rays so far, thread after thread, in the order in which each thread traced them.
  std::vector<FrameRay> rays() const;
};

}  // namespace kaamos::bench

// SPDX-License-Identifier: MIT
//
// Northlight's frame for Python: a scene, the renderer of its frames, and their layers as arrays.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "effects/northlight/frame_renderer.h"
#include "python/session.h"

namespace kaamos::python {

struct FrameOptions {
  std::string scene = "lounge";  // built in, or a .gltf or .glb file
  uint32_t width = 640;
  uint32_t height = 360;
  std::vector<std::string> effects = {"all"};
  uint32_t seed = 0;
  std::map<std::string, std::string> settings;  // by full name, as command lines have them
};

class Frame {
 public:
  // Throws rtapi::ResultError.
  Frame(const Session& session, const FrameOptions& options);

  // Calls progress(what, done) if it is not None. Throws what that throws, and KeyboardInterrupt.
  void render(const py::object& progress);
  std::vector<std::string> layers() const { return renderer_->layers(); }
  // Float32 of shape (height, width) or (height, width, channels).
  py::array layer(const std::string& name);
  // As a screen shows it: uint8 of shape (height, width, 3).
  py::array picture();

 private:
  effects::Scene scene_;
  std::unique_ptr<effects::FrameRenderer> renderer_;
  bool is_rendered_ = false;
};

std::vector<std::string> scene_names();
// A dict for each setting of frames: name, topic, default, allowed, about, source.
py::list described_settings();

}  // namespace kaamos::python

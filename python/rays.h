// SPDX-License-Identifier: MIT
//
// Acceleration structures from arrays, and dispatches of rays.
#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "python/session.h"

namespace kaamos::python {

struct BottomLevelOptions {
  py::object vertices;  // float32 of shape (n, 3); None: boxes
  py::object indices;   // uint32 of shape (m, 3), or None
  py::object boxes;     // float32 of shape (k, 6): least and greatest corner; or None
  bool opaque = true;
};
Structure build_bottom_level(Session& session, const BottomLevelOptions& options);

struct Instance {
  Structure bottom_level;
  py::object transform;  // (3, 4), or None
  uint32_t id = 0;
  uint32_t mask = 0xFF;
  uint32_t hit_group = 0;
  uint32_t flags = 0;
};
Structure build_top_level(Session& session, const std::vector<Instance>& instances);

// A record's export, and the bytes of its local root constants.
using Record = std::pair<std::string, std::string>;

struct RayDispatch {
  std::string ray_generation;
  std::vector<Record> miss;
  std::vector<Record> hit_groups;
  std::vector<Record> callable;
  // Hit groups that the library does not define itself: name, closest hit, any hit, intersection.
  std::vector<std::array<std::string, 4>> groups;
  std::vector<std::string> local;  // resources of local root signatures, by name
  uint32_t payload_bytes = 64;
  uint32_t attribute_bytes = 8;
  uint32_t recursion = 1;
  uint32_t size[3] = {1, 1, 1};
};
void dispatch_rays(Session& session, const Library& library, const RayDispatch& what,
                   const Bindings& given);

struct Explanation {
  std::string text;  // lines for a terminal
  std::string json;
};
// Runs the dispatch, and explains one of its rays. [rtapi::ExplainPixel]
Explanation explain_rays(Session& session, const Library& library, const RayDispatch& what,
                         std::array<uint32_t, 3> at, const Bindings& given);

}  // namespace kaamos::python

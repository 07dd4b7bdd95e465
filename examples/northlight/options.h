// SPDX-License-Identifier: MIT
// The command line of northlight.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace northlight {

struct Options {
  std::string scene = "lounge";  // or a .gltf or .glb file
  std::string backend = "embree";
  std::string precision = "robust";  // of traversals: fast, robust, exact
  bool checked = false;              // checked mode: what it finds is printed
  std::uint32_t width = 1280;
  std::uint32_t height = 720;
  bool ao = true;
  bool sun = true;
  std::uint32_t ao_samples = 4;
  float ao_radius = 4.0f;  // metres; infinity: no limit
  std::uint32_t sun_samples = 2;
  std::optional<float> sun_angle_degrees;  // full angle of the disk; none: the scene's
  std::uint32_t seed = 0;
  std::uint32_t threads = 0;  // 0: all
  std::string out = "out/northlight";
  std::string write_glb;  // empty: none
  bool watch = false;
  bool list_devices = false;
  std::optional<std::pair<std::uint32_t, std::uint32_t>>
      pixel;           // print it instead of writing files
  std::string tables;  // "text", "json": print the shader tables instead of rendering; empty: no
  std::optional<std::pair<std::uint32_t, std::uint32_t>> explain;  // print this pixel's tree
  bool json = false;                                               // of explain
  std::string heatmap;  // "anyhit", "candidates", "depth", "rays": write that picture; empty: no
};

// Parses the command line. Where the program is to end at once (--help, a wrong option), nothing is
// returned and `exit_code` is set; what there was to say has been printed.
std::optional<Options> parse_options(int argc, char** argv, int& exit_code);

}  // namespace northlight

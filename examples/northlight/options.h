// SPDX-License-Identifier: MIT
// northlight's command line.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace northlight {

struct Options {
  std::string scene = "lounge";        // or runner, glass-stack, mirror-hall, a .gltf or .glb file
  std::vector<std::string> materials;  // overrides, NAME:KEY=VALUE[,KEY=VALUE...]
  std::string backend = "embree";
  std::string precision = "robust";  // of ray traversal: fast, robust, exact
  bool checked = false;              // print what checked mode reports
  std::uint32_t width = 1280;
  std::uint32_t height = 720;
  bool ao = true;
  bool sun = true;
  bool local = false;    // lights other than the sun
  bool contact = false;  // contact shadows of the strongest of them
  bool gi = false;       // indirect diffuse light
  bool reflections = false;
  bool transparent = false;  // glass and its reflections
  // Whether any effect besides ambient occlusion and the sun is rendered.
  bool whole_frame() const { return local || gi || reflections || transparent; }
  std::string denoise = "svgf";  // for the whole frame: none, gaussian, bilateral, temporal, svgf
  std::optional<std::uint32_t> denoise_passes;  // for svgf
  std::vector<std::string> half_resolution;     // effects that trace a quarter of the pixels; "all"
  // 2 for these effects, otherwise 1. Without denoising, no pass would fill the other pixels.
  std::uint32_t pixel_step(const std::string& effect) const {
    if (!whole_frame()) return 1;
    for (const std::string& name : half_resolution) {
      if (name == effect || name == "all") return 2;
    }
    return 1;
  }
  std::uint32_t contact_samples = 1;
  float contact_length = 1.0f;         // metres
  std::string gi_mode = "near-field";  // direct, hit-black, near-field, near-field-glossy
  std::uint32_t gi_samples = 1;
  std::optional<float> gi_cell;  // in metres; default: by the size of the scene
  std::uint32_t gi_bake_samples = 256;
  std::string gi_volume;  // file to read it from or write it to; empty: bake each time
  std::uint32_t reflection_samples = 1;
  float firefly_limit = 0;         // luminance; 0: none
  std::uint32_t glass_layers = 1;  // nearest layers, each with a reflection
  std::uint32_t ao_samples = 4;
  float ao_radius = 4.0f;  // metres; infinity: no limit
  std::uint32_t sun_samples = 2;
  std::optional<float> sun_angle_degrees;  // full angle of the disk; default: the scene's
  // Sort rays by "direction" or "origin"; empty: keep the pixels' order.
  std::string sort_rays;
  std::string texture_lod = "cone";   // or "zero"
  std::uint32_t piece_triangles = 0;  // split larger meshes; 0: split none
  bool measure_left_out = false;      // instead of writing files
  // Not set by the command line: parts to make although the scene does not need them.
  bool keep_glass = false;
  bool keep_local = false;
  std::uint32_t seed = 0;
  std::uint32_t threads = 0;  // 0: all
  std::string out = "out/northlight";
  std::string write_glb;     // empty: none
  std::uint32_t frames = 0;  // of a sequence; 0: a still
  std::string camera_path;   // name or file; empty: the scene's own
  double frames_per_second = 30;
  bool taa = false;
  bool watch = false;
  bool list_devices = false;
  std::string split;                        // settings side by side in one picture; empty: none
  std::uint32_t reference = 0;              // samples for the layers NAME_reference; 0: none
  bool claims = false;                      // measure what the sources say about costs
  std::string measure;                      // effect whose error to measure; empty: none
  std::uint32_t measure_reference = 16384;  // samples of its reference
  std::uint32_t repeats = 7;                // runs of each measured setting
  bool cpu_clock = false;                   // measure CPU time over threads
  std::uint32_t seeds = 64;                 // for each denoiser
  std::optional<std::pair<std::uint32_t, std::uint32_t>>
      pixel;           // print it instead of writing files
  std::string tables;  // "text", "json": print the shader tables instead of rendering; empty: no
  std::optional<std::pair<std::uint32_t, std::uint32_t>> explain;  // print this pixel's tree
  bool json = false;                                               // for --explain
  std::string heatmap;  // "anyhit", "candidates", "depth", "rays": write that picture; empty: no
};

// Parses the command line. If the program should exit at once (--help, a wrong option), returns
// nothing and sets `exit_code`; everything to say has been printed.
std::optional<Options> parse_options(int argc, char** argv, int& exit_code);

}  // namespace northlight

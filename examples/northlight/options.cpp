// SPDX-License-Identifier: MIT
#include "options.h"

#include <rtapi/version.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <tuple>

#include "effects/assets/built_in/built_in.h"
#include "effects/assets/built_in/camera_paths.h"
#include "effects/glass/transparent/transparent.h"
#include "effects/indirect/indirect_diffuse/indirect_diffuse.h"
#include "effects/measure/comparison/split.h"
#include "effects/reflections/traced/reflections.h"
#include "effects/shadows/contact_shadow/contact_shadow.h"
#include "options_conflict.h"
#include "options_measure.h"
#include "options_output.h"
#include "options_views.h"

namespace northlight {

using namespace kaamos::effects;

namespace {

constexpr std::uint32_t kMaxSamples = 65536;
constexpr std::uint32_t kMaxFrames = 100000;
constexpr std::uint32_t kMaxSide = 16384;  // limit of a texture [D3D12: resource limits]

// The values of options that are words, kept until all options have been read.
struct Words {
  std::string size = "1280x720";
  std::string sun;
  std::vector<std::string> effects = {"ao", "sun"};
  std::string pixel, explain;
  std::string denoise = "svgf";
  std::optional<std::uint32_t> denoise_passes;
  std::vector<std::string> half_resolution;
  bool rotate_pixels = false;
  std::string gi_mode = "near-field";
  std::vector<std::string> bake_lights;
  std::string sort_rays;
  std::string texture_lod = "cone";
  std::string primary = "rays";
  MeasureWords measuring;
  float contact_length = ContactShadowConstants().length;
  std::string fireflies = "retrace";
  std::string contact_combine = "product";
  std::string light_culling = "clusters";
  std::string light_maps = "traced";
  std::string sun_at_hits = "ray";
  float firefly_limit = 0;
  float gi_length = IndirectConstants().length;
  float reflection_length = ReflectionConstants().longest;
  float reflection_length_rough = ReflectionConstants().shortest;
  std::uint32_t glass_layers = 1;
  float sun_angle = 0;  // the whole disk, degrees
};

std::uint32_t baked_lights(const std::vector<std::string>& names) {
  std::uint32_t lights = 0;
  for (const std::string& name : names) {
    lights |= name == "sun"     ? kBakeSun
              : name == "sky"   ? kBakeSky
              : name == "local" ? kBakeLocal
                                : kBakeEmissive;
  }
  return lights;
}

std::string parse_size(const std::string& text, Options& options) {
  unsigned width = 0;
  unsigned height = 0;
  int end = 0;
  if (std::sscanf(text.c_str(), "%5ux%5u%n", &width, &height, &end) != 2 ||
      static_cast<std::size_t>(end) != text.size() || width == 0 || height == 0 ||
      width > kMaxSide || height > kMaxSide) {
    return "\"" + text + "\" is not a size: give width and height from 1 to 16384, as in 1280x720";
  }
  options.frame.width = width;
  options.frame.height = height;
  return {};
}

std::string parse_pixel(const std::string& text,
                        std::optional<std::pair<std::uint32_t, std::uint32_t>>& pixel) {
  unsigned x = 0;
  unsigned y = 0;
  int end = 0;
  if (std::sscanf(text.c_str(), "%5u,%5u%n", &x, &y, &end) != 2 ||
      static_cast<std::size_t>(end) != text.size()) {
    return "\"" + text + "\" is not a pixel: give x and y, as in 12,40";
  }
  pixel = {x, y};
  return {};
}

std::string parse_sun(const std::string& text, Options& options) {
  float azimuth = 0, elevation = 0;
  int end = 0;
  if (std::sscanf(text.c_str(), "%f,%f%n", &azimuth, &elevation, &end) != 2 ||
      static_cast<std::size_t>(end) != text.size() || !(std::abs(azimuth) <= 360) ||
      !(std::abs(elevation) <= 90)) {
    return "\"" + text +
           "\" is no place of the sun: give degrees from -360 to 360 and from -90 to 90, as in "
           "30,50";
  }
  options.sun = {azimuth, elevation};
  return {};
}

std::string check_effect(const std::string& name) {
  if (name == "all" || find_effect(northlight_effects(), name) != nullptr) return {};
  return "\"" + name + "\" is not an effect: there are " + effect_names(northlight_effects()) +
         " and all, as in ao,sun";
}

std::string parse_radius(const std::string& text, Options& options) {
  float radius = std::numeric_limits<float>::infinity();
  if (text != "inf") {
    char* end = nullptr;
    radius = std::strtof(text.c_str(), &end);
    if (end == text.c_str() || *end != '\0' || !(radius > 0)) {
      return "\"" + text + "\" is not a radius: give metres greater than 0, or inf";
    }
  }
  for (const Effect& effect : northlight_effects()) {
    if (effect.name != "ao" && effect.alternative_to != "ao") continue;
    options.effects.at(effect.name).radius = radius;
  }
  return {};
}

// "ao (ambient occlusion), sun (sun shadow), ...".
std::string describe_effects() {
  std::string out;
  for (const Effect& effect : northlight_effects()) {
    out += (out.empty() ? "" : ", ") + effect.name + " (" + effect.about + ")";
  }
  return out;
}

// "settings side by side in one picture: ao (...), ...".
std::string describe_splits() {
  std::string out;
  for (const Split& split : splits()) {
    out += (out.empty() ? "settings side by side in one picture: " : ", ") + split.name + " (" +
           split.about + ")";
  }
  return out;
}

// Effects that take samples, and "all".
std::vector<std::string> sampled_effects() {
  std::vector<std::string> out;
  for (const Effect& effect : northlight_effects()) {
    if (!effect.samples_option.empty()) out.push_back(effect.name);
  }
  out.push_back("all");
  return out;
}

// A CLI11 validator that stores what it parses.
template <class Parse>
CLI::Validator parsed_by(Parse parse, Options& options) {
  return CLI::Validator([parse, &options](std::string& text) { return parse(text, options); }, "");
}

void add_engine(CLI::App& app, Options& options, Words& words) {
  app.add_option(
         "--sort-rays", words.sort_rays,
         "sort rays by direction, by origin, or by origin and where they are thought to end "
         "(termination); the picture stays the same")
      ->check(CLI::IsMember({"direction", "origin", "termination"}));
  app.add_option("--primary", words.primary,
                 "what finds the surfaces that pixels show: rays, or the rasterizer (raster)")
      ->capture_default_str()
      ->check(CLI::IsMember({"rays", "raster"}));
  app.add_option("--texture-lod", words.texture_lod,
                 "level of detail of textures: by ray cones (cone), or always 0 (zero)")
      ->capture_default_str()
      ->check(CLI::IsMember({"cone", "zero"}));
  app.add_option("--pieces", options.piece_triangles,
                 "split meshes of more triangles than this; 0: none")
      ->capture_default_str()
      ->check(CLI::Range(0u, 1u << 29));
  app.add_flag(
      "--measure-left-out", options.measure_left_out,
      "print what parts that the scene does not need would cost, instead of writing files");
}

void add_sequence(CLI::App& app, Options& options) {
  auto* frames = app.add_option("--frames", options.frames,
                                "render a sequence: frame_0000.png ..., the last one's layers")
                     ->check(CLI::Range(1u, kMaxFrames));
  app.add_option("--camera-path", options.camera_path,
                 std::string("camera of a sequence: ") + kCameraPaths +
                     "; or a file, lines of seconds, eye x y z, target x y z [fov=DEGREES] [cut]; "
                     "default: still where something moves, else dolly");
  app.add_option("--fps", options.frames_per_second, "frames per second of a sequence")
      ->needs(frames)
      ->capture_default_str()
      ->check(CLI::Range(0.01, 10000.0));
  app.add_flag("--taa", options.frame.taa, "antialiasing over the frames of a sequence")
      ->needs(frames);
}

DenoiseMethod denoise_method(const std::string& name) {
  if (name == "none") return DenoiseMethod::kNone;
  if (name == "gaussian") return DenoiseMethod::kGaussian;
  if (name == "bilateral") return DenoiseMethod::kBilateral;
  if (name == "temporal") return DenoiseMethod::kTemporal;
  if (name == "control") return DenoiseMethod::kControl;
  if (name == "a-svgf") return DenoiseMethod::kAdaptiveSvgf;
  return DenoiseMethod::kSvgf;
}

IndirectMode indirect_mode(const std::string& name) {
  if (name == "direct") return IndirectMode::kDirect;
  if (name == "hit-black") return IndirectMode::kHitBlack;
  if (name == "near-field-glossy") return IndirectMode::kNearFieldGlossy;
  return IndirectMode::kNearField;
}

SunAtHits sun_at_hits(const std::string& name) {
  if (name == "none") return SunAtHits::kNone;
  return name == "map" ? SunAtHits::kByMap : SunAtHits::kByRay;
}

Fireflies fireflies(const std::string& name) {
  if (name == "keep") return Fireflies::kKeep;
  if (name == "average") return Fireflies::kAverage;
  return Fireflies::kRetrace;
}

// Applies the words to the frame and its effects.
void apply(const Words& words, Options& options) {
  FrameSettings& frame = options.frame;
  ContactShadowConstants contact = kContactAsNeeded;
  contact.length = words.contact_length;
  options.effects.at("contact").set_constants(contact);
  IndirectConstants indirect;
  indirect.mode = indirect_mode(words.gi_mode);
  indirect.length = words.gi_length;
  indirect.sun_at_hits = sun_at_hits(words.sun_at_hits);
  if (!words.bake_lights.empty()) frame.volume.lights = baked_lights(words.bake_lights);
  options.effects.at("gi").set_constants(indirect);
  ReflectionConstants reflection;
  reflection.firefly_limit = words.firefly_limit;
  reflection.fireflies = fireflies(words.fireflies);
  reflection.sun_at_hits = indirect.sun_at_hits;
  reflection.longest = words.reflection_length;
  reflection.shortest = words.reflection_length_rough;
  options.effects.at("reflections").set_constants(reflection);
  options.effects.at("transparent").set_constants(deck_layers(words.glass_layers));
  for (const std::string& name : words.half_resolution) {
    for (auto& [effect, settings] : options.effects) {
      const bool takes_samples = !find_effect(northlight_effects(), effect)->samples_option.empty();
      if (!takes_samples || (name != effect && name != "all")) continue;
      settings.pixel_step = 2;
      settings.rotates = words.rotate_pixels;
    }
  }
  frame.denoise = default_denoise(denoise_method(words.denoise));
  if (words.denoise_passes) {
    frame.denoise.iterations = frame.denoise.iterations_with_history = *words.denoise_passes;
  }
  frame.ray_cones = words.texture_lod == "cone";
  frame.primary = words.primary == "raster" ? Primary::kRaster : Primary::kRays;
  if (!words.sort_rays.empty()) {
    frame.order = words.sort_rays == "origin"        ? RayOrder::kOrigin
                  : words.sort_rays == "termination" ? RayOrder::kTermination
                                                     : RayOrder::kDirection;
  }
  frame.contact =
      words.contact_combine == "min" ? ContactCombination::kMinimum : ContactCombination::kProduct;
  frame.light_culling =
      words.light_culling == "frustum" ? LightCulling::kFrustum : LightCulling::kClusters;
  frame.light_maps = words.light_maps == "drawn" ? LightMaps::kDrawn : LightMaps::kTraced;
  if (words.sun_at_hits != "map") {
    frame.sun_map = 0;
  } else if (frame.sun_map == 0) {
    frame.sun_map = 2048;
  }
  frame.moving = options.frames > 0;
  choose(options, words.effects);
}

}  // namespace

std::optional<Options> parse_options(int argc, char** argv, int& exit_code) {
  Options options;
  options.effects = default_options().effects;
  Words words;
  std::string radius = "4";
  CLI::App app(
      "Renders a scene with Northlight's ray traced effects: ambient occlusion and sun shadow, or\n"
      "the whole frame with --effects all.\n"
      "Writes frame.png, frame.exr, stats.json, and for each effect that is named, or what\n"
      "--layers names, a PNG and a layer of frame.exr.",
      "northlight");
  app.set_version_flag("--version", std::string("northlight ") + rtapi::GetVersion());
  app.add_option("--scene", options.scene,
                 "built in: " + built_in_scene_names() + "; or a .gltf or .glb file")
      ->capture_default_str();
  app.add_option("--material", options.materials,
                 "change a material, as in Window:alpha=0.3,roughness=0; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("--backend", options.backend,
                 "the backend that runs the shaders: embree, vulkan; --study: both")
      ->capture_default_str();
  app.add_flag("--checked", options.checked, "checked mode: report what DXR leaves undefined");
  app.add_option("--precision", options.precision,
                 "precision of ray-triangle tests on embree: fast, robust, exact")
      ->capture_default_str()
      ->check(CLI::IsMember({"fast", "robust", "exact"}));
  app.add_option("--size", words.size, "width and height in pixels")
      ->capture_default_str()
      ->check(parsed_by(parse_size, options));
  app.add_option("--effects", words.effects, "comma-separated: " + describe_effects() + "; or all")
      ->delimiter(',')
      ->capture_default_str()
      ->check(CLI::Validator([](std::string& name) { return check_effect(name); }, ""));
  for (const Effect& effect : northlight_effects()) {
    if (effect.samples_option.empty()) continue;
    app.add_option("--" + effect.samples_option, options.effects.at(effect.name).samples,
                   "rays per pixel of " + effect.about)
        ->capture_default_str()
        ->check(CLI::Range(1u, kMaxSamples));
  }
  app.add_option("--ao-radius", radius,
                 "how far away something occludes, in metres, or inf "
                 "(on the screen 0.5 by default)")
      ->capture_default_str()
      ->check(parsed_by(parse_radius, options));
  auto* angle = app.add_option("--sun-angle", words.sun_angle,
                               "angular size of the sun, in degrees "
                               "(the real one: 0.53); default: the scene's")
                    ->check(CLI::Range(0.0f, 90.0f));
  app.add_option("--sun", words.sun,
                 "AZIMUTH,ELEVATION: where the sun stands, in degrees from +Z towards +X and above "
                 "the horizon, as in 30,50; default: the scene's, which may have none")
      ->check(parsed_by(parse_sun, options));
  app.add_option("--denoise", words.denoise,
                 "denoiser for the whole frame: none, gaussian, bilateral, temporal, svgf, "
                 "control, a-svgf (svgf that forgets where light changes)")
      ->capture_default_str()
      ->check(CLI::IsMember(
          {"none", "gaussian", "bilateral", "temporal", "svgf", "control", "a-svgf"}));
  app.add_option("--denoise-passes", words.denoise_passes,
                 "passes of svgf's wavelet filter, each twice as wide as the one before "
                 "(5; 3 once a sequence has four frames of history)")
      ->check(CLI::Range(0u, 8u));
  app.add_option(
         "--half-resolution", words.half_resolution,
         "effects of the whole frame that trace a quarter of the pixels, comma-separated: " +
             join(sampled_effects()))
      ->delimiter(',')
      ->check(CLI::IsMember(sampled_effects()));
  app.add_flag("--rotate-pixels", words.rotate_pixels,
               "with --half-resolution, the pixel of each 2 x 2 that is traced takes turns from "
               "frame to frame: four frames of a sequence trace all of them");
  app.add_option("--contact-combine", words.contact_combine,
                 "a light's shadow map and contact shadow: product, min (the darker of the two)")
      ->capture_default_str()
      ->check(CLI::IsMember({"product", "min"}));
  app.add_option("--light-culling", words.light_culling,
                 "local lights that a pixel looks at: clusters (its cluster's), frustum (all that "
                 "reach into the picture); the picture stays the same")
      ->capture_default_str()
      ->check(CLI::IsMember({"clusters", "frustum"}));
  app.add_option("--light-maps", words.light_maps,
                 "shadow maps of local lights, and the sun's: traced (a ray for each texel), drawn "
                 "(by the rasterizer)")
      ->capture_default_str()
      ->check(CLI::IsMember({"traced", "drawn"}));
  app.add_option(
         "--sun-at-hits", words.sun_at_hits,
         "the sun where rays of reflections and indirect light hit: ray (a shadow ray), map "
         "(a shadow map of the whole scene), none")
      ->capture_default_str()
      ->check(CLI::IsMember({"ray", "map", "none"}));
  app.add_option("--sun-map-size", options.frame.sun_map,
                 "texels along the side of that map (2048)")
      ->check(CLI::Range(1u, kMaxSunMap));
  app.add_option("--contact-length", words.contact_length, "length of these rays, in metres")
      ->capture_default_str()
      ->check(CLI::Range(0.0f, 1e6f));
  app.add_option("--gi-mode", words.gi_mode,
                 "indirect light: direct (the volume at the surface), hit-black, near-field, "
                 "near-field-glossy (hits mirror lights, too)")
      ->capture_default_str()
      ->check(CLI::IsMember({"direct", "hit-black", "near-field", "near-field-glossy"}));
  app.add_option("--gi-cell", options.frame.volume.cell,
                 "cells of the volume of indirect light, in metres (0.25, larger in large scenes)")
      ->check(CLI::Range(1e-3f, 1e3f));
  app.add_option("--gi-bake-samples", options.frame.volume.samples, "paths per cell, at most")
      ->capture_default_str()
      ->check(CLI::Range(1u, kMaxSamples));
  app.add_option("--gi-bake-error", options.frame.volume.error,
                 "relative standard error that is enough for a cell; 0: all paths")
      ->capture_default_str()
      ->check(CLI::Range(0.0f, 1.0f));
  app.add_option("--gi-bake-lights", words.bake_lights,
                 "lights that the volume holds, comma-separated: sun, sky, local, emissive (all)")
      ->delimiter(',')
      ->check(CLI::IsMember({"sun", "sky", "local", "emissive"}));
  app.add_option("--gi-volume", options.frame.volume.file,
                 "file of the volume: read if it exists, otherwise baked and written");
  app.add_option("--gi-length", words.gi_length, "length of indirect light's rays, in metres")
      ->capture_default_str()
      ->check(CLI::Range(0.0f, 1e6f));
  app.add_option("--reflection-length", words.reflection_length,
                 "length of the rays of a mirror, in metres")
      ->capture_default_str()
      ->check(CLI::Range(0.0f, 1e6f));
  app.add_option("--reflection-length-rough", words.reflection_length_rough,
                 "the same at roughness 1; in between, lengths fall exponentially")
      ->capture_default_str()
      ->check(CLI::Range(0.0f, 1e6f));
  app.add_option("--fireflies", words.fireflies,
                 "reflections brighter than twice white: keep, retrace (more rays where a pilot "
                 "ray is bright, which keeps the energy), or average (more rays where a sample is "
                 "bright, as in the talk, which loses some)")
      ->capture_default_str()
      ->check(CLI::IsMember({"keep", "retrace", "average"}));
  app.add_option("--firefly-limit", words.firefly_limit,
                 "multiples of white that a reflection's sample is clamped to (the talk: 10); "
                 "0: none")
      ->capture_default_str()
      ->check(CLI::Range(0.0f, 1e30f));
  app.add_flag("--curvature-roughness", options.frame.curvature_to_roughness,
               "surfaces are rougher where their normals vary from pixel to pixel");
  app.add_option("--glass-layers", words.glass_layers,
                 "nearest layers of glass that reflect; those behind are blended without an order")
      ->capture_default_str()
      ->check(CLI::Range(0u, kMaxSortedLayers));
  app.add_option("--seed", options.frame.seed, "the same seed gives the same picture")
      ->capture_default_str();
  app.add_option("--threads", options.threads, "0: all; the picture does not depend on it")
      ->capture_default_str()
      ->check(CLI::Range(0u, 1024u));
  app.add_option("--out", options.out, "folder for the results")->capture_default_str();
  app.add_option("--write-glb", options.write_glb, "write the scene to this .glb file too");
  add_output(app, options);
  add_engine(app, options, words);
  add_sequence(app, options);
  add_path_reference(app, options);
  app.add_flag("--watch", options.watch, "render again whenever a shader file changes");
  app.add_option("--pixel", words.pixel,
                 "x,y: print what each layer holds there instead of writing files")
      ->check(CLI::Validator([&](std::string& t) { return parse_pixel(t, options.pixel); }, ""));
  app.add_option("--tables", options.tables,
                 "print every shader table, as text or json, instead of rendering")
      ->expected(0, 1)
      ->default_str("text")
      ->check(CLI::IsMember({"text", "json"}));
  auto* explained =
      app.add_option("--explain", words.explain,
                     "x,y: print what every ray of that pixel met, and why it was taken or not")
          ->check(
              CLI::Validator([&](std::string& t) { return parse_pixel(t, options.explain); }, ""));
  app.add_flag("--json", options.json, "--explain prints JSON")->needs(explained);
  app.add_option(
         "--heatmap", options.heatmap,
         "anyhit, candidates, depth, rays or overdraw (with --primary raster): write a picture "
         "of these counts per pixel")
      ->check(CLI::IsMember({"anyhit", "candidates", "depth", "rays", "overdraw"}));
  app.add_flag("--list-devices", options.list_devices, "print the devices of every backend");
  app.add_option("--reference", options.reference,
                 "add layers NAME_reference: each effect with this many samples, not denoised")
      ->check(CLI::Range(1u, kMaxSamples));
  app.add_option("--split", options.split, describe_splits())->check(CLI::IsMember(split_names()));
  add_views(app, options);
  add_measuring(app, options, words.measuring);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    exit_code = app.exit(error) == 0 ? 0 : 2;
    return std::nullopt;
  }
  if (!options.split.empty() && app.count("--scene") == 0) {
    options.scene = find_split(options.split)->scene;
  }
  if (app.count("--effects") == 0) choose_for_views(options, words.effects);
  apply(words, options);
  show_views(options);
  options.cpu_clock = words.measuring.clock == "cpu";
  options.study = !words.measuring.study.empty();
  options.command = typed_command(argc, argv);
  FrameSettings& frame = options.frame;
  for (const auto& [name, text, chosen] :
       {std::tuple("--pixel", &words.pixel, &options.pixel),
        std::tuple("--explain", &words.explain, &options.explain)}) {
    if (!*chosen || ((*chosen)->first < frame.width && (*chosen)->second < frame.height)) {
      continue;
    }
    std::fprintf(stderr, "northlight: %s %s is outside the picture (%ux%u)\n", name, text->c_str(),
                 frame.width, frame.height);
    exit_code = 2;
    return std::nullopt;
  }
  if (const std::string found = conflict(options); !found.empty()) {
    std::fprintf(stderr, "northlight: %s\n", found.c_str());
    exit_code = 2;
    return std::nullopt;
  }
  apply_measuring(app, words.measuring, options);
  if (angle->count() != 0) frame.sun_angular_radius = words.sun_angle * 3.14159265f / 360.0f;
  return options;
}

}  // namespace northlight

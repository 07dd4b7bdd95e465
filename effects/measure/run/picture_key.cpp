// SPDX-License-Identifier: MIT
// Described settings are all in. Of what is not described each function names every member of a
// struct: one with a new member does not compile before somebody has decided whether pictures
// depend on it.
#include "effects/measure/run/picture_key.h"

#include <fmt/format.h>

#include <filesystem>

#include "effects/assets/scene/scene_checksum.h"
#include "effects/northlight/described_settings.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

template <class T>
void add_optional(Checksum& checksum, const std::optional<T>& value) {
  checksum.add_value(value.has_value());
  if (value) checksum.add_value(*value);
}

void add_program(Checksum& checksum) {
  std::error_code failed;
  const auto time = std::filesystem::last_write_time("/proc/self/exe", failed);
  if (!failed) checksum.add_value(time.time_since_epoch().count());
}

// Every described setting of the frame, or of one topic.
void add_described(Checksum& checksum, const FrameSettings& frame, const std::string& topic = {}) {
  for (const DescribedSetting& setting : describe_settings({})) {
    if (!topic.empty() && setting.topic != topic) continue;
    checksum.add(setting.full_name());
    checksum.add(value_text(setting.get(frame, {})));
  }
}

void add_effects(Checksum& checksum, const std::map<std::string, EffectSettings>& effects) {
  checksum.add_value(effects.size());
  for (const auto& [name, settings] : effects) {
    checksum.add(name);
    add_settings(checksum, settings);
  }
}

void add_frame(Checksum& checksum, const FrameSettings& frame) {
  // `order` and `rows` leave the picture as it is, but not its time.
  const auto& [width, height, seed, effects, whole_frame, denoise, volume, light_culling,
               light_maps, contact, taa, taa_constants, enlarge, enlarge_constants, moving,
               structures, order, primary, ray_cones, curvature_to_roughness, sun_angular_radius,
               sun_map, max_pass_views, rows] = frame;
  checksum.add_each(width, height, seed, whole_frame, taa, enlarge, moving, max_pass_views);
  add_effects(checksum, effects);
  add_described(checksum, frame);
  // What was read from a file may be anything.
  if (volume.file.empty()) return;
  std::error_code failed;
  checksum.add(volume.file);
  const auto time = std::filesystem::last_write_time(volume.file, failed);
  if (!failed) checksum.add_value(time.time_since_epoch().count());
}

}  // namespace

void add_settings(Checksum& checksum, const EffectSettings& settings) {
  const auto& [samples, pixel_step, rotates, radius, constants, constants_bytes, keep, named,
               trace_only] = settings;
  checksum.add_each(samples, pixel_step, rotates, radius, constants, constants_bytes, keep, named,
                    trace_only);
}

std::string as_key(const Checksum& checksum) {
  return fmt::format("{:016x}", checksum.value());
}

std::string picture_key(const Options& options, const Scene& scene) {
  // The picture does not depend on how often and how long it is measured; callers that keep numbers
  // add that to their key.
  const auto& [name, materials, sun, backend, precision, checked, threads, frame, effects,
               camera_path, frames_per_second, out, say, profile, split, reference, path_samples,
               bounces, seconds, each_lamp, glass_shadows, half, save_seconds, resume, committed,
               fronts_folder, measure, measure_reference, measure_truth, repeats, cpu_clock,
               families, rows, command, commit, quick, seeds] = options;
  Checksum checksum;
  add_scene(checksum, scene);  // with the materials and the sun that were changed
  checksum.add(name);          // which committed truth is its own
  checksum.add(backend);
  checksum.add(precision);
  checksum.add_each(checked, threads, frames_per_second, glass_shadows);
  add_optional(checksum, seconds);
  add_optional(checksum, bounces);
  checksum.add(camera_path);
  add_frame(checksum, frame);
  add_effects(checksum, effects);
  add_program(checksum);
  return as_key(checksum);
}

std::string volume_key(const Options& options, const Scene& scene) {
  Checksum checksum;
  add_scene(checksum, scene);
  checksum.add(options.precision);
  add_optional(checksum, options.seconds);
  const FrameSettings& frame = options.frame;
  checksum.add_each(frame.seed, frame.light_maps, frame.ray_cones, frame.sun_angular_radius,
                    frame.sun_map);
  add_described(checksum, frame, "volume");
  add_program(checksum);
  return as_key(checksum);
}

}  // namespace kaamos::measure

// SPDX-License-Identifier: MIT
#include "effects/measure/truth/committed_truth.h"

#include <cstdlib>
#include <filesystem>

#include "effects/assets/image/exr.h"
#include "effects/measure/truth/path_reference.h"

namespace kaamos::measure {

using namespace kaamos::effects;
namespace fs = std::filesystem;

namespace {

std::optional<ExrFile> committed_file(const Options& options) {
  const fs::path file = fs::path(options.committed) / (options.scene + ".exr");
  std::error_code ignored;
  if (options.committed.empty() || !fs::exists(file, ignored)) return std::nullopt;
  auto read = read_exr(file.string());
  if (!read.ok() || read.value().layers.empty()) return std::nullopt;
  return std::move(read.value());
}

std::string attribute(const ExrFile& file, const std::string& name) {
  const auto found = file.attributes.find(name);
  return found == file.attributes.end() ? std::string() : found->second;
}

// Returns whether the options ask for the same picture as the references were made with.
bool is_same_picture(const Options& options, const ExrFile& file) {
  const PathReferenceDesc wanted = describe_reference(options), made;
  const FloatImage& image = file.layers.front().image;
  return image.width == wanted.width && image.height == wanted.height && !options.seconds &&
         attribute(file, "seconds") == "none" && attribute(file, "scene") == options.scene &&
         attribute(file, "bounces") == "unlimited" && !options.bounces &&
         options.materials.empty() && !options.sun && !options.glass_shadows &&
         wanted.paths.occlusion_radius ==
             find_effect(northlight_effects(), "ao")->defaults.radius &&
         wanted.ray_cones == made.ray_cones &&
         wanted.sun_angular_radius == made.sun_angular_radius && wanted.seed == made.seed;
}

void add_layer(const ExrLayer& layer, double error, PathSums& sums) {
  sums.add_layer(layer.name.empty() ? "radiance" : layer.name, layer.image.channels);
  for (std::uint32_t half = 0; half < kPathHalves; ++half) {
    const double apart = half == 0 ? error : -error;
    auto& values = sums.layers.back().sums[half];
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = (layer.image.values[i] + apart) * sums.samples[half];
    }
  }
}

}  // namespace

std::optional<std::pair<std::uint32_t, std::uint32_t>> committed_size(const Options& options) {
  const auto file = committed_file(options);
  if (!file || attribute(*file, "seconds") != "none") return std::nullopt;
  const FloatImage& image = file->layers.front().image;
  return std::pair(image.width, image.height);
}

std::optional<PathSums> committed_truth(const Options& options) {
  const auto file = committed_file(options);
  if (!file || !is_same_picture(options, *file)) return std::nullopt;
  const auto samples =
      static_cast<std::uint32_t>(std::strtoul(attribute(*file, "samples").c_str(), nullptr, 10));
  if (samples < options.measure_truth || samples < kPathHalves) return std::nullopt;
  PathSums out;
  out.width = options.frame.width;
  out.height = options.frame.height;
  out.samples = {samples / 2, samples / 2};
  for (const ExrLayer& layer : file->layers) {
    const std::string name = layer.name.empty() ? "radiance" : layer.name;
    const double error = std::strtod(attribute(*file, "error." + name).c_str(), nullptr);
    add_layer(layer, error, out);
  }
  return out;
}

}  // namespace kaamos::measure

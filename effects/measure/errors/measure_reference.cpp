// SPDX-License-Identifier: MIT
#include "effects/measure/errors/measure_reference.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "effects/assets/image/exr.h"
#include "effects/measure/run/picture_key.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

constexpr std::uint32_t kProbeSeed = 0x0B5E55ED;
constexpr std::uint32_t kPartSeed = 0x5EED0000;  // no other run uses it

// Returns the key of a reference's file. Two samples of the picture are part of it, so that a
// driver that renders something else gets references of its own.
rtapi::Result<std::string> key_of(EffectRuns& runs, Setting setting, std::uint32_t samples) {
  Checksum checksum;
  checksum.add(runs.key(setting));
  checksum.add_value(samples);
  setting.settings.samples = 2;
  if (const auto s = runs.set_seed(kProbeSeed); !s) return s.error();
  if (const auto ran = runs.run(setting); !ran) return ran.error();
  const auto image = runs.read(setting);
  if (!image) return image.error();
  checksum.add_values(image->values);
  return as_key(checksum);
}

// The parts that an earlier run has finished.
std::vector<FloatImage> kept_parts(const std::string& path) {
  std::vector<FloatImage> out;
  if (!std::filesystem::exists(path)) return out;
  auto file = read_exr(path);
  if (!file.ok()) return out;  // damaged: render it again
  for (std::uint32_t part = 0; part < kReferenceParts; ++part) {
    const ExrLayer* layer = find_layer(file.value(), fmt::format("part{}", part));
    if (layer == nullptr) break;
    out.push_back(layer->image);
  }
  return out;
}

rtapi::Status keep_parts(const std::string& path, const std::vector<FloatImage>& parts) {
  ExrFile file;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    ExrLayer layer{fmt::format("part{}", part), parts[part]};
    file.layers.push_back(std::move(layer));
  }
  if (const auto written = write_exr(path, file); !written.ok()) {
    return written.error();
  }
  return {};
}

}  // namespace

Target mean_of(const std::vector<FloatImage>& parts, const std::vector<std::uint8_t>& mask) {
  Target out;
  out.image = parts.front();
  const double n = static_cast<double>(parts.size());
  double squares = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < out.image.values.size(); ++i) {
    double mean = 0, spread = 0;
    for (const FloatImage& part : parts) mean += part.values[i] / n;
    for (const FloatImage& part : parts) spread += std::pow(part.values[i] - mean, 2);
    out.image.values[i] = static_cast<float>(mean);
    if ((!mask.empty() && mask[i / out.image.channels] == 0) || !std::isfinite(spread)) continue;
    if (n > 1) squares += spread / (n * (n - 1));
    ++count;
  }
  out.mask = mask;
  out.own_rmse = count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0;
  return out;
}

rtapi::Result<Outcome> make_reference(EffectRuns& runs, const Setting& setting,
                                      std::uint32_t samples, const std::string& name,
                                      const std::string& cache, const Progress& progress,
                                      Target& target) {
  const auto key = key_of(runs, setting, samples);
  if (!key) return key.error();
  const Frame& frame = runs.renderer().frame();
  const std::string path =
      fmt::format("{}/{}-{}x{}-{}.exr", cache, name, frame.width(), frame.height(), *key);
  std::vector<FloatImage> parts = kept_parts(path);
  const std::uint32_t each = (samples + kReferenceParts - 1) / kReferenceParts;
  for (auto part = static_cast<std::uint32_t>(parts.size()); part < kReferenceParts; ++part) {
    Setting run = setting;
    run.settings.samples = each;
    if (const auto s = runs.set_seed(kPartSeed + part); !s) return s.error();
    const auto show = [&](const std::string&, double done) {
      return progress("reference " + name, (part + done) / kReferenceParts);
    };
    if (const auto s = runs.accumulate(run, show); !is_done(s)) return s;
    const auto image = runs.read(run);
    if (!image) return image.error();
    parts.push_back(*image);
    if (const auto kept = keep_parts(path, parts); !kept) return kept.error();
  }
  const auto mask = runs.mask(false);
  if (!mask) return mask.error();
  target = mean_of(parts, *mask);
  return Outcome::kDone;
}

}  // namespace kaamos::measure

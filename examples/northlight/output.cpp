// SPDX-License-Identifier: MIT
#include "output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "effects/assets/image/exr.h"
#include "effects/assets/image/png.h"
#include "effects/assets/image/tonemap.h"
#include "look.h"

namespace northlight {

using namespace kaamos::effects;
namespace {

// An octahedral normal as a colour: maps each axis from -1..1 to 0..1; black without a surface.
FloatImage normal_picture(const FloatImage& encoded, const FloatImage& ids) {
  FloatImage out(encoded.width, encoded.height, 3);
  for (std::uint32_t y = 0; y < encoded.height; ++y) {
    for (std::uint32_t x = 0; x < encoded.width; ++x) {
      if (ids.at(x, y, 0) == 0) continue;
      const float u = encoded.at(x, y, 0);
      const float v = encoded.at(x, y, 1);
      float n[3] = {u, v, 1 - std::abs(u) - std::abs(v)};
      if (n[2] < 0) {
        n[0] = (1 - std::abs(v)) * (u >= 0 ? 1.0f : -1.0f);
        n[1] = (1 - std::abs(u)) * (v >= 0 ? 1.0f : -1.0f);
      }
      const float length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
      for (std::uint32_t c = 0; c < 3; ++c) {
        out.at(x, y, c) = 0.5f + 0.5f * n[c] / length;
      }
    }
  }
  return out;
}

// Each instance gets its own colour.
FloatImage id_picture(const FloatImage& ids) {
  FloatImage out(ids.width, ids.height, 3);
  for (std::uint32_t y = 0; y < ids.height; ++y) {
    for (std::uint32_t x = 0; x < ids.width; ++x) {
      const float id = ids.at(x, y, 0);
      if (id == 0) continue;
      for (std::uint32_t c = 0; c < 3; ++c) {
        const float phase = id * 2.399963f + 2.0943951f * static_cast<float>(c);
        out.at(x, y, c) = 0.55f + 0.45f * std::cos(phase);
      }
    }
  }
  return out;
}

// Near is white, far is black, relative to the frame's depth range.
FloatImage distance_picture(const FloatImage& view_z) {
  float nearest = 1e30f;
  for (const float z : view_z.values) {
    if (z > 0) nearest = std::min(nearest, z);
  }
  FloatImage out(view_z.width, view_z.height, 1);
  for (std::size_t i = 0; i < view_z.values.size(); ++i) {
    out.values[i] = view_z.values[i] > 0 ? nearest / view_z.values[i] : 0.0f;
  }
  return out;
}

FloatImage first_channels(const FloatImage& image, std::uint32_t count) {
  FloatImage out(image.width, image.height, count);
  const std::size_t pixels = std::size_t{image.width} * image.height;
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::uint32_t c = 0; c < count; ++c) {
      out.values[i * count + c] = image.values[i * image.channels + c];
    }
  }
  return out;
}

bool is_light(const std::string& layer, const std::vector<Effect>& effects) {
  for (const Effect& effect : effects) {
    for (const EffectSignal& signal : effect.signals) {
      if (!signal.is_light) continue;
      for (const char* ending : {"", "_denoised", "_reference"}) {
        if (layer == signal.name + ending) return true;
      }
    }
  }
  return layer == "emissive" || layer == "radiance_reference";
}

// Makes the picture of a layer for a viewer: light as in the frame, everything else as numbers from
// 0 to 1.
ByteImage layer_picture(const std::string& name, const FloatImage& image, const FrameResult& result,
                        const FrameRenderer& renderer) {
  if (name == "normal" || name == "shading_normal") {
    return to_bytes(normal_picture(image, result.layers.at("ids")));
  }
  if (name == "ids") return to_bytes(id_picture(image));
  if (name == "depth" || name == "view_z") {
    return to_bytes(distance_picture(result.layers.at("view_z")), 1, 0, true);
  }
  if (name == "base_color") return to_bytes(first_channels(image, 3), 1, 0, true);
  if (is_light(name, renderer.context().effects)) {
    return tonemap(first_channels(image, 3), renderer.context().scene.exposure);
  }
  if (name == "position") return to_bytes(first_channels(image, 3), 0.05f, 0.5f);
  return to_bytes(image.channels == 4 ? first_channels(image, 3) : image);
}

nlohmann::ordered_json statistics(const Options& options, const Scene& scene,
                                  const FrameRenderer& renderer, const FrameResult& result) {
  nlohmann::ordered_json json;
  json["scene"] = scene.name;
  json["backend"] = renderer.device().GetInfo().Backend;
  json["precision"] = options.precision;
  json["device"] = renderer.device().GetInfo().Name;
  json["width"] = options.frame.width;
  json["height"] = options.frame.height;
  json["seed"] = options.frame.seed;
  json["threads"] = options.threads;
  for (const Effect& effect : renderer.context().effects) {
    const auto chosen = options.frame.effects.find(effect.name);
    json[effect.name + "_samples"] =
        chosen == options.frame.effects.end() ? 0 : chosen->second.samples;
  }
  const GpuSceneStatistics& s = renderer.context().gpu.statistics;
  json["build"] = {
      {"bottom_level_ms", s.bottom_level_ms},       {"top_level_ms", s.top_level_ms},
      {"bottom_level_bytes", s.bottom_level_bytes}, {"top_level_bytes", s.top_level_bytes},
      {"unique_triangles", s.unique_triangles},     {"instanced_triangles", s.instanced_triangles}};
  if (const auto& micromaps = renderer.context().gpu.micromaps) {
    const MicromapStatistics& m = micromaps->statistics;
    json["opacity_micromaps"] = {{"states", m.states},
                                 {"geometries", m.geometries},
                                 {"triangles", m.triangles},
                                 {"micromaps", m.micromaps},
                                 {"bytes", m.bytes},
                                 {"bake_ms", m.bake_ms},
                                 {"transparent", m.shares[0]},
                                 {"opaque", m.shares[1]},
                                 {"unknown", m.shares[2] + m.shares[3]}};
  }
  if (const auto& saved = result.micromaps) {
    json["opacity_micromaps"]["any_hit_calls"] = saved->calls;
    json["opacity_micromaps"]["any_hit_calls_without"] = saved->calls_without;
    json["opacity_micromaps"]["ms"] = saved->ms;
    json["opacity_micromaps"]["ms_without"] = saved->ms_without;
    json["opacity_micromaps"]["other_pixels"] = saved->other_pixels;
  }
  for (const PassStatistics& pass : result.passes) {
    const double rays = static_cast<double>(pass.rays.TraceRayCalls);
    json["passes"].push_back({{"name", pass.name},
                              {"ms", pass.ms},
                              {"rays", pass.rays.TraceRayCalls},
                              {"visibility_rays", pass.rays.VisibilityRays},
                              {"hits", pass.rays.Hits},
                              {"misses", pass.rays.Misses},
                              {"any_hit_calls", pass.rays.AnyHitInvocations},
                              {"bytes", pass.bytes},
                              {"mrays_per_s", pass.ms > 0 ? rays / pass.ms / 1000 : 0.0}});
  }
  if (const auto& bake = renderer.lights().bake()) {
    json["bake"] = {{"seconds", bake->seconds},     {"cells", bake->cells},
                    {"in_solids", bake->in_solids}, {"at_bound", bake->at_bound},
                    {"paths", bake->paths},         {"error", bake->error},
                    {"bytes", bake->bytes}};
  }
  json["left_out"] = result.left_out;
  if (const auto& primary = result.primary) {
    const PrimaryDifference& d = primary->difference;
    json["primary"] = {{"covered_pixels", d.covered},
                       {"pixels_per_triangle", d.pixels_per_triangle()},
                       {"share", d.share()},
                       {"expected_share", d.expected_share()},
                       {"expected_share_of_equals", d.expected_share_of_equals()},
                       {"neighbours", d.neighbours},
                       {"other_levels", d.other_levels},
                       {"silhouettes", d.silhouettes},
                       {"surfaces_close_by", d.others},
                       {"hit_or_not", d.hit_or_not},
                       {"draw_ms", primary->draw_ms},
                       {"resolve_ms", primary->resolve_ms},
                       {"ray_ms", primary->ray_ms}};
  }
  if (const auto& levels = result.levels) {
    json["levels"] = {{"pixels", levels->pixels},
                      {"lit", levels->lit},
                      {"false_shadows", levels->false_shadows},
                      {"false_light", levels->false_light}};
  }
  return json;
}

}  // namespace

ByteImage frame_picture(const FloatImage& radiance, float exposure) {
  return tonemap(first_channels(radiance, 3), exposure);
}

namespace {

// The layers of a frame that files hold.
std::map<std::string, const FloatImage*> written_layers(const FrameResult& result,
                                                        const WrittenLayers& written) {
  std::map<std::string, const FloatImage*> out;
  for (const auto& [name, image] : result.layers) {
    if (written.has(name)) out[name] = &image;
  }
  return out;
}

ExrFile exr_of(const Options& options, const Scene& scene, const FrameResult& result,
               const WrittenLayers& written) {
  ExrFile exr;
  exr.attributes = {{"scene", scene.name}, {"seed", std::to_string(options.frame.seed)}};
  exr.layers.push_back({"", result.radiance, false, {}});
  for (const auto& [name, image] : written_layers(result, written)) {
    // The file has one size, that of the frame, which may be enlarged.
    if (image->width != result.radiance.width || image->height != result.radiance.height) continue;
    exr.layers.push_back({name, *image, false, {}});
  }
  for (const ViewResult& view : result.views) {
    exr.layers.push_back({"view-" + view.name, view.numbers, false, view.channels});
  }
  return exr;
}

}  // namespace

std::string add_results(const Options& options, const Scene& scene, const FrameRenderer& renderer,
                        const FrameResult& result, const WrittenLayers& written,
                        const nlohmann::ordered_json& sequence, StagedFiles& files) {
  const auto step = Profile::enter(options.profile, ProfilePart::kFiles, "encode and write");
  std::vector<EncodedFile> encoded;
  // The longest work comes first.
  encoded.push_back({"frame.exr", [&] {
                       return encode_exr(exr_of(options, scene, result, written), options.threads);
                     }});
  encoded.push_back(
      {"frame.png", [&] { return encode_png(frame_picture(result.radiance, scene.exposure)); }});
  for (const auto& [name, image] : written_layers(result, written)) {
    encoded.push_back({name + ".png", [&result, &renderer, name = name, image = image] {
                         return encode_png(layer_picture(name, *image, result, renderer));
                       }});
  }
  for (const ViewResult& view : result.views) {
    encoded.push_back({"view-" + view.name + ".png", [&view] { return encode_png(view.picture); }});
  }
  encoded.push_back({"stats.json", [&]() -> Result<std::vector<std::uint8_t>> {
                       auto json = statistics(options, scene, renderer, result);
                       if (!sequence.is_null()) json["sequence"] = sequence;
                       const std::string text = json.dump(2) + "\n";
                       return std::vector<std::uint8_t>(text.begin(), text.end());
                     }});
  return files.add(encoded, options.threads);
}

std::string write_results(const Options& options, const Scene& scene, const FrameRenderer& renderer,
                          const FrameResult& result, const WrittenLayers& written) {
  StagedFiles files(options.out);
  if (auto error = files.create(); !error.empty()) return error;
  if (auto error = add_results(options, scene, renderer, result, written, {}, files);
      !error.empty()) {
    return error;
  }
  const auto step = Profile::enter(options.profile, ProfilePart::kFiles, "publish");
  return files.publish();
}

std::string describe_pixel(const FrameResult& result, std::uint32_t x, std::uint32_t y) {
  std::string out;
  const auto add = [&](const std::string& name, const FloatImage& image) {
    out += fmt::format("{:<16}", name);
    for (std::uint32_t c = 0; c < image.channels; ++c)
      out += fmt::format(" {:.9g}", image.at(x, y, c));
    out += "\n";
  };
  for (const auto& [name, image] : result.layers) add(name, image);
  for (const ViewResult& view : result.views) add("view-" + view.name, view.numbers);
  add("radiance", result.radiance);
  return out;
}

std::string describe_files(const Options& options, const FrameRenderer& renderer,
                           const WrittenLayers& written) {
  std::string out = fmt::format("wrote {}/frame.png, frame.exr, stats.json", options.out);
  for (const std::string& name : written.names()) out += ", " + name + ".png";
  // Beside them there is "radiance", which is the frame.
  if (written.names().size() + 1 < renderer.layers().size()) {
    out += "; --layers all writes every layer";
  }
  return out + "\n";
}

static double mebibytes(std::uint64_t bytes) {
  return static_cast<double>(bytes) / 1048576.0;
}

std::string list_devices() {
  std::string out;
  bool has_vulkan = false;
  for (const rtapi::DeviceInfo& info : rtapi::EnumerateDevices()) {
    out += fmt::format("{:<8} {}\n", info.Backend,
                       info.Description.empty() ? info.Name : info.Description);
    has_vulkan = has_vulkan || info.Backend == "vulkan";
  }
  if (has_vulkan) return out;
  rtapi::DeviceDesc desc;
  desc.Backend = "vulkan";
  if (const auto device = rtapi::CreateDevice(desc); !device) {
    out += fmt::format("{:<8} none: {}\n", desc.Backend, device.error().message);
  }
  return out;
}

std::string describe_primary(const FrameResult& result) {
  if (!result.primary) return {};
  const PrimaryComparison& primary = *result.primary;
  const PrimaryDifference& d = primary.difference;
  return fmt::format(
      "drawn in {:.1f} ms and resolved in {:.1f} ms; primary rays take {:.1f} ms\n"
      "{:.2e} of {} covered pixels show another triangle than rays hit, {} in all: {} a neighbour, "
      "{} another level of detail, {} beyond a silhouette, {} another surface close by, {} "
      "something "
      "or nothing\n"
      "vertices snap to 1/256 pixel: by the length of the triangles' edges that makes {:.2e}, and "
      "with {:.1f} pixels a triangle, if all were equal, {:.2e}\n",
      primary.draw_ms, primary.resolve_ms, primary.ray_ms, d.share(), d.covered, d.differing(),
      d.neighbours, d.other_levels, d.silhouettes, d.others, d.hit_or_not, d.expected_share(),
      d.pixels_per_triangle(), d.expected_share_of_equals());
}

std::string describe_levels(const FrameResult& result) {
  if (!result.levels) return {};
  const LevelMismatch& m = *result.levels;
  const auto share = [](std::uint64_t count, std::uint64_t of) {
    return 100.0 * static_cast<double>(count) / static_cast<double>(std::max<std::uint64_t>(of, 1));
  };
  return fmt::format(
      "rays see other levels of detail than draws: of {} lit pixels of such instances {} ({:.1f} "
      "%) "
      "are in a false shadow, of {} dark ones {} ({:.1f} %) in false light\n",
      m.lit, m.false_shadows, share(m.false_shadows, m.lit), m.pixels - m.lit, m.false_light,
      share(m.false_light, m.pixels - m.lit));
}

static std::string describe_micromaps(const FrameRenderer& renderer, const FrameResult& result) {
  const auto& micromaps = renderer.context().gpu.micromaps;
  if (!micromaps) return {};
  const MicromapStatistics& m = micromaps->statistics;
  std::string out = fmt::format(
      "opacity micromaps of {} states: {} for {} triangles of {} geometries, {:.1f} MiB, baked in "
      "{:.0f} ms; of the triangles {:.0f} % are transparent, {:.0f} % opaque, {:.0f} % unknown\n",
      m.states, m.micromaps, m.triangles, m.geometries, mebibytes(m.bytes), m.bake_ms,
      100 * m.shares[0], 100 * m.shares[1], 100 * (m.shares[2] + m.shares[3]));
  if (const auto& saved = result.micromaps) {
    const auto without = static_cast<double>(std::max<std::uint64_t>(saved->calls_without, 1));
    out += fmt::format(
        "without them: {} any-hit calls instead of {} ({:.0f} % are saved), {:.1f} ms instead of "
        "{:.1f} in passes with rays, {} pixels differ\n",
        saved->calls_without, saved->calls, 100 * (1 - static_cast<double>(saved->calls) / without),
        saved->ms_without, saved->ms, saved->other_pixels);
  }
  return out;
}

std::string describe(const FrameRenderer& renderer, const FrameResult& result) {
  const GpuSceneStatistics& s = renderer.context().gpu.statistics;
  std::string out = fmt::format(
      "{}\nscene: {} triangles ({} unique), built in {:.0f} ms, {:.1f} MiB\n\n"
      "{:<20}{:>10}{:>12}{:>12}{:>12}{:>10}{:>9}\n",
      renderer.device().GetInfo().Name, s.instanced_triangles, s.unique_triangles,
      s.bottom_level_ms + s.top_level_ms, mebibytes(s.bottom_level_bytes + s.top_level_bytes),
      "pass", "ms", "rays", "hits", "any-hit", "Mrays/s", "MiB");
  for (const PassStatistics& pass : result.passes) {
    const double rays = static_cast<double>(pass.rays.TraceRayCalls);
    out += fmt::format("{:<20}{:>10.1f}{:>12}{:>12}{:>12}{:>10.2f}{:>9}\n", pass.name, pass.ms,
                       pass.rays.TraceRayCalls, pass.rays.Hits, pass.rays.AnyHitInvocations,
                       pass.ms > 0 ? rays / pass.ms / 1000 : 0.0,
                       pass.bytes == 0 ? "" : fmt::format("{:.1f}", mebibytes(pass.bytes)));
  }
  if (const auto& bake = renderer.lights().bake()) {
    out += fmt::format(
        "baked {} cells in {:.1f} s with {:.0f} paths each, good to {:.1f} % on average{}; "
        "{:.1f} MiB\n",
        bake->cells, bake->seconds,
        static_cast<double>(bake->paths) /
            static_cast<double>(std::max<std::uint64_t>(bake->cells, 1)),
        100 * bake->error, renderer.lights().bakes_on_demand() ? ", before cells are filtered" : "",
        mebibytes(bake->bytes));
  }
  out += describe_micromaps(renderer, result) + describe_primary(result) + describe_levels(result) +
         describe_views(result);
  for (const std::string& part : result.left_out) out += "left out: " + part + "\n";
  if (!result.left_out.empty()) out += "--measure-left-out shows what this saves\n";
  return out;
}

}  // namespace northlight

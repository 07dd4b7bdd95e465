// SPDX-License-Identifier: MIT
#include "sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "effects/assets/built_in/light_forest.h"
#include "effects/measure/run/camera_choice.h"
#include "effects/measure/run/failure.h"
#include "look.h"

namespace northlight {

using namespace kaamos::effects;

namespace {

using Clock = std::chrono::steady_clock;

std::string frame_name(std::uint32_t index) {
  return fmt::format("frame_{:04}.png", index);
}

// Follows pictures of the frame from one frame to the next.
class FlickerMeter {
 public:
  // `cut`: do not compare with the previous frame.
  rtapi::Status measure(FrameRenderer& renderer, bool cut) {
    struct Pair {
      std::string name;
      rtapi::Texture raw;
      std::optional<rtapi::Texture> filtered;
    };
    std::vector<Pair> pairs;
    const SignalFilters& filters = renderer.filters().signals();
    for (const auto& signal : filters.signals()) {
      pairs.push_back({signal.name, signal.mean, filters.denoised(signal)});
    }
    pairs.push_back({"frame", renderer.frame().texture(kRadiance), {}});
    if (renderer.composition().taa() != nullptr)
      pairs.back().filtered = renderer.composition().taa()->result();
    const auto motion = renderer.read(renderer.frame().texture(kMotion));
    if (!motion) return motion.error();
    const auto view_z = renderer.read(renderer.frame().texture(kViewZ));
    if (!view_z) return view_z.error();
    const FrameSurfaces surfaces = {*view_z, *motion};
    tracks_.resize(pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      Track& track = tracks_[i];
      track.line.name = pairs[i].name;
      if (const auto s = follow(renderer, pairs[i].raw, surfaces, cut, track.raw, track.line.raw);
          !s) {
        return s;
      }
      if (!pairs[i].filtered) continue;
      if (!track.line.filtered) track.line.filtered.emplace();
      if (const auto s = follow(renderer, *pairs[i].filtered, surfaces, cut, track.filtered,
                                *track.line.filtered);
          !s) {
        return s;
      }
    }
    previous_view_z_ = std::move(surfaces.view_z);
    return {};
  }

  std::vector<FlickerLine> lines() const {
    std::vector<FlickerLine> out;
    for (const Track& track : tracks_) out.push_back(track.line);
    return out;
  }

 private:
  struct Track {
    FlickerLine line;
    FloatImage raw, filtered;  // of the previous frame
  };

  rtapi::Status follow(FrameRenderer& renderer, const rtapi::Texture& picture,
                       const FrameSurfaces& surfaces, bool cut, FloatImage& before,
                       TemporalChange& sum) const {
    auto now = renderer.read(picture);
    if (!now) return now.error();
    if (!cut) {
      const auto change = temporal_change(before, *now, previous_view_z_, surfaces);
      if (!change.ok()) return change.error();
      sum.add(change.value());
    }
    before = std::move(*now);
    return {};
  }

  std::vector<Track> tracks_;
  FloatImage previous_view_z_;
};

// One progress line for the whole sequence; a pass's progress counts as part of its frame.
Progress progress_of_frame(const Progress& progress, std::uint32_t index, std::uint32_t count) {
  return [&progress, index, count](const std::string& pass, double) {
    return progress(fmt::format("{:.20}", fmt::format("{}/{} {}", index + 1, count, pass)),
                    static_cast<double>(index) / count);
  };
}

nlohmann::ordered_json to_json(const StructureStatistics& s) {
  return {{"skinned", s.skinned},
          {"skinned_vertices", s.skinned_vertices},
          {"updated", s.updated},
          {"rebuilt", s.rebuilt},
          {"skipped", s.skipped},
          {"moved_instances", s.moved_instances},
          {"barriers", s.barriers},
          {"skinning_ms", s.skinning_ms},
          {"bottom_level_ms", s.bottom_level_ms},
          {"top_level_ms", s.top_level_ms}};
}

nlohmann::ordered_json to_json(const TemporalChange& change) {
  return {{"mean", change.mean()},
          {"relative", change.relative()},
          {"hidden_pixels", change.hidden},
          {"not_finite", change.not_finite}};
}

nlohmann::ordered_json to_json(const SequenceResult& sequence, const Options& options) {
  nlohmann::ordered_json json;
  json["frames"] = sequence.frames.size();
  json["frames_per_second"] = options.frames_per_second;
  json["camera_path"] = sequence.path;
  json["taa"] = options.frame.taa;
  for (std::size_t i = 0; i < sequence.frames.size(); ++i) {
    const SequenceFrame& frame = sequence.frames[i];
    nlohmann::ordered_json line = {{"frame", i}, {"ms", frame.ms}};
    if (frame.cut) line["cut"] = true;
    for (const PassStatistics& pass : frame.passes) line["passes_ms"][pass.name] = pass.ms;
    if (frame.structures) line["structures"] = to_json(*frame.structures);
    json["table"].push_back(std::move(line));
  }
  for (const FlickerLine& line : sequence.flicker) {
    json["flicker"][line.name]["raw"] = to_json(line.raw);
    if (line.filtered) json["flicker"][line.name]["filtered"] = to_json(*line.filtered);
  }
  return json;
}

std::string describe_structures(const std::vector<SequenceFrame>& frames) {
  StructureStatistics sum;
  for (const SequenceFrame& frame : frames) {
    if (!frame.structures) return {};
    sum.updated += frame.structures->updated;
    sum.rebuilt += frame.structures->rebuilt;
    sum.skipped += frame.structures->skipped;
    sum.skinned += frame.structures->skinned;
    sum.skinning_ms += frame.structures->skinning_ms;
    sum.bottom_level_ms += frame.structures->bottom_level_ms;
    sum.top_level_ms += frame.structures->top_level_ms;
  }
  const auto count = static_cast<double>(frames.size());
  return fmt::format(
      "structures: {} skinned, {} updated, {} rebuilt, {} skipped; a frame: skinning {:.2f} ms, "
      "bottom levels {:.2f} ms, top level {:.2f} ms\n",
      sum.skinned, sum.updated, sum.rebuilt, sum.skipped, sum.skinning_ms / count,
      sum.bottom_level_ms / count, sum.top_level_ms / count);
}

std::string describe_flicker(const std::vector<FlickerLine>& lines) {
  std::string out = fmt::format("\n{:<20}{:>10}{:>12}   mean change per frame beyond motion\n",
                                "flicker", "raw", "filtered");
  for (const FlickerLine& line : lines) {
    out += fmt::format("{:<20}{:>10.5f}", line.name, line.raw.mean());
    out += line.filtered ? fmt::format("{:>12.5f}\n", line.filtered->mean()) : "           -\n";
  }
  return out;
}

}  // namespace

rtapi::Result<Outcome> render_sequence(FrameRenderer& renderer, Scene& scene,
                                       const Options& options, const Progress& progress,
                                       StagedFiles& files, SequenceResult& out) {
  const auto path = choose_path(options, scene);
  if (!path.ok()) return path.error();
  out.path = path.value().name;
  auto written = WrittenLayers::choose(options, renderer);
  if (!written) return written.error();
  out.written = std::move(*written);
  if (const auto s = renderer.prepare(progress); !is_done(s)) return s;
  FlickerMeter flicker;
  double before = 0;
  for (std::uint32_t i = 0; i < options.frames; ++i) {
    FrameMoment moment;
    moment.index = i;
    moment.seconds = i / options.frames_per_second;
    moment.camera = evaluate_camera(path.value(), scene.cameras.front(), moment.seconds);
    moment.cut = i > 0 && has_cut(path.value(), before, moment.seconds);
    before = moment.seconds;
    kaamos::effects::move_lights(scene, moment.seconds);
    const auto start = Clock::now();
    if (const auto s = renderer.begin_frame(moment); !s) return s.error();
    if (const auto s = renderer.render(progress_of_frame(progress, i, options.frames));
        !is_done(s)) {
      return s;
    }
    SequenceFrame frame;
    frame.ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    const auto radiance = renderer.read("radiance");
    if (!radiance) return radiance.error();
    if (const auto s = flicker.measure(renderer, i == 0 || moment.cut); !s) return s.error();
    const auto step = Profile::enter(options.profile, ProfilePart::kFiles, "PNG of each frame");
    const auto error = files.add(frame_name(i), frame_picture(*radiance, scene.exposure));
    if (!error.empty()) return failure(error);
    frame.passes = renderer.runner().passes();
    if (renderer.scene_stage().structures() != nullptr)
      frame.structures = *renderer.scene_stage().structures();
    frame.cut = moment.cut;
    out.frames.push_back(std::move(frame));
  }
  auto last = read_frame(renderer, out.written.reads());
  if (!last) return last.error();
  out.last = std::move(*last);
  out.last.passes = renderer.runner().passes();
  if (const auto s = add_views(options, renderer, out.last); !s) return s.error();
  out.flicker = flicker.lines();
  progress("sequence", 1);
  return Outcome::kDone;
}

std::string add_results(const Options& options, const Scene& scene, const FrameRenderer& renderer,
                        const SequenceResult& sequence, StagedFiles& files) {
  return add_results(options, scene, renderer, sequence.last, sequence.written,
                     to_json(sequence, options), files);
}

std::string describe(const FrameRenderer& renderer, const SequenceResult& sequence) {
  const auto count = static_cast<double>(sequence.frames.size());
  double ms = 0;
  for (const SequenceFrame& frame : sequence.frames) ms += frame.ms;
  std::string out = fmt::format(
      "{}\n{} frames, camera path {}: {:.1f} ms a frame\n\n{:<20}{:>10}{:>10}{:>10}{:>14}{:>10}\n",
      renderer.device().GetInfo().Name, sequence.frames.size(), sequence.path, ms / count, "pass",
      "mean ms", "least", "most", "rays a frame", "Mrays/s");
  // Every frame has the same passes.
  for (std::size_t i = 0; i < sequence.last.passes.size(); ++i) {
    double sum = 0, rays = 0, least = 1e300, most = 0;
    for (const SequenceFrame& frame : sequence.frames) {
      const PassStatistics& pass = frame.passes[i];
      sum += pass.ms;
      rays += static_cast<double>(pass.rays.TraceRayCalls);
      least = std::min(least, pass.ms);
      most = std::max(most, pass.ms);
    }
    out += fmt::format("{:<20}{:>10.1f}{:>10.1f}{:>10.1f}{:>14.0f}{:>10.2f}\n",
                       sequence.last.passes[i].name, sum / count, least, most, rays / count,
                       sum > 0 ? rays / sum / 1000 : 0.0);
  }
  return out + describe_structures(sequence.frames) + describe_primary(sequence.last) +
         describe_views(sequence.last) + describe_flicker(sequence.flicker);
}

void remove_later_frames(const std::string& folder, std::uint32_t count) {
  std::error_code failed;
  while (std::filesystem::remove(std::filesystem::path(folder) / frame_name(count), failed)) {
    ++count;
  }
}

}  // namespace northlight

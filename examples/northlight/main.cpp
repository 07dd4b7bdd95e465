// SPDX-License-Identifier: MIT
// The demo: Northlight's ray traced effects over a scene, as one frame or a sequence.
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <functional>
#include <glm/trigonometric.hpp>
#include <string>
#include <utility>

#include "effects/assets/built_in/built_in.h"
#include "effects/assets/gltf/gltf_load.h"
#include "effects/assets/gltf/gltf_write.h"
#include "effects/assets/scene/levels.h"
#include "effects/assets/scene/material_override.h"
#include "effects/assets/scene/pieces.h"
#include "effects/assets/scene/staging.h"
#include "effects/measure/claims/claims.h"
#include "effects/measure/claims/left_out.h"
#include "effects/measure/comparison/reference.h"
#include "effects/measure/comparison/split.h"
#include "effects/measure/curves/measure.h"
#include "effects/measure/run/frame_result.h"
#include "effects/measure/study/study.h"
#include "effects/measure/truth/path_reference.h"
#include "effects/reflections/environment_map/probe_places.h"
#include "inspect.h"
#include "look.h"
#include "options.h"
#include "options_quality.h"
#include "output.h"
#include "profile_table.h"
#include "sequence.h"
#include "watch.h"

namespace {

using namespace northlight;
using kaamos::effects::FrameRenderer;
using kaamos::effects::Profile;
using kaamos::effects::ProfilePart;
using kaamos::effects::Scene;
using northlight::Options;  // not that of what is measured

constexpr int kInterrupted = 130;  // 128 + SIGINT, as shells report it

std::atomic<bool> stop_requested{false};
void on_interrupt(int) {
  stop_requested = true;
}

void say_error(const std::string& text) {
  std::fprintf(stderr, "northlight: %s\n", text.c_str());
}

// At once, also into a pipe.
void print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

bool load_scene(const Options& options, Scene& scene) {
  if (const auto* built_in = kaamos::effects::find_built_in_scene(options.scene)) {
    scene = built_in->make();
    return true;
  }
  auto loaded = kaamos::effects::load_gltf(
      options.scene, {.animated = options.frames > 0 || options.seconds.has_value()});
  if (!loaded.ok()) {
    say_error(loaded.error().message);
    return false;
  }
  for (const std::string& warning : loaded.value().warnings) {
    std::fprintf(stderr, "northlight: warning: %s\n", warning.c_str());
  }
  scene = std::move(loaded.value().scene);
  // A tree alone has nothing to cast its shadow on.
  if (!loaded.value().complete && kaamos::effects::needs_ground(scene))
    kaamos::effects::add_ground(scene);
  return true;
}

// Prepares a scene for upload.
void prepare_geometry(const Options& options, Scene& scene) {
  if (options.frames == 0 && !options.seconds)
    kaamos::effects::show_levels(scene, scene.cameras.front());
  if (options.piece_triangles == 0) return;
  const std::size_t before = scene.meshes.size();
  const std::size_t split = kaamos::effects::split_into_pieces(scene, options.piece_triangles);
  std::fprintf(stderr, "northlight: %zu of %zu meshes split: %zu now\n", split, before,
               scene.meshes.size());
}

bool override_materials(const Options& options, Scene& scene) {
  for (const std::string& text : options.materials) {
    const auto change = kaamos::effects::parse_material_override(text);
    if (!change.ok()) {
      say_error(change.error().message);
      return false;
    }
    const auto changed = kaamos::effects::override_material(scene, change.value());
    if (!changed.ok()) {
      say_error(changed.error().message);
      return false;
    }
  }
  return true;
}

// Puts the sun where the options want it; a scene without one gets the default one there.
void place_sun(const Options& options, Scene& scene) {
  if (!options.sun) return;
  if (!scene.sun) scene.sun = kaamos::effects::default_sun();
  const float azimuth = glm::radians(options.sun->first);
  const float elevation = glm::radians(options.sun->second);
  scene.sun->direction_to_sun = {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                                 std::cos(azimuth) * std::cos(elevation)};
}

// Estimates how long a pass that is partly done will still take, at the speed that it has had so
// far.
std::string time_left(const std::string& pass, double done) {
  using Clock = std::chrono::steady_clock;
  static std::string current;
  static Clock::time_point start;
  static double done_at_start = 0;
  if (pass != current || done < done_at_start) {
    current = pass;
    start = Clock::now();
    done_at_start = done;
  }
  const double elapsed = std::chrono::duration<double>(Clock::now() - start).count();
  if (elapsed < 2 || done >= 1 || done <= done_at_start) return "";
  char text[32];
  std::snprintf(text, sizeof text, ", %.0f s left", elapsed * (1 - done) / (done - done_at_start));
  return text;
}

// A progress bar on a terminal, nothing in a log. False after Ctrl-C.
bool show_progress(const std::string& pass, double done) {
  static const bool terminal = isatty(STDERR_FILENO) != 0;
  if (!terminal) return !stop_requested;
  constexpr int kWidth = 40;
  const int filled = static_cast<int>(done * kWidth);
  std::fprintf(stderr, "\r%-20s [%.*s%*s] %3.0f %%%-16s%s", pass.c_str(), filled,
               "########################################", kWidth - filled, "", done * 100,
               time_left(pass, done).c_str(), done >= 1 ? "\n" : "");
  std::fflush(stderr);
  return !stop_requested;
}

int report(const rtapi::Error& error) {
  say_error(error.message);
  return 1;
}

// The exit code of work that may be stopped.
int report(const rtapi::Result<Outcome>& result, const Options& options) {
  if (!result) return report(result.error());
  if (*result == Outcome::kDone) return 0;
  std::fprintf(stderr, "\n");
  say_error("interrupted: nothing was written, earlier results in " + options.out +
            " are unchanged");
  return kInterrupted;
}

int write_frame(FrameRenderer& renderer, const Options& options, const FrameResult& frame,
                const WrittenLayers& written, const Inspection& seen) {
  if (options.pixel) {
    std::fputs(describe_pixel(frame, options.pixel->first, options.pixel->second).c_str(), stdout);
    return 0;
  }
  if (options.explain) {
    std::fputs(print_explanations(seen.explained, options.json).c_str(), stdout);
    return 0;
  }
  if (!options.heatmap.empty()) {
    std::string said;
    const std::string error = write_heatmap(options, seen, said);
    if (!error.empty()) say_error(error);
    std::fputs(said.c_str(), stdout);
    return error.empty() ? 0 : 1;
  }
  if (const std::string error =
          write_results(options, renderer.context().scene, renderer, frame, written);
      !error.empty()) {
    say_error(error);
    return 1;
  }
  std::printf("%s\n%s", describe(renderer, frame).c_str(),
              describe_files(options, renderer, written).c_str());
  std::fflush(stdout);
  return 0;
}

// A reference that was stopped has written what it has.
int render_reference(const Options& options, const Scene& scene, const Ranks& ranks) {
  const auto show = [&](const std::string& what, double done) {
    return ranks.is_first() ? show_progress(what, done) : !stop_requested.load();
  };
  std::string said;
  const auto done = render_path_reference(options, scene, ranks, show, said);
  print(said);
  if (!done) return report(done.error());
  return *done == Outcome::kDone ? 0 : kInterrupted;
}

int render_once(FrameRenderer& renderer, const Options& options) {
  const auto written = WrittenLayers::choose(options, renderer);
  if (!written) return report(written.error());
  Inspection seen;
  inspect(options, renderer, seen);
  FrameResult frame;
  auto done = render_frame(renderer, show_progress, frame, written->reads());
  if (is_done(done)) {
    if (const auto s = add_views(options, renderer, frame); !s) return report(s.error());
  }
  if (is_done(done) && options.reference > 0) {
    done = add_reference(options, renderer.context().scene, show_progress, frame);
  }
  if (is_done(done) && options.frame.structures.opacity_micromaps != 0) {
    done = compare_micromaps(options, renderer.context().scene, show_progress, frame);
  }
  return is_done(done) ? write_frame(renderer, options, frame, *written, seen)
                       : report(done, options);
}

int render_frames(FrameRenderer& renderer, Scene& scene, const Options& options) {
  StagedFiles files(options.out);
  std::string error = files.create();
  if (error.empty()) {
    SequenceResult sequence;
    const auto done = render_sequence(renderer, scene, options, show_progress, files, sequence);
    if (!is_done(done)) return report(done, options);
    error = add_results(options, renderer.context().scene, renderer, sequence, files);
    if (error.empty()) error = files.publish();
    if (error.empty()) {
      remove_later_frames(options.out, options.frames);
      std::printf("%s\nwrote %s/frame_0000.png to frame_%04u.png\n%s",
                  describe(renderer, sequence).c_str(), options.out.c_str(), options.frames - 1,
                  describe_files(options, renderer, sequence.written).c_str());
      return 0;
    }
  }
  say_error(error);
  return 1;
}

using Measuring = std::function<rtapi::Result<Outcome>(const kaamos::measure::Options& options,
                                                       const Scene& scene, const Progress& progress,
                                                       std::string& said)>;

// Returns the measurement that the options ask for instead of rendering a frame; null: none.
Measuring find_measuring(const Options& options) {
  if (!options.measure.empty()) return run_measure;
  if (options.study) return run_study;
  if (options.claims) return run_claims;
  if (!options.split.empty()) return run_split;
  return options.measure_left_out ? measure_left_out : Measuring();
}

// Runs until Ctrl-C: shows errors in shaders and waits for the next change.
int watch(FrameRenderer& renderer, const Options& options) {
  const auto folder = find_effects_folder();
  if (folder.empty()) {
    say_error("--watch needs the effects' shader files: name their folder in $KAAMOS_EFFECTS");
    return 1;
  }
  ShaderWatcher watcher(folder, kaamos::effects::frame_libraries(renderer.context().settings),
                        options.backend == "vulkan");
  std::printf("watching %s; Ctrl-C ends\n", folder.c_str());
  do {
    auto libraries = watcher.compile();
    if (!libraries) {
      std::fprintf(stderr, "%s\n", libraries.error().message.c_str());
      continue;
    }
    renderer.set_libraries(std::move(*libraries));
    if (render_once(renderer, options) == kInterrupted) return kInterrupted;
  } while (watcher.wait(stop_requested));
  return 0;
}

// Loads the scene and changes it as the options want.
bool make_scene(const Options& options, Scene& scene) {
  const auto step = Profile::enter(options.profile, ProfilePart::kStart, "scene");
  if (!load_scene(options, scene) || !override_materials(options, scene)) return false;
  place_sun(options, scene);
  if (options.probes == "camera") scene.probes = {kaamos::effects::camera_probe(scene)};
  if (!options.write_glb.empty()) {
    if (const auto written = kaamos::effects::write_glb(options.write_glb, scene); !written.ok()) {
      say_error(written.error().message);
      return false;
    }
  }
  prepare_geometry(options, scene);
  return true;
}

int render(FrameRenderer& renderer, Scene& scene, const Options& options) {
  if (const auto s = check_views(options, renderer); !s) return report(s.error());
  if (options.watch) return watch(renderer, options);
  if (!options.tables.empty()) {
    const auto tables = describe_tables(renderer);
    if (!tables) return report(tables.error());
    std::fputs(print_tables(*tables, options.tables == "json").c_str(), stdout);
    return 0;
  }
  if (options.frames > 0) return render_frames(renderer, scene, options);
  return render_once(renderer, options);
}

int run(Options& options) {
  const bool prints =
      options.pixel || options.explain || !options.tables.empty() || options.measure_left_out;
  if (const std::string error = prints ? "" : prepare_folder(options.out); !error.empty()) {
    say_error(error);
    return 1;
  }
  Scene scene;
  if (!make_scene(options, scene)) return 1;
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  if (options.path_samples > 0) {
    const Ranks ranks;
    return render_reference(options, scene, ranks);
  }
  if (const Measuring measure = find_measuring(options)) {
    std::string said;
    const auto done = measure(options, scene, show_progress, said);
    print(said);
    return report(done, options);
  }
  if (options.goal) {
    std::string said;
    const auto done = choose_techniques(options, scene, show_progress, said);
    if (!is_done(done)) return report(done, options);
    print(said);
  }
  auto renderer = create_renderer(options, scene, say_error);
  if (!renderer) return report(renderer.error());
  const int code = render(**renderer, scene, options);
  const auto step = Profile::enter(options.profile, ProfilePart::kRest, "release");
  renderer->reset();
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  kaamos::effects::Profile profile;
  int exit_code = 0;
  auto options = parse_options(argc, argv, exit_code);
  if (!options) return exit_code;
  options->say = say_error;
  if (options->list_devices) {
    std::fputs(list_devices().c_str(), stdout);
    return 0;
  }
  if (options->shows_profile) options->profile = &profile;
  exit_code = run(*options);
  if (options->shows_profile) print(print_profile(profile.steps()));
  return exit_code;
}

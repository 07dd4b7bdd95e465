// SPDX-License-Identifier: MIT
// The demo: Northlight's ray traced effects over a scene, as one frame or a sequence.
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <string>

#include "claims.h"
#include "effects/scene/built_in.h"
#include "effects/scene/gltf_load.h"
#include "effects/scene/gltf_write.h"
#include "effects/scene/levels.h"
#include "effects/scene/material_override.h"
#include "effects/scene/pieces.h"
#include "effects/scene/staging.h"
#include "inspect.h"
#include "left_out.h"
#include "measure.h"
#include "options.h"
#include "output.h"
#include "reference.h"
#include "renderer.h"
#include "sequence.h"
#include "split.h"
#include "watch.h"

namespace {

using namespace northlight;
using kaamos::effects::Scene;

constexpr int kInterrupted = 130;  // 128 + SIGINT, as shells report it

std::atomic<bool> stop_requested{false};
void on_interrupt(int) {
  stop_requested = true;
}

void say_error(const std::string& text) {
  std::fprintf(stderr, "northlight: %s\n", text.c_str());
}

bool load_scene(const Options& options, Scene& scene) {
  if (const auto* built_in = kaamos::effects::find_built_in_scene(options.scene)) {
    scene = built_in->make();
    return true;
  }
  auto loaded = kaamos::effects::load_gltf(options.scene, {.animated = options.frames > 0});
  if (!loaded.ok()) {
    say_error(loaded.error());
    return false;
  }
  for (const std::string& warning : loaded.value().warnings) {
    std::fprintf(stderr, "northlight: warning: %s\n", warning.c_str());
  }
  scene = std::move(loaded.value().scene);
  // A tree alone has nothing to cast its shadow on.
  if (kaamos::effects::needs_ground(scene)) kaamos::effects::add_ground(scene);
  return true;
}

// Prepares a scene for upload.
void prepare_geometry(const Options& options, Scene& scene) {
  if (options.frames == 0) kaamos::effects::show_levels(scene, scene.cameras.front());
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
      say_error(change.error());
      return false;
    }
    const auto changed = kaamos::effects::override_material(scene, change.value());
    if (!changed.ok()) {
      say_error(changed.error());
      return false;
    }
  }
  return true;
}

// A progress bar on a terminal, nothing in a log.
void show_progress(const std::string& pass, double done) {
  static const bool terminal = isatty(STDERR_FILENO) != 0;
  if (!terminal) return;
  constexpr int kWidth = 40;
  const int filled = static_cast<int>(done * kWidth);
  std::fprintf(stderr, "\r%-20s [%.*s%*s] %3.0f %%%s", pass.c_str(), filled,
               "########################################", kWidth - filled, "", done * 100,
               done >= 1 ? "\n" : "");
  std::fflush(stderr);
}

int report(const rtapi::Error& error, const Options& options) {
  if (error.id.number == 0) {
    std::fprintf(stderr, "\n");
    say_error("interrupted: nothing was written, earlier results in " + options.out +
              " are unchanged");
    return kInterrupted;
  }
  say_error(error.message);
  return 1;
}

int render_once(Renderer& renderer, const ShaderLibraries& libraries, const Options& options,
                const Scene& scene) {
  auto frame = renderer.render(libraries, show_progress, stop_requested);
  if (!frame) return report(frame.error(), options);
  if (options.reference > 0) {
    const auto added =
        add_reference(options, scene, libraries, show_progress, stop_requested, say_error, *frame);
    if (!added) return report(added.error(), options);
  }
  if (options.pixel) {
    std::fputs(describe_pixel(*frame, options.pixel->first, options.pixel->second).c_str(), stdout);
    return 0;
  }
  if (options.explain) {
    std::fputs(print_explanations(frame->explained, options.json).c_str(), stdout);
    return 0;
  }
  if (!options.heatmap.empty()) {
    std::string said;
    const std::string error = write_heatmap(options, *frame, said);
    if (!error.empty()) say_error(error);
    std::fputs(said.c_str(), stdout);
    return error.empty() ? 0 : 1;
  }
  if (const std::string error = write_results(options, scene, renderer, *frame); !error.empty()) {
    say_error(error);
    return 1;
  }
  std::printf("%s\nwrote %s/frame.png, frame.exr, stats.json and a PNG for each layer\n",
              describe(renderer, *frame).c_str(), options.out.c_str());
  std::fflush(stdout);
  return 0;
}

int render_frames(Renderer& renderer, const ShaderLibraries& libraries, const Options& options,
                  const Scene& scene) {
  StagedFiles files(options.out);
  std::string error = files.create();
  if (error.empty()) {
    const auto sequence =
        render_sequence(renderer, libraries, options, scene, show_progress, stop_requested, files);
    if (!sequence) return report(sequence.error(), options);
    error = add_results(options, scene, renderer, *sequence, files);
    if (error.empty()) error = files.publish();
    if (error.empty()) {
      remove_later_frames(options.out, options.frames);
      std::printf(
          "%s\nwrote %s/frame_0000.png to frame_%04u.png, the last one's layers, "
          "stats.json\n",
          describe(renderer, *sequence).c_str(), options.out.c_str(), options.frames - 1);
      return 0;
    }
  }
  say_error(error);
  return 1;
}

int measure(const Options& options, const Scene& scene) {
  const auto libraries = built_in_libraries();
  if (!libraries) return report(libraries.error(), options);
  const auto done = run_measure(options, scene, *libraries, show_progress, stop_requested);
  return done ? 0 : report(done.error(), options);
}

int claims(const Options& options, const Scene& scene) {
  const auto libraries = built_in_libraries();
  if (!libraries) return report(libraries.error(), options);
  const auto done = run_claims(options, scene, *libraries, show_progress, stop_requested);
  return done ? 0 : report(done.error(), options);
}

int split(const Options& options, const Scene& scene) {
  const auto libraries = built_in_libraries();
  if (!libraries) return report(libraries.error(), options);
  const auto done = run_split(options, scene, *libraries, show_progress, stop_requested, say_error);
  return done ? 0 : report(done.error(), options);
}

// Runs until Ctrl-C: shows errors in shaders and waits for the next change.
int watch(Renderer& renderer, const Options& options, const Scene& scene) {
  const auto folder = find_effects_folder();
  if (folder.empty()) {
    say_error("--watch needs the effects' shader files: name their folder in $KAAMOS_EFFECTS");
    return 1;
  }
  ShaderWatcher watcher(folder, options.whole_frame(), !options.sort_rays.empty());
  std::printf("watching %s; Ctrl-C ends\n", folder.c_str());
  do {
    const auto libraries = watcher.compile();
    if (!libraries) {
      std::fprintf(stderr, "%s\n", libraries.error().message.c_str());
    } else if (const int code = render_once(renderer, *libraries, options, scene);
               code == kInterrupted) {
      return code;
    }
  } while (watcher.wait(stop_requested));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  int exit_code = 0;
  const auto options = parse_options(argc, argv, exit_code);
  if (!options) return exit_code;
  if (options->list_devices) {
    std::fputs(list_devices().c_str(), stdout);
    return 0;
  }
  const bool prints =
      options->pixel || options->explain || !options->tables.empty() || options->measure_left_out;
  if (const std::string error = prints ? "" : prepare_folder(options->out); !error.empty()) {
    say_error(error);
    return 1;
  }
  Scene scene;
  if (!load_scene(*options, scene) || !override_materials(*options, scene)) return 1;
  if (!options->write_glb.empty()) {
    if (const auto written = kaamos::effects::write_glb(options->write_glb, scene); !written.ok()) {
      say_error(written.error());
      return 1;
    }
  }
  prepare_geometry(*options, scene);
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  if (!options->measure.empty()) return measure(*options, scene);
  if (options->claims) return claims(*options, scene);
  if (!options->split.empty()) return split(*options, scene);
  auto renderer = Renderer::create(*options, scene, say_error);
  if (!renderer) return report(renderer.error(), *options);
  if (options->watch) return watch(**renderer, *options, scene);
  const auto libraries = built_in_libraries();
  if (!libraries) return report(libraries.error(), *options);
  if (options->measure_left_out) {
    const auto table = measure_left_out(*options, scene, *libraries, show_progress, stop_requested);
    if (!table) return report(table.error(), *options);
    std::fputs(table->c_str(), stdout);
    return 0;
  }
  if (!options->tables.empty()) {
    const auto tables = (*renderer)->describe_tables(*libraries);
    if (!tables) return report(tables.error(), *options);
    std::fputs(print_tables(*tables, options->tables == "json").c_str(), stdout);
    return 0;
  }
  if (options->frames > 0) return render_frames(**renderer, *libraries, *options, scene);
  return render_once(**renderer, *libraries, *options, scene);
}

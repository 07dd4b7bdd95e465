// SPDX-License-Identifier: MIT
#include "options.h"

#include <rtapi/version.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>

#include "effects/assets/built_in/built_in.h"
#include "effects/assets/built_in/camera_paths.h"
#include "effects/measure/comparison/split.h"
#include "effects/northlight/settings_file.h"
#include "options_conflict.h"
#include "options_help.h"
#include "options_measure.h"
#include "options_output.h"
#include "options_quality.h"
#include "options_settings.h"
#include "options_shorthands.h"
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
  MeasureWords measuring;
  QualityWords quality;
  Shorthands shorthands;
  SettingWords settings;
};

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

// "ao (ambient occlusion), sun (sun shadow), ...".
std::string describe_effects() {
  std::string out;
  for (const Effect& effect : northlight_effects()) {
    if (!effect.alternative_to.empty()) continue;
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

// A CLI11 validator that stores what it parses.
template <class Parse>
CLI::Validator parsed_by(Parse parse, Options& options) {
  return CLI::Validator([parse, &options](std::string& text) { return parse(text, options); }, "");
}

void add_scene(CLI::App& app, Options& options) {
  app.add_option("--pieces", options.piece_triangles,
                 "split meshes of more triangles than this; 0: none")
      ->capture_default_str()
      ->check(CLI::Range(0u, 1u << 29));
  app.add_option("--probes", options.probes,
                 "where environment maps are seen from: found (open places, in boxes of their "
                 "rooms), camera (the first camera, which flatters its picture)")
      ->capture_default_str()
      ->check(CLI::IsMember({"found", "camera"}));
}

void add_device(CLI::App& app, Options& options) {
  app.add_option("--backend", options.backend,
                 "the backend that runs the shaders: embree, vulkan; --study: both")
      ->capture_default_str();
  app.add_flag("--list-devices", options.list_devices, "print the devices of every backend");
  app.add_flag("--checked", options.checked, "checked mode: report what DXR leaves undefined");
  app.add_option("--precision", options.precision,
                 "precision of ray-triangle tests on embree: fast, robust, exact")
      ->capture_default_str()
      ->check(CLI::IsMember({"fast", "robust", "exact"}));
  app.add_option("--threads", options.threads, "0: all; the picture does not depend on it")
      ->capture_default_str()
      ->check(CLI::Range(0u, 1024u));
}

// The first word that no option takes.
std::string first_unknown(const CLI::App& app) {
  const std::vector<std::string> words = app.remaining();
  const auto found = std::find_if(words.begin(), words.end(),
                                  [](const std::string& word) { return word.starts_with("--"); });
  return found == words.end() ? std::string() : *found;
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
  app.add_option("--enlarge", options.frame.enlarge,
                 "the finished frame has so many times the width and height of --size, which "
                 "layers keep; its edges stay sharp")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 4.0));
  app.add_flag("--taa", options.frame.taa, "antialiasing over the frames of a sequence")
      ->needs(frames);
}

// Rays that read the sun's map need one, and nobody else does.
void add_sun_map(Options& options) {
  const auto reads_map = [&](const DescribedSetting& setting) {
    return setting.text.name == "sun-at-hits" &&
           value_text(setting.get(options.frame, options.effects)) == "map";
  };
  const std::vector<DescribedSetting> settings = describe_settings();
  std::uint32_t& size = options.frame.sun_map;
  if (std::none_of(settings.begin(), settings.end(), reads_map)) {
    size = 0;
  } else if (size == 0) {
    size = 2048;
  }
}

// Applies the words to the frame and its effects: what says less before what says more. Returns an
// error, or nothing.
std::string apply(const Words& words, Options& options) {
  if (std::string error = read_setting_files(words.settings, options); !error.empty()) return error;
  apply_shorthands(words.shorthands, options);
  if (std::string error = list_settings(words.settings, options); !error.empty()) return error;
  if (std::string error = apply_settings(options); !error.empty()) return error;
  apply_passes(words.shorthands, options);
  add_sun_map(options);
  options.frame.moving = options.frames > 0;
  choose(options, words.effects);
  return {};
}

}  // namespace

std::optional<Options> parse_options(int argc, char** argv, int& exit_code) {
  Options options;
  options.effects = default_options().effects;
  Words words;
  CLI::App app(
      "Renders a scene with Northlight's ray traced effects: ambient occlusion and sun shadow, or\n"
      "the whole frame with --effects all.\n"
      "Writes frame.png, frame.exr, stats.json, and for each effect that is named, or what\n"
      "--layers names, a PNG and a layer of frame.exr.",
      "northlight");
  app.set_help_flag("-h,--help", "print this, or with =TOPIC a topic");
  app.option_defaults()->group(kSceneGroup);
  app.set_version_flag("--version", std::string("northlight ") + rtapi::GetVersion());
  app.add_option("--scene", options.scene,
                 "built in: " + built_in_scene_names() + "; or a .gltf or .glb file")
      ->capture_default_str();
  app.add_option("--material", options.materials,
                 "change a material, as in Window:alpha=0.3,roughness=0; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  add_scene(app, options);
  app.option_defaults()->group(kPictureGroup);
  app.add_option("--size", words.size, "width and height in pixels")
      ->capture_default_str()
      ->check(parsed_by(parse_size, options));
  app.add_option("--effects", words.effects,
                 "comma-separated: " + describe_effects() +
                     ", or techniques in their place, as --help=effects lists them; or all")
      ->delimiter(',')
      ->capture_default_str()
      ->check(CLI::Validator([](std::string& name) { return check_effect(name); }, ""));
  app.add_option("--sun", words.sun,
                 "AZIMUTH,ELEVATION: where the sun stands, in degrees from +Z towards +X and above "
                 "the horizon, as in 30,50; default: the scene's, which may have none")
      ->check(parsed_by(parse_sun, options));
  app.add_option("--seed", options.frame.seed, "the same seed gives the same picture")
      ->capture_default_str();
  app.option_defaults()->group(kSettingsGroup);
  add_quality(app, options, words.quality);
  add_settings(app, words.settings);
  app.option_defaults()->group(kShorthandGroup);
  add_shorthands(app, options, words.shorthands);
  app.option_defaults()->group(kSequenceGroup);
  add_sequence(app, options);
  app.option_defaults()->group(kDeviceGroup);
  add_device(app, options);
  app.option_defaults()->group(kResultsGroup);
  app.add_option("--out", options.out, "folder for the results")->capture_default_str();
  app.add_option("--write-glb", options.write_glb, "write the scene to this .glb file too");
  add_output(app, options);
  app.option_defaults()->group(kReferenceGroup);
  add_path_reference(app, options);
  app.option_defaults()->group(kInsideGroup);
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
  add_views(app, options);
  app.option_defaults()->group(kMeasuringGroup);
  app.add_flag(
      "--measure-left-out", options.measure_left_out,
      "print what parts that the scene does not need would cost, instead of writing files");
  app.add_option("--reference", options.reference,
                 "add layers NAME_reference: each effect with this many samples, not denoised")
      ->check(CLI::Range(1u, kMaxSamples));
  app.add_option("--split", options.split, describe_splits())->check(CLI::IsMember(split_names()));
  add_measuring(app, options, words.measuring);
  const auto refuse = [&](const std::string& error) {
    std::fprintf(stderr, "northlight: %s\n", error.c_str());
    exit_code = 2;
    return std::nullopt;
  };
  std::string error;
  if (const auto topic = asked_topic(argc, argv)) {
    const std::string help = help_text(app, *topic, error);
    if (!error.empty()) return refuse(error);
    std::fputs(help.c_str(), stdout);
    return std::nullopt;
  }
  const std::vector<char*> rest = take_settings(argc, argv, app, words.settings, error);
  if (!error.empty()) return refuse(error);
  try {
    app.parse(static_cast<int>(rest.size()), rest.data());
  } catch (const CLI::ExtrasError& extras) {
    exit_code = app.exit(extras) == 0 ? 0 : 2;
    const std::string nearest = nearest_option(app, first_unknown(app));
    if (!nearest.empty()) std::fprintf(stderr, "The nearest option is %s.\n", nearest.c_str());
    return std::nullopt;
  } catch (const CLI::ParseError& problem) {
    exit_code = app.exit(problem) == 0 ? 0 : 2;
    return std::nullopt;
  }
  if (!options.split.empty() && app.count("--scene") == 0) {
    options.scene = find_split(options.split)->scene;
  }
  if (error = apply_quality_words(words.quality, options); !error.empty()) return refuse(error);
  if (app.count("--effects") == 0) {
    if (options.goal) words.effects = {"all"};
    choose_for_views(options, words.effects);
  }
  if (error = apply(words, options); !error.empty()) return refuse(error);
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
  if (const std::string found = conflict(options); !found.empty()) return refuse(found);
  apply_measuring(app, words.measuring, words.settings, options);
  if (words.settings.print) {
    std::fputs(write_settings(options.frame, options.effects).c_str(), stdout);
    exit_code = 0;
    return std::nullopt;
  }
  return options;
}

}  // namespace northlight

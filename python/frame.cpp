// SPDX-License-Identifier: MIT
#include "python/frame.h"

#include <utility>

#include "effects/assets/built_in/built_in.h"
#include "effects/assets/gltf/gltf_load.h"
#include "effects/assets/image/tonemap.h"
#include "effects/assets/scene/levels.h"
#include "effects/assets/scene/staging.h"
#include "effects/northlight/described_settings.h"
#include "effects/northlight/settings_file.h"

namespace kaamos::python {
namespace {

effects::Scene load_scene(const std::string& name) {
  if (const auto* built_in = effects::find_built_in_scene(name)) return built_in->make();
  effects::LoadedScene loaded = effects::load_gltf(name).value();
  if (!loaded.complete && effects::needs_ground(loaded.scene)) effects::add_ground(loaded.scene);
  return std::move(loaded.scene);
}

template <class T>
py::array array_from(const std::vector<T>& values, uint32_t width, uint32_t height,
                     uint32_t channels) {
  std::vector<py::ssize_t> shape = {height, width};
  if (channels != 1) shape.push_back(channels);
  py::array_t<T> out(shape);
  std::copy(values.begin(), values.end(), out.mutable_data());
  return out;
}

}  // namespace

Frame::Frame(const Session& session, const FrameOptions& options) {
  effects::FrameSettings settings;
  settings.width = options.width;
  settings.height = options.height;
  settings.seed = options.seed;
  settings.effects = effects::choose_effects(options.effects);
  const auto described = effects::describe_settings();
  for (const auto& [name, value] : options.settings) {
    effects::set_setting(described, name, value, settings, settings.effects).value();
  }
  const py::gil_scoped_release released;
  scene_ = load_scene(options.scene);
  effects::show_levels(scene_, scene_.cameras.front());
  renderer_ = effects::FrameRenderer::create(session.device(), scene_, settings).value();
}

void Frame::render(const py::object& progress) {
  bool failed = false;  // Python has an error
  const effects::Progress report = [&](const std::string& what, double done) {
    const py::gil_scoped_acquire held;
    failed = PyErr_CheckSignals() != 0;
    if (failed || progress.is_none()) return !failed;
    try {
      progress(what, done);
    } catch (py::error_already_set& error) {
      error.restore();
      failed = true;
    }
    return !failed;
  };
  {
    const py::gil_scoped_release released;
    renderer_->render(report).value();
  }
  if (failed) throw py::error_already_set();
  is_rendered_ = true;
}

py::array Frame::layer(const std::string& name) {
  renderer_->check_layer(name).value();
  if (!is_rendered_) render(py::none());
  effects::FloatImage image;
  {
    const py::gil_scoped_release released;
    image = renderer_->read(name).value();
  }
  return array_from(image.values, image.width, image.height, image.channels);
}

py::array Frame::picture() {
  if (!is_rendered_) render(py::none());
  effects::ByteImage image;
  {
    const py::gil_scoped_release released;
    image = effects::tonemap(renderer_->read("radiance").value(), scene_.exposure);
  }
  return array_from(image.values, image.width, image.height, image.channels);
}

std::vector<std::string> scene_names() {
  std::vector<std::string> out;
  for (const effects::BuiltInScene& scene : effects::built_in_scenes())
    out.emplace_back(scene.name);
  return out;
}

py::list described_settings() {
  py::list out;
  for (const effects::DescribedSetting& one : effects::describe_settings()) {
    py::dict row;
    row["name"] = one.full_name();
    row["topic"] = one.topic;
    row["default"] = effects::value_text(one.default_value());
    row["allowed"] = effects::allowed_text(one.text);
    row["about"] = one.text.about;
    row["source"] = one.text.source;
    out.append(row);
  }
  return out;
}

}  // namespace kaamos::python

// SPDX-License-Identifier: MIT
// Reads the animations of a glTF file. [glTF 2.0: Animations]
#include <algorithm>
#include <cmath>

#include "effects/assets/gltf/gltf_accessor.h"
#include "effects/assets/gltf/gltf_reader.h"

namespace kaamos::effects {
namespace {

bool path_of(const std::string& name, ChannelPath& path) {
  if (name == "translation") {
    path = ChannelPath::kTranslation;
  } else if (name == "rotation") {
    path = ChannelPath::kRotation;
  } else if (name == "scale") {
    path = ChannelPath::kScale;
  } else if (name == "weights") {
    path = ChannelPath::kWeights;
  } else {
    return false;
  }
  return true;
}

/// Also checks what evaluate_nodes relies on.
Status read_sampler(const GltfReader& reader, const tinygltf::AnimationSampler& sampler,
                    const std::string& where, Channel& channel) {
  channel.interpolation = sampler.interpolation == "STEP"          ? Interpolation::kStep
                          : sampler.interpolation == "CUBICSPLINE" ? Interpolation::kCubicSpline
                                                                   : Interpolation::kLinear;
  Result<std::vector<float>> times = read_floats(reader.model, sampler.input, 1, where + ", input");
  if (!times.ok()) return times.error();
  for (std::size_t i = 0; i < times.value().size(); ++i) {
    const float time = times.value()[i];
    if (!std::isfinite(time) || (i > 0 && !(time > times.value()[i - 1])))
      return make_error(ErrorId::kGltf, where + ", input: element " + std::to_string(i) +
                                            " is a time that is not after the one before");
  }
  const std::size_t per_key = channel.interpolation == Interpolation::kCubicSpline ? 3 : 1;
  if (channel.path == ChannelPath::kWeights) {
    Result<std::vector<float>> weights =
        read_floats(reader.model, sampler.output, 1, where + ", output");
    if (!weights.ok()) return weights.error();
    channel.times = std::move(times.value());
    channel.weights = std::move(weights.value());
    const std::size_t targets = reader.scene.nodes[channel.node].weights.size();
    if (channel.times.empty() || channel.weights.size() != per_key * targets * channel.times.size())
      return make_error(ErrorId::kGltf, where + ": has " + std::to_string(channel.times.size()) +
                                            " times and " + std::to_string(channel.weights.size()) +
                                            " weights, " + std::to_string(per_key * targets) +
                                            " per time are expected for the " +
                                            std::to_string(targets) + " morph targets");
    return {};
  }
  const std::uint32_t components = channel.path == ChannelPath::kRotation ? 4 : 3;
  Result<std::vector<float>> values =
      read_floats(reader.model, sampler.output, components, where + ", output");
  if (!values.ok()) return values.error();
  channel.times = std::move(times.value());
  const std::vector<float>& v = values.value();
  for (std::size_t i = 0; i + components <= v.size(); i += components) {
    channel.values.emplace_back(v[i], v[i + 1], v[i + 2], components == 4 ? v[i + 3] : 0.0f);
  }
  if (channel.times.empty() || channel.values.size() != per_key * channel.times.size())
    return make_error(ErrorId::kGltf, where + ": has " + std::to_string(channel.times.size()) +
                                          " times and " + std::to_string(channel.values.size()) +
                                          " values, " + std::to_string(per_key) +
                                          " per time are expected");
  return {};
}

Status read_animation(GltfReader& reader, const tinygltf::Animation& from, const std::string& where,
                      Animation& to) {
  for (std::size_t i = 0; i < from.channels.size(); ++i) {
    const tinygltf::AnimationChannel& part = from.channels[i];
    const std::string place = where + ", channel " + std::to_string(i);
    Channel channel;
    if (!path_of(part.target_path, channel.path)) {
      reader.warn(place + ": its target \"" + part.target_path +
                  "\" is none of translation, rotation, scale and weights and is left out");
      continue;
    }
    if (part.target_node < 0) continue;  // no target, or one of an extension
    const std::size_t node = static_cast<std::size_t>(part.target_node);
    if (node >= reader.node_ids.size())
      return make_error(ErrorId::kGltf, place + ": names node " + std::to_string(node) + " of " +
                                            std::to_string(reader.node_ids.size()));
    if (reader.node_ids[node] == kNoIndex) continue;  // in a scene that is not shown
    channel.node = static_cast<std::uint32_t>(reader.node_ids[node]);
    if (channel.path == ChannelPath::kWeights && reader.scene.nodes[channel.node].weights.empty()) {
      reader.warn(place +
                  ": moves weights of a node whose mesh has no morph targets; it is left out");
      continue;
    }
    if (part.sampler < 0 || static_cast<std::size_t>(part.sampler) >= from.samplers.size())
      return make_error(ErrorId::kGltf, place + ": names sampler " + std::to_string(part.sampler) +
                                            " of " + std::to_string(from.samplers.size()));
    const Status status =
        read_sampler(reader, from.samplers[static_cast<std::size_t>(part.sampler)], place, channel);
    if (!status.ok()) return status;
    to.duration = std::max(to.duration, static_cast<double>(channel.times.back()));
    to.channels.push_back(std::move(channel));
  }
  return {};
}

}  // namespace

Status read_gltf_animations(GltfReader& reader) {
  if (!reader.animated) return {};
  for (std::size_t id = 0; id < reader.model.animations.size(); ++id) {
    const tinygltf::Animation& from = reader.model.animations[id];
    Animation animation;
    animation.name = from.name.empty() ? "animation " + std::to_string(id) : from.name;
    const Status status =
        read_animation(reader, from, gltf_part("animation", id, from.name), animation);
    if (!status.ok()) return status;
    reader.scene.animations.push_back(std::move(animation));
  }
  return {};
}

}  // namespace kaamos::effects

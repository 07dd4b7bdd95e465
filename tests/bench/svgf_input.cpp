// SPDX-License-Identifier: MIT
#include "effects/engine/picture.h"
#include "scalar_svgf.h"

namespace kaamos::bench {

SvgfInput svgf_input(const rtapi::Device& device, rtapi::CommandQueue& queue,
                     const effects::Frame& frame, const rtapi::Texture& signal) {
  SvgfInput out;
  out.width = frame.width();
  out.height = frame.height();
  const auto light = effects::read_picture(device, queue, signal).value();
  out.view_z = frame.read(device, queue, effects::kViewZ).value().values;
  out.shading_normal = frame.read(device, queue, effects::kShadingNormal).value().values;
  const auto ids = frame.read(device, queue, effects::kIds).value();
  const auto motion = frame.read(device, queue, effects::kMotion).value();
  const size_t channels = light.channels;
  for (size_t i = 0; i < out.view_z.size(); ++i) {
    const float* c = &light.values[channels * i];
    out.signal.push_back(channels == 1 ? Float4{c[0], c[0], c[0], 0}
                                       : Float4{c[0], c[1], c[2], c[3]});
    const float* m = &motion.values[4 * i];
    out.motion.push_back({m[0], m[1], m[2], m[3]});
    out.instance.push_back(static_cast<uint32_t>(ids.values[2 * i]));
  }
  return out;
}

}  // namespace kaamos::bench

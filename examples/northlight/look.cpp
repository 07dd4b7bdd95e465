// SPDX-License-Identifier: MIT
#include "look.h"

#include <utility>

#include "effects/views/views.h"
#include "output.h"

namespace northlight {

using namespace kaamos::effects;

rtapi::Status check_views(const Options& options, const FrameRenderer& renderer) {
  for (const std::string& name : options.views) {
    const auto view = find_view(name);
    if (!view.ok()) return view.error();
    if (const auto s = check_view(*view.value(), renderer, options.view_signal); !s.ok()) {
      return s.error();
    }
  }
  return {};
}

rtapi::Status add_views(const Options& options, FrameRenderer& renderer, FrameResult& result) {
  const float exposure = renderer.context().scene.exposure;
  for (const std::string& name : options.views) {
    const auto view = find_view(name);
    if (!view.ok()) return view.error();
    auto numbers = look_at(*view.value(), renderer, options.view_signal);
    if (!numbers) return numbers.error();
    auto shown = view.value()->show(*numbers, frame_picture(result.radiance, exposure), exposure);
    result.views.push_back({name, view.value()->channels, std::move(*numbers),
                            std::move(shown.image), std::move(shown.legend)});
  }
  return {};
}

std::string describe_views(const FrameResult& result) {
  std::string out;
  for (const ViewResult& view : result.views) {
    out += "view-" + view.name + ".png: " + view.legend + "\n";
  }
  return out;
}

}  // namespace northlight

// SPDX-License-Identifier: MIT
//
// Render targets and depth buffers of draws: their formats, states and sizes, what was cleared and
// what was never written.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>

#include "runtime/backend/draw_commands.h"
#include "runtime/checks/report.h"
#include "runtime/checks/texture_states.h"

namespace kaamos::checks {

// What a view of a target shows. A volume has a single array element.
inline Subresources subresources_of(const runtime::TargetView& view, uint32_t plane = 0) {
  if (view.is_volume) return {view.mip, 1, 0, 1, plane, 1};
  return {view.mip, 1, view.first_slice, view.slice_count, plane, 1};
}

class Targets {
 public:
  Targets(Reporter& reporter, TextureStates& states) : reporter_(reporter), states_(states) {}

  void begin_list() { bound_before_.clear(); }
  // Before a draw. `who` begins the messages: "draw 3, pipeline \"gbuffer\"". `label` names the
  // command.
  void check(const runtime::DrawCommand& command, const std::string& who, const std::string& label);
  void check(const runtime::ClearTargetCommand& command, const std::string& label);
  // After it.
  void note(const runtime::DrawCommand& command);
  void note(const runtime::ClearTargetCommand& command);
  // Something else wrote to the texture.
  void written(const std::shared_ptr<runtime::BackendTexture>& texture);

  // Returns whether check() said that nothing can pass the depth test of the last draw.
  bool told_of_clear() const { return told_of_clear_; }
  // "was cleared to 0 and not drawn to since"; empty if something was drawn to it.
  std::string only_cleared(const runtime::TargetView& depth) const;

 private:
  struct Clear {
    std::weak_ptr<runtime::BackendTexture> texture;
    float depth = 0;
    std::string by;
  };
  using Place = std::tuple<const runtime::BackendTexture*, uint32_t, uint32_t>;  // mip, slice

  void check_formats(const runtime::DrawCommand& command, const std::string& who);
  void check_stencil_view(const runtime::DrawCommand& command, const std::string& who);
  void check_sizes(const runtime::DrawCommand& command, const std::string& who);
  void check_states(const runtime::DrawCommand& command, const std::string& who,
                    const std::string& label);
  void check_contents(const runtime::DrawCommand& command, const std::string& who);
  void use(const runtime::TargetView& view, rtapi::ResourceStates wanted, const std::string& what,
           const std::string& label, uint32_t plane = 0);
  bool was_written(const runtime::TargetView& view) const;

  Reporter& reporter_;
  TextureStates& states_;
  std::map<const runtime::BackendTexture*, std::weak_ptr<runtime::BackendTexture>> written_;
  std::map<Place, Clear> cleared_;  // depth buffers that nothing was drawn to since
  bool told_of_clear_ = false;
  std::set<const runtime::BackendTexture*> bound_before_;  // drawn to in this list
};

// Returns whether some operation may change stencil.
bool changes_stencil(const rtapi::DepthStencilDesc& desc);
// Returns whether a draw has a depth test and a depth buffer for it.
bool tests_depth(const runtime::DrawCommand& command);
bool writes_depth(const runtime::DrawCommand& command);
bool tests_stencil(const runtime::DrawCommand& command);
bool writes_stencil(const runtime::DrawCommand& command);
const char* comparison_name(rtapi::ComparisonFunc func);  // "LESS_EQUAL"

}  // namespace kaamos::checks

// SPDX-License-Identifier: MIT
//
// The state that each texture is in, checked against its uses. Unlike a buffer, a texture keeps its
// state when a list ends, unless a read promoted it from the common state. Only reads and copies
// can promote it, never unordered access. [D3D12: implicit state transitions]
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "runtime/backend/commands.h"
#include "runtime/checks/report.h"

namespace kaamos::checks {

// Subresources of a texture: mips by array elements or cube faces by planes. Clipped to those that
// the texture has; all of them by default.
struct Subresources {
  uint32_t first_mip = 0;
  uint32_t mip_count = UINT32_MAX;
  uint32_t first_layer = 0;
  uint32_t layer_count = UINT32_MAX;
  uint32_t first_plane = 0;
  uint32_t plane_count = UINT32_MAX;
};

// Thread-safe: textures and views are made while lists execute.
class TextureStates {
 public:
  explicit TextureStates(Reporter& reporter) : reporter_(reporter) {}

  // MipLevels must be resolved.
  void add(const std::shared_ptr<runtime::BackendTexture>& texture, const rtapi::TextureDesc& desc);
  void rename(const runtime::BackendTexture* texture, const std::string& name);
  // `key`: shader::view_key of what the view's descriptors contain.
  void add_view(uint64_t key, const std::shared_ptr<runtime::BackendTexture>& texture,
                const Subresources& seen);

  void begin_list();
  // `label`: which command, "DispatchRays, command 3".
  void barrier(const runtime::BarrierCommand& command, const std::string& label);
  // `id` and `hint` belong to the message if the state is another one.
  void use(const runtime::BackendTexture* texture, const Subresources& used,
           rtapi::ResourceStates wanted, const std::string& what, const std::string& label,
           Id id = Id::kResourceState, const std::string& hint = {});
  // Returns whether all of it is in that state by now.
  bool is_in(const runtime::BackendTexture* texture, const Subresources& used,
             rtapi::ResourceStates state);
  std::string name_of(const runtime::BackendTexture* texture);  // "texture \"depth\""
  // Null if the texture was made without one.
  std::optional<rtapi::ClearValue> optimized_clear(const runtime::BackendTexture* texture);
  // Returns whether the view shows some of these subresources.
  bool shows(uint64_t key, const runtime::BackendTexture* texture, const Subresources& some);
  // The texture that it shows; null if it is gone.
  std::shared_ptr<runtime::BackendTexture> texture_of(uint64_t key);
  void use_view(uint64_t key, rtapi::ResourceStates wanted, const std::string& what,
                const std::string& label);
  // Only the shader knows what a dispatch takes out of arrays of descriptors and heaps. This
  // returns which views it must not touch, by key, and the words for reporting each.
  // `reads`: the states of which any lets the shaders read.
  std::map<uint64_t, std::string> before_dispatch(rtapi::ResourceStates reads);

 private:
  struct State {
    rtapi::ResourceStates state = rtapi::ResourceStates::kCommon;
    bool promoted = false;     // by a use, not by a transition
    std::string by;            // empty: since its creation
    bool may_be_read = false;  // a dispatch could have promoted it from the common state
    bool enhanced = false;     // a layout that an enhanced barrier gave it
  };
  struct Tracked {
    std::weak_ptr<runtime::BackendTexture> texture;
    std::string name;
    uint32_t mips = 1;
    uint32_t layers = 1;
    uint32_t planes = 1;
    rtapi::ClearValue clear;  // of kUnknown: none
    // By subresource, or one for all of them.
    std::vector<State> states;
  };
  struct View {
    std::weak_ptr<runtime::BackendTexture> texture;
    Subresources seen;
  };

  static std::vector<uint32_t> split(Tracked& texture, const Subresources& some);
  static Subresources covered(const Tracked& texture, const runtime::BarrierCommand& command);
  static bool allows(State& state, rtapi::ResourceStates wanted, const std::string& label);
  static std::string name(const Tracked& texture);
  static std::string in_state(const Tracked& texture, uint32_t subresource);
  static std::string demand(const State& state, rtapi::ResourceStates wanted);

  Reporter& reporter_;
  std::mutex mutex_;
  std::map<const runtime::BackendTexture*, Tracked> textures_;
  std::map<uint64_t, View> views_;
};

}  // namespace kaamos::checks

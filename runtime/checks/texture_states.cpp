// SPDX-License-Identifier: MIT
#include "runtime/checks/texture_states.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "runtime/backend/backend.h"
#include "runtime/checks/hazards.h"
#include "runtime/checks/names.h"

namespace kaamos::checks {

using rtapi::HasAny;
using rtapi::ResourceStates;

namespace {

bool is_read(ResourceStates state) {
  return !HasAny(state, ResourceStates::kUnorderedAccess | ResourceStates::kCopyDest |
                            ResourceStates::kResolveDest | ResourceStates::kRenderTarget |
                            ResourceStates::kDepthWrite);
}

}  // namespace

void TextureStates::add(const std::shared_ptr<runtime::BackendTexture>& texture,
                        const rtapi::TextureDesc& desc) {
  const bool volume = desc.Dimension == rtapi::ResourceDimension::kTexture3D;
  const std::lock_guard lock(mutex_);
  textures_[texture.get()] = {texture,
                              desc.Name,
                              desc.MipLevels,
                              volume ? 1u : desc.DepthOrArraySize,
                              runtime::plane_count(desc.Format),
                              desc.OptimizedClearValue,
                              {{desc.InitialState, false, {}}}};
}

void TextureStates::rename(const runtime::BackendTexture* texture, const std::string& name) {
  const std::lock_guard lock(mutex_);
  if (const auto it = textures_.find(texture); it != textures_.end()) it->second.name = name;
}

void TextureStates::add_view(uint64_t key, const std::shared_ptr<runtime::BackendTexture>& texture,
                             const Subresources& seen) {
  const std::lock_guard lock(mutex_);
  views_[key] = {texture, seen};
}

void TextureStates::begin_list() {
  const std::lock_guard lock(mutex_);
  std::erase_if(views_, [](const auto& view) { return view.second.texture.expired(); });
  for (auto it = textures_.begin(); it != textures_.end();) {
    for (State& state : it->second.states) {
      state.may_be_read = false;
      if (!state.promoted || HasAny(state.state, ResourceStates::kCopyDest)) continue;
      state.state = ResourceStates::kCommon;
      state.promoted = false;
    }
    it = it->second.texture.expired() ? textures_.erase(it) : std::next(it);
  }
}

// Splits `states` into one for each subresource, unless `some` covers all and all have one state,
// and returns the indices of `some` in it.
std::vector<uint32_t> TextureStates::split(Tracked& texture, const Subresources& some) {
  const auto cut = [](uint32_t first, uint32_t count, uint32_t all) {
    first = std::min(first, all);
    return std::pair(first, first + std::min(count, all - first));
  };
  const auto [mip, mip_end] = cut(some.first_mip, some.mip_count, texture.mips);
  // Views of volumes count slices, which have no states of their own.
  const auto [layer, layer_end] = texture.layers == 1
                                      ? std::pair(0u, 1u)
                                      : cut(some.first_layer, some.layer_count, texture.layers);
  const auto [plane, plane_end] = cut(some.first_plane, some.plane_count, texture.planes);
  const bool all = mip_end - mip == texture.mips && layer_end - layer == texture.layers &&
                   plane_end - plane == texture.planes;
  if (texture.states.size() == 1) {
    if (all) return {0};
    texture.states.resize(size_t{texture.mips} * texture.layers * texture.planes,
                          State(texture.states[0]));
  }
  std::vector<uint32_t> out;
  for (uint32_t p = plane; p < plane_end; ++p) {
    for (uint32_t l = layer; l < layer_end; ++l) {
      for (uint32_t m = mip; m < mip_end; ++m) {
        out.push_back(m + (l + p * texture.layers) * texture.mips);
      }
    }
  }
  return out;
}

std::string TextureStates::name(const Tracked& texture) {
  return texture.name.empty() ? "an unnamed texture" : "texture " + in_quotes(texture.name);
}

std::string TextureStates::in_state(const Tracked& texture, uint32_t subresource) {
  const bool several = texture.states.size() > 1;
  const State& state = texture.states[several ? subresource : 0];
  std::string text = name(texture);
  if (several) {
    text = "subresource " + std::to_string(subresource) + " (mip " +
           std::to_string(subresource % texture.mips) + ", array element " +
           std::to_string(subresource / texture.mips % texture.layers) +
           (texture.planes == 1                                    ? ""
            : subresource >= size_t{texture.mips} * texture.layers ? ", stencil"
                                                                   : ", depth") +
           ") of " + text;
  }
  return text + ", which is in state " + state_name(state.state) +
         (state.by.empty() ? std::string(" since it was created") : " since " + state.by);
}

// What a barrier is for.
Subresources TextureStates::covered(const Tracked& texture,
                                    const runtime::BarrierCommand& command) {
  if (command.mip_count != 0) {
    return {command.subresource, command.mip_count,   command.first_layer,
            command.layer_count, command.first_plane, command.plane_count};
  }
  if (command.subresource == rtapi::kResourceBarrierAllSubresources) return {};
  const uint32_t layer = command.subresource / texture.mips;
  return {
      command.subresource % texture.mips, 1, layer % texture.layers, 1, layer / texture.layers, 1};
}

void TextureStates::barrier(const runtime::BarrierCommand& command, const std::string& label) {
  if (command.texture == nullptr || command.kind == runtime::BarrierCommand::Kind::kUav) return;
  const bool enhanced = command.kind == runtime::BarrierCommand::Kind::kAccess;
  const std::lock_guard lock(mutex_);
  const auto it = textures_.find(command.texture.get());
  if (it == textures_.end()) return;
  Tracked& texture = it->second;
  const std::vector<uint32_t> indices = split(texture, covered(texture, command));
  bool told = command.any_before;
  for (const uint32_t index : indices) {
    State& state = texture.states[index];
    const bool fits = state.promoted || state.state == command.before ||
                      (state.may_be_read && is_read(command.before));
    // The others are probably wrong in the same way.
    if (!fits && !std::exchange(told, true)) {
      reporter_.report(Id::kTransitionBefore,
                       std::string(enhanced ? "LayoutBefore, which is " : "StateBefore ") +
                           state_name(command.before) + (enhanced ? ", " : " ") + "is given for " +
                           in_state(texture, index) + ". Pass the " +
                           (enhanced ? "layout" : "state") + " that it is in.");
    }
    state = {command.after, false, label, false, enhanced};
  }
  if (indices.size() == texture.states.size()) texture.states.resize(1);
}

std::string TextureStates::demand(const State& state, ResourceStates wanted) {
  if (state.enhanced) {
    return "; it must be in " + state_name(wanted) +
           ". Record a TextureBarrier whose LayoutAfter allows that first.";
  }
  return "; it must be in state " + state_name(wanted) +
         ". Record ResourceBarrier::Transition from " + state_name(state.state) + " to " +
         state_name(wanted) + " first.";
}

// Returns whether a use in state `wanted` is allowed. If the use promotes the texture, notes its
// new state.
bool TextureStates::allows(State& state, ResourceStates wanted, const std::string& label) {
  if (state.state != ResourceStates::kCommon && (state.state & wanted) == wanted) return true;
  const bool read = is_read(wanted);
  if (state.state == ResourceStates::kCommon && (read || wanted == ResourceStates::kCopyDest)) {
    state = {wanted, true, label};
    return true;
  }
  if (state.promoted && read && !HasAny(state.state, ResourceStates::kCopyDest)) {
    state.state = state.state | wanted;
    return true;
  }
  return false;
}

void TextureStates::use(const runtime::BackendTexture* used_texture, const Subresources& used,
                        ResourceStates wanted, const std::string& what, const std::string& label,
                        Id id, const std::string& hint) {
  const std::lock_guard lock(mutex_);
  const auto it = textures_.find(used_texture);
  if (it == textures_.end()) return;
  Tracked& texture = it->second;
  bool told = false;
  for (const uint32_t index : split(texture, used)) {
    State& state = texture.states[index];
    if (allows(state, wanted, label)) continue;
    if (!std::exchange(told, true)) {
      reporter_.report(id,
                       what + " is in " + in_state(texture, index) + demand(state, wanted) + hint);
    }
    // Report it once, not for each use that follows.
    state = {wanted, false, label};
  }
}

void TextureStates::use_view(uint64_t key, ResourceStates wanted, const std::string& what,
                             const std::string& label) {
  std::shared_ptr<runtime::BackendTexture> texture;
  Subresources seen;
  {
    const std::lock_guard lock(mutex_);
    if (const auto it = views_.find(key); it != views_.end()) {
      texture = it->second.texture.lock();
      seen = it->second.seen;
    }
  }
  if (texture != nullptr) use(texture.get(), seen, wanted, what, label);
}

bool TextureStates::is_in(const runtime::BackendTexture* used_texture, const Subresources& used,
                          ResourceStates state) {
  const std::lock_guard lock(mutex_);
  const auto it = textures_.find(used_texture);
  if (it == textures_.end()) return false;
  for (const uint32_t index : split(it->second, used)) {
    if (!HasAny(it->second.states[index].state, state)) return false;
  }
  return true;
}

std::string TextureStates::name_of(const runtime::BackendTexture* texture) {
  const std::lock_guard lock(mutex_);
  const auto it = textures_.find(texture);
  return it == textures_.end() ? "a texture" : name(it->second);
}

std::optional<rtapi::ClearValue> TextureStates::optimized_clear(
    const runtime::BackendTexture* texture) {
  const std::lock_guard lock(mutex_);
  const auto it = textures_.find(texture);
  if (it == textures_.end() || it->second.clear.Format == rtapi::Format::kUnknown) {
    return std::nullopt;
  }
  return it->second.clear;
}

bool TextureStates::shows(uint64_t key, const runtime::BackendTexture* texture,
                          const Subresources& some) {
  const std::lock_guard lock(mutex_);
  const auto it = views_.find(key);
  if (it == views_.end() || it->second.texture.lock().get() != texture) return false;
  const auto overlap = [](uint32_t a, uint32_t a_count, uint32_t b, uint32_t b_count) {
    return a < uint64_t{b} + b_count && b < uint64_t{a} + a_count;
  };
  const Subresources& seen = it->second.seen;
  return overlap(seen.first_mip, seen.mip_count, some.first_mip, some.mip_count) &&
         overlap(seen.first_layer, seen.layer_count, some.first_layer, some.layer_count) &&
         overlap(seen.first_plane, seen.plane_count, some.first_plane, some.plane_count);
}

std::shared_ptr<runtime::BackendTexture> TextureStates::texture_of(uint64_t key) {
  const std::lock_guard lock(mutex_);
  const auto it = views_.find(key);
  return it == views_.end() ? nullptr : it->second.texture.lock();
}

std::map<uint64_t, std::string> TextureStates::before_dispatch(ResourceStates reads) {
  std::map<uint64_t, std::string> wrong;
  const std::lock_guard lock(mutex_);
  for (auto& [key, view] : views_) {
    const auto texture = view.texture.lock();
    const auto it = textures_.find(texture.get());
    if (texture == nullptr || it == textures_.end()) continue;
    const bool writes = (key & shader::view_key(0, true)) != 0;
    const ResourceStates wanted = writes ? ResourceStates::kUnorderedAccess : reads;
    const bool alike = it->second.states.size() == 1;
    for (const uint32_t index : alike ? std::vector{0u} : split(it->second, view.seen)) {
      State& state = it->second.states[index];
      State promoted = state;
      if (!HasAny(state.state, wanted) && !allows(promoted, wanted, {})) {
        wrong.emplace(key, in_state(it->second, index) + demand(state, wanted));
        break;
      }
      state.may_be_read = true;
    }
  }
  return wrong;
}

}  // namespace kaamos::checks

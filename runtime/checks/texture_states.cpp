// SPDX-License-Identifier: MIT
#include "runtime/checks/texture_states.h"

#include <iterator>
#include <utility>

#include "runtime/backend.h"
#include "runtime/checks/hazards.h"
#include "runtime/checks/names.h"

namespace kaamos::checks {

using rtapi::HasAny;
using rtapi::ResourceStates;

void TextureStates::add(const std::shared_ptr<runtime::BackendTexture>& texture,
                        ResourceStates initial, std::string name) {
  const std::lock_guard lock(mutex_);
  states_[texture.get()] = {texture, std::move(name), initial, false, {}};
}

void TextureStates::add_view(uint64_t key,
                             const std::shared_ptr<runtime::BackendTexture>& texture) {
  const std::lock_guard lock(mutex_);
  views_[key] = texture;
}

void TextureStates::begin_list() {
  const std::lock_guard lock(mutex_);
  for (auto it = states_.begin(); it != states_.end();) {
    State& state = it->second;
    if (state.promoted && !HasAny(state.state, ResourceStates::kCopyDest)) {
      state.state = ResourceStates::kCommon;
      state.promoted = false;
    }
    it = state.texture.expired() ? states_.erase(it) : std::next(it);
  }
}

std::string TextureStates::in_state(const State& state) const {
  return (state.name.empty() ? std::string("an unnamed texture")
                             : "texture " + quoted(state.name)) +
         ", which is in state " + state_name(state.state) +
         (state.by.empty() ? std::string(" since it was created") : " since " + state.by);
}

void TextureStates::barrier(const runtime::BarrierCommand& command, const std::string& label) {
  if (command.texture == nullptr) return;
  if (command.kind != runtime::BarrierCommand::Kind::kTransition) return;
  const std::lock_guard lock(mutex_);
  const auto it = states_.find(command.texture.get());
  if (it == states_.end()) return;
  // States are kept of whole textures: one that is in several is followed no further.
  if (command.part) {
    states_.erase(it);
    return;
  }
  State& state = it->second;
  if (!state.promoted && state.state != command.before) {
    reporter_.report(Id::kTransitionBefore, "StateBefore " + state_name(command.before) +
                                                " is given for " + in_state(state) +
                                                ". Give the state that it is in.");
  }
  state.state = command.after;
  state.promoted = false;
  state.by = label;
}

void TextureStates::use(const runtime::BackendTexture* texture, ResourceStates wanted,
                        const std::string& what, const std::string& label) {
  const std::lock_guard lock(mutex_);
  const auto it = states_.find(texture);
  if (it == states_.end()) return;
  State& state = it->second;
  if (state.state != ResourceStates::kCommon && (state.state & wanted) == wanted) return;
  const bool read = !HasAny(wanted, ResourceStates::kUnorderedAccess | ResourceStates::kCopyDest);
  const bool from_common = state.state == ResourceStates::kCommon;
  if (from_common && wanted != ResourceStates::kUnorderedAccess) {
    state.state = wanted;
    state.promoted = true;
    state.by = label;
    return;
  }
  if (state.promoted && read && !HasAny(state.state, ResourceStates::kCopyDest)) {
    state.state = state.state | wanted;
    return;
  }
  reporter_.report(Id::kResourceState,
                   what + " is in " + in_state(state) + "; it must be in state " +
                       state_name(wanted) + ". Record ResourceBarrier::Transition from " +
                       state_name(state.state) + " to " + state_name(wanted) + " before.");
  // Said once, not for each use that follows.
  state.state = wanted;
  state.promoted = false;
  state.by = label;
}

void TextureStates::use_view(uint64_t key, ResourceStates wanted, const std::string& what,
                             const std::string& label) {
  std::shared_ptr<runtime::BackendTexture> texture;
  {
    const std::lock_guard lock(mutex_);
    if (const auto it = views_.find(key); it != views_.end()) texture = it->second.lock();
  }
  if (texture != nullptr) use(texture.get(), wanted, what, label);
}

}  // namespace kaamos::checks

// SPDX-License-Identifier: MIT
//
// The state that each texture is in, held against its uses. Unlike a buffer a texture keeps its
// state when a list ends, unless a read promoted it from the common one; what may be promoted is a
// read or a copy, never unordered access. [D3D12: implicit state transitions]
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "runtime/checks/report.h"
#include "runtime/commands.h"

namespace kaamos::checks {

// Thread-safe: textures and views are made while lists execute.
class TextureStates {
 public:
  explicit TextureStates(Reporter& reporter) : reporter_(reporter) {}

  void add(const std::shared_ptr<runtime::BackendTexture>& texture, rtapi::ResourceStates initial,
           std::string name);
  // `key`: shader::view_key of what its descriptors hold.
  void add_view(uint64_t key, const std::shared_ptr<runtime::BackendTexture>& texture);

  void begin_list();
  // `label`: which command, "DispatchRays, command 3".
  void barrier(const runtime::BarrierCommand& command, const std::string& label);
  void use(const runtime::BackendTexture* texture, rtapi::ResourceStates wanted,
           const std::string& what, const std::string& label);
  void use_view(uint64_t key, rtapi::ResourceStates wanted, const std::string& what,
                const std::string& label);

 private:
  struct State {
    std::weak_ptr<runtime::BackendTexture> texture;
    std::string name;
    rtapi::ResourceStates state = rtapi::ResourceStates::kCommon;
    bool promoted = false;  // by a use, not by a transition
    std::string by;         // empty: created so
  };

  std::string in_state(const State& state) const;

  Reporter& reporter_;
  std::mutex mutex_;
  std::map<const runtime::BackendTexture*, State> states_;
  std::map<uint64_t, std::weak_ptr<runtime::BackendTexture>> views_;
};

}  // namespace kaamos::checks

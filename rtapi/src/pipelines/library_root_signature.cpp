// SPDX-License-Identifier: MIT
//
// The root signatures that a compiled library holds: subobjects of HLSL, and [RootSignature] of its
// entry points.
#include <rtapi/device.h>

#include <algorithm>
#include <string>
#include <vector>

#include "rtapi/src/pipelines/root_signature_impl.h"
#include "rtapi/src/shaders/shader_library_impl.h"

namespace rtapi {

namespace {

using detail::Id;
using detail::in_quotes;
using detail::make_error;

struct Held {
  const char* name;
  const char* text;
  bool is_local;
};

std::vector<Held> held_by(const kaamos::shader::LibraryDesc& table) {
  constexpr uint32_t kGlobal = static_cast<uint32_t>(StateSubobjectType::kGlobalRootSignature);
  constexpr uint32_t kLocal = static_cast<uint32_t>(StateSubobjectType::kLocalRootSignature);
  std::vector<Held> out;
  for (uint32_t i = 0; i < table.subobject_count; ++i) {
    const auto& s = table.subobjects[i];
    if (s.type != kGlobal && s.type != kLocal) continue;
    out.push_back({s.name != nullptr ? s.name : "", s.strings[0] != nullptr ? s.strings[0] : "",
                   s.type == kLocal});
  }
  for (uint32_t i = 0; i < table.export_count; ++i) {
    const auto& e = table.exports[i];
    if (e.root_signature != nullptr) out.push_back({e.name, e.root_signature, false});
  }
  return out;
}

std::string list_of(const std::vector<Held>& all) {
  std::string list;
  for (const Held& one : all) {
    list += (list.empty() ? "" : ", ") + in_quotes(one.name) + (one.is_local ? " (local)" : "");
  }
  return list.empty() ? "none" : list;
}

// The one of that name; without a name, the only global one.
Result<Held> find(const ShaderLibrary& library, std::string_view name) {
  const std::vector<Held> all = held_by(*library.impl()->desc);
  if (!name.empty()) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Held& one) { return name == one.name; });
    if (found != all.end()) return *found;
    return make_error(Id::kLibraryRootSignature, in_quotes(library.name()),
                      " has no root signature ", in_quotes(name), "; it has ", list_of(all));
  }
  const Held* only = nullptr;
  for (const Held& one : all) {
    if (one.is_local || (only != nullptr && std::string_view(only->text) == one.text)) continue;
    if (only != nullptr) {
      return make_error(Id::kLibraryRootSignature, in_quotes(library.name()),
                        " has several global root signatures: ", list_of(all),
                        ". Pass the name of one");
    }
    only = &one;
  }
  if (only != nullptr) return *only;
  return make_error(Id::kLibraryRootSignature, in_quotes(library.name()),
                    " has no global root signature; it has ", list_of(all));
}

}  // namespace

Result<RootSignature> Device::CreateRootSignature(const ShaderLibrary& library,
                                                  std::string_view name) const {
  if (!impl_) return make_error(Id::kNullHandle, "CreateRootSignature on an empty device handle");
  if (!library) {
    return make_error(Id::kNullHandle, "CreateRootSignature with an empty library handle");
  }
  const auto held = find(library, name);
  if (!held) return held.error();
  auto desc = ParseRootSignature(held->text);
  if (desc) {
    // Like DXC, set the flag for LocalRootSignature subobjects, whatever the text says.
    if (held->is_local) desc->Flags |= RootSignatureFlags::kLocalRootSignature;
    auto made = CreateRootSignature(*desc);
    if (made) return made;
    desc = made.error();
  }
  return make_error(Id::kLibraryRootSignature, "root signature ", in_quotes(held->name), " of ",
                    in_quotes(library.name()), ": ", desc.error().message);
}

}  // namespace rtapi

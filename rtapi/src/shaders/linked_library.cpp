// SPDX-License-Identifier: MIT
#include "rtapi/src/shaders/linked_library.h"

#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <string_view>
#include <utility>

#include "rtapi/src/errors/error_table.h"
#include "rtapi/src/shaders/shader_library_impl.h"
#include "runtime/coverage/collector.h"
#include "runtime/hlsl/driver/link_libraries.h"

namespace rtapi::detail {
namespace {

namespace coverage = kaamos::coverage;
namespace hlsl = kaamos::hlsl;
namespace shader = kaamos::shader;

constexpr size_t kMostKept = 32;

const shader::LibraryDesc& desc_of(const ShaderLibrary& library) {
  return *library.impl()->desc;
}

std::string_view source_of(const ShaderLibrary& library) {
  return {desc_of(library).source, desc_of(library).source_bytes};
}

std::string key_of(const LinkPlan& plan, bool spirv) {
  std::string key = concat(spirv, coverage::is_asked());
  for (const ShaderLibrary& library : plan.libraries) {
    const std::string_view source = source_of(library);
    key += concat(" l", std::hash<std::string_view>()(source), ".", source.size(), ".",
                  desc_of(library).flags);
  }
  for (const uint32_t entry : plan.entries) key += concat(" e", entry);
  for (const LinkedImport& i : plan.imports) {
    key += concat(" i", i.library, ".", i.import, ".", i.from, ".", i.definition);
  }
  return key;
}

hlsl::LinkRequest request_of(const LinkPlan& plan) {
  hlsl::LinkRequest request;
  for (const ShaderLibrary& library : plan.libraries) {
    const shader::LibraryDesc& desc = desc_of(library);
    hlsl::LibrarySource& source = request.libraries.emplace_back();
    source.text = source_of(library);
    for (uint32_t i = 0; i < desc.binding_count; ++i) {
      const shader::BindingDesc& binding = desc.bindings[i];
      if (!binding.automatic) continue;
      source.registers.push_back({binding.name, binding.register_index, binding.space});
    }
  }
  const shader::LibraryDesc& first = desc_of(plan.libraries[0]);
  request.check_access = (first.flags & shader::kLibraryChecked) != 0;
  request.coverage = coverage::is_asked();
  for (const uint32_t entry : plan.entries) request.entries.push_back(first.exports[entry].name);
  for (const LinkedImport& i : plan.imports) {
    request.definitions.push_back(
        {i.library, desc_of(plan.libraries[i.library]).imports[i.import].mangled_name, i.from,
         desc_of(plan.libraries[i.from]).exports[i.definition].mangled_name});
  }
  return request;
}

struct Known {
  std::mutex mutex;
  std::map<std::string, ModuleLibrary> by_key;
  std::deque<std::string> keys;  // in the order in which they came
};

}  // namespace

ModuleLibrary linked_library(const LinkPlan& plan, bool spirv) {
  // Never destroyed: at exit, other threads may still be running what it holds.
  static Known& known = *new Known;
  const std::lock_guard lock(known.mutex);
  const std::string key = key_of(plan, spirv);
  if (const auto found = known.by_key.find(key); found != known.by_key.end()) return found->second;
  auto module = hlsl::link_libraries(request_of(plan));
  if (!module) return {{}, module.error(), {}};
  ModuleLibrary made = library_of(*std::move(module), desc_of(plan.libraries[0]).flags, spirv);
  if (!made.library) return made;
  known.keys.push_back(key);
  known.by_key[key] = made;
  if (known.keys.size() > kMostKept) {
    known.by_key.erase(known.keys.front());
    known.keys.pop_front();
  }
  return made;
}

}  // namespace rtapi::detail

// SPDX-License-Identifier: MIT
//
// A compiled HLSL library: its exports, and code for the backends.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <rtapi/result.h>

namespace kaamos::shader {
struct LibraryDesc;
}

namespace rtapi {

namespace detail {
struct ShaderLibraryImpl;
}

// [D3D12_SHADER_VERSION_TYPE]
enum class ShaderStage : uint32_t {
  kCompute = 5,
  kLibrary = 6,  // a function that is no entry point
  kRayGeneration = 7,
  kIntersection = 8,
  kAnyHit = 9,
  kClosestHit = 10,
  kMiss = 11,
  kCallable = 12,
};

struct ShaderExportInfo {
  std::string Name = {};
  std::string MangledName;
  ShaderStage Stage = ShaderStage::kLibrary;
  uint32_t PayloadSizeInBytes = 0;      // each scalar as 4 bytes; callables: of their parameter
  uint32_t AttributeSizeInBytes = 0;    // any-hit, closest-hit, intersection
  uint32_t ThreadGroup[3] = {0, 0, 0};  // compute
  std::vector<std::string> Resources;   // HLSL names of the resources that it can reach
};

// A copyable handle; the code stays loaded as long as a handle, a state object or a pipeline uses
// it. Independent of any device.
class ShaderLibrary {
 public:
  ShaderLibrary() = default;
  explicit ShaderLibrary(std::shared_ptr<const detail::ShaderLibraryImpl> impl)
      : impl_(std::move(impl)) {}
  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const ShaderLibrary&) const = default;

  const std::string& name() const;    // the main source file
  const std::string& target() const;  // "lib_6_6"
  const std::vector<ShaderExportInfo>& GetExports() const;
  // By plain or mangled name; null if there is none, or a plain name has several overloads.
  const ShaderExportInfo* FindExport(const std::string& export_name) const;

  const std::shared_ptr<const detail::ShaderLibraryImpl>& impl() const { return impl_; }

 private:
  std::shared_ptr<const detail::ShaderLibraryImpl> impl_;
};

// A library built into the program (kaamos_add_shader_library). `desc` outlives the result, or the
// result keeps its `owner` alive.
// Errors: KA0910 for a null table, another ABI version or broken counts.
Result<ShaderLibrary> LoadShaderLibrary(const kaamos::shader::LibraryDesc* desc,
                                        std::shared_ptr<const void> owner = nullptr);

// A shared object made by kaamos-hlsl; it is unloaded with the last user.
Result<ShaderLibrary> LoadShaderLibraryFromFile(const std::string& path);

}  // namespace rtapi

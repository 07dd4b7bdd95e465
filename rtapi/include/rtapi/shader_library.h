// SPDX-License-Identifier: MIT
/// @file
/// A compiled HLSL library: its exports, and code for the backends.
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

/// The kind of a shader. [D3D12: D3D12_SHADER_VERSION_TYPE]
enum class ShaderStage : uint32_t {
  kPixel = 0,
  kVertex = 1,
  kGeometry = 2,
  kCompute = 5,
  kLibrary = 6,  ///< a function that is no entry point
  kRayGeneration = 7,
  kIntersection = 8,
  kAnyHit = 9,
  kClosestHit = 10,
  kMiss = 11,
  kCallable = 12,
};

/// Describes an exported function. [D3D12: ID3D12FunctionReflection]
struct ShaderExportInfo {
  std::string Name = {};                      ///< as in HLSL: "ClosestHit"
  std::string MangledName;                    ///< tells overloads apart; Name where it has none
  ShaderStage Stage = ShaderStage::kLibrary;  ///< its kind
  uint32_t PayloadSizeInBytes = 0;            ///< each scalar as 4 bytes; callables: of their data
  uint32_t AttributeSizeInBytes = 0;          ///< any-hit, closest-hit, intersection
  uint32_t ThreadGroup[3] = {0, 0, 0};        ///< compute: [numthreads(x, y, z)]
  std::vector<std::string> Resources;         ///< HLSL names of the resources that it can reach
};

/// A compiled library. A copyable handle; the code stays loaded as long as a handle, a state object
/// or a pipeline uses it. Independent of any device. [D3D12: D3D12_SHADER_BYTECODE]
class ShaderLibrary {
 public:
  /// An empty handle, or one that the library makes. A handle is false when it is empty, and two
  /// are equal if they name the same object.
  ///@{
  ShaderLibrary() = default;
  explicit ShaderLibrary(std::shared_ptr<const detail::ShaderLibraryImpl> impl)
      : impl_(std::move(impl)) {}
  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const ShaderLibrary&) const = default;
  ///@}

  /// The main source file; empty for an empty handle.
  const std::string& name() const;
  /// Returns the target that it was compiled for, e.g. "lib_6_6"; empty for an empty handle.
  const std::string& target() const;
  /// Every export, in the order of the source. Valid as long as the library is loaded.
  const std::vector<ShaderExportInfo>& GetExports() const;
  /// An export by its plain or mangled name; null if there is none, or if several overloads have
  /// the plain name. Valid as long as the library is loaded.
  const ShaderExportInfo* FindExport(const std::string& export_name) const;

  /// For the library itself.
  const std::shared_ptr<const detail::ShaderLibraryImpl>& impl() const { return impl_; }

 private:
  std::shared_ptr<const detail::ShaderLibraryImpl> impl_;
};

/// Makes a library of one that is built into the program: `desc` is what the header that
/// kaamos_add_shader_library generates declares. `desc` must outlive the result, or belong to
/// `owner`, which the result keeps alive.
/// @errors KA0910 `desc` is null, was made for another version of the ABI, or holds broken counts
/// or indices. KA2750, KA2751, KA2760, KA2761, as CompileShaderLibrary: `desc` holds HLSL without
/// code (AT_FIRST_USE, `kaamos-hlsl -emit source`), and compiling it failed.
Result<ShaderLibrary> LoadShaderLibrary(const kaamos::shader::LibraryDesc* desc,
                                        std::shared_ptr<const void> owner = nullptr);

/// Loads a shared object that kaamos-hlsl made; it is unloaded with its last user. A path without a
/// slash is in the working directory. The file's code runs in this process: load none that you do
/// not trust.
/// @errors KA0910 the file cannot be loaded, is no shader library, or was made for another version
/// of the ABI.
Result<ShaderLibrary> LoadShaderLibraryFromFile(const std::string& path);

}  // namespace rtapi

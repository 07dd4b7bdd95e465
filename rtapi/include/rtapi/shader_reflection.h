// SPDX-License-Identifier: MIT
/// @file
/// Tells what the compiler knows of a source's shaders and of what they bind, without compiling
/// them to code.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <rtapi/shader_library.h>

namespace rtapi {

/// The kind of a number in memory.
enum class ShaderScalarType : uint32_t {
  kBool,  ///< 4 bytes
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat16,
  kFloat32,
  kFloat64,
};

struct ShaderVariableInfo;

/// A type as it lies in memory. [D3D12: ID3D12ShaderReflectionType]
struct ShaderTypeInfo {
  std::string Name = {};                                 ///< "float4x4", "Light"
  ShaderScalarType Scalar = ShaderScalarType::kFloat32;  ///< unless a structure
  uint32_t Rows = 1;                                     ///< of a matrix
  uint32_t Columns = 1;                                  ///< of a matrix; components of a vector
  bool IsMatrix = false;                                 ///< a matrix, of one row too
  bool IsVector = false;                                 ///< a vector, of one component too
  bool IsRowMajor = false;                               ///< matrices
  bool IsStruct = false;                                 ///< Members are valid
  std::vector<uint32_t> Elements = {};                   ///< of each dimension, outermost first
  std::vector<ShaderVariableInfo> Members;               ///< a base class is the first, "base"
};

/// A member of a constant buffer or of a structure. [D3D12: ID3D12ShaderReflectionVariable]
struct ShaderVariableInfo {
  std::string Name = {};       ///< as in HLSL
  uint32_t OffsetInBytes = 0;  ///< from the start of the buffer or structure
  uint32_t SizeInBytes = 0;    ///< without padding at the end
  ShaderTypeInfo Type;         ///< its type
};

/// The type of a resource. [DXR: HLSL resource types]
enum class ShaderResourceType : uint32_t {
  kConstantBuffer,
  kByteAddressBuffer,
  kStructuredBuffer,
  kBuffer,  ///< typed
  kTexture1D,
  kTexture1DArray,
  kTexture2D,
  kTexture2DArray,
  kTexture3D,
  kTextureCube,
  kTextureCubeArray,
  kTexture2DMS,
  kTexture2DMSArray,
  kSampler,
  kComparisonSampler,
  kAccelerationStructure,
  kTextureBuffer,
};

/// A resource that a source declares and a shader of it can reach.
/// [D3D12: D3D12_SHADER_INPUT_BIND_DESC]
struct ShaderBindingInfo {
  std::string Name = {};                                          ///< as in HLSL
  ShaderResourceType Type = ShaderResourceType::kConstantBuffer;  ///< what it is
  bool IsWritable = false;                                        ///< RW..., Append..., Consume...
  char RegisterClass = 't';                                       ///< 't', 'u', 'b' or 's'
  uint32_t Register = 0;                                          ///< the first register
  uint32_t Space = 0;                                             ///< of the register
  uint32_t Count = 1;                                             ///< 0xFFFFFFFF: unbounded
  uint32_t SizeInBytes = 0;  ///< constant and texture buffers; structured buffers: of an element
  bool IsCBuffer = false;    ///< declared by `cbuffer` or `tbuffer`, or "$Globals"
  ShaderTypeInfo Element;    ///< T of ConstantBuffer<T>, Texture2D<T>, ...; cbuffer: its members
};

/// An input or output of a vertex or pixel shader. [D3D12: D3D12_SIGNATURE_PARAMETER_DESC]
struct ShaderSignatureElement {
  std::string Semantic = {};                           ///< without the number
  uint32_t SemanticIndex = 0;                          ///< the number
  ShaderScalarType Type = ShaderScalarType::kFloat32;  ///< kFloat32, kInt32 or kUint32
  uint32_t Components = 1;                             ///< 1 to 4
};

/// An entry point, or another function that a library exports.
struct ShaderEntryInfo {
  ShaderExportInfo Export;                           ///< as ShaderLibrary::GetExports has it
  std::vector<uint32_t> Bindings = {};               ///< indices into ShaderReflection::Bindings
  std::vector<ShaderSignatureElement> Inputs = {};   ///< vertex and pixel shaders
  std::vector<ShaderSignatureElement> Outputs = {};  ///< vertex and pixel shaders
  std::string RootSignature = {};                    ///< the text of [RootSignature("...")]
};

/// A source's shaders and bindings.
struct ShaderReflection {
  std::vector<ShaderEntryInfo> Entries = {};     ///< in the order of the source
  std::vector<ShaderBindingInfo> Bindings = {};  ///< those that an entry can reach
};

}  // namespace rtapi

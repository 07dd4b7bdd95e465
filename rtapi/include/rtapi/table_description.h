// SPDX-License-Identifier: MIT
/// @file
/// Shader tables made readable: what each record names, its arguments by the local root signature
/// of its export, and which instances, geometries and ray types reach it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <rtapi/device.h>
#include <rtapi/raytracing.h>
#include <rtapi/root_signature.h>
#include <rtapi/state_object.h>

namespace rtapi {

/// One kind of ray of the application: the arguments of its TraceRay calls that choose records.
/// [DXR: Hit group table indexing; Miss shader table indexing]
struct RayTypeDesc {
  std::string Name = {};                                          ///< for people: "shadow"
  uint32_t RayContributionToHitGroupIndex = 0;                    ///< low 4 bits count
  uint32_t MultiplierForGeometryContributionToHitGroupIndex = 0;  ///< low 4 bits count
  uint32_t MissShaderIndex = 0;                                   ///< low 16 bits count
};

/// Selects what DescribeShaderTables describes, and how much of it.
struct TableDescriptionDesc {
  DispatchRaysDesc Dispatch = {};  ///< the tables; those that start at 0 are left out
  /// A top level that is built: with it and ray types each hit record says who reaches it. 0: none.
  GpuVirtualAddress TopLevel = 0;
  std::vector<RayTypeDesc> RayTypes = {};  ///< the rays that the application traces
  /// Reaches that are listed for each record; TableRecord::ReachCount counts all.
  uint32_t MaxReachesPerRecord = 8;
  uint32_t MaxRecords = 65536;           ///< of each table; the rest is left out
  uint32_t MaxDescriptorsPerTable = 16;  ///< of each descriptor table
};

/// Tells where an address points: into a live buffer, or nowhere.
struct AddressDescription {
  GpuVirtualAddress Address = 0;  ///< as it stands in memory
  bool Live = false;              ///< whether it is in a live buffer; else the rest is empty
  std::string Buffer = {};        ///< the buffer's name
  uint64_t OffsetInBytes = 0;     ///< from the start of the buffer
  uint64_t SizeInBytes = 0;       ///< of the buffer
};

/// One slot of a descriptor heap.
struct DescriptorDescription {
  uint32_t Slot = 0;                ///< in its heap
  std::string Kind = {};            ///< "structured buffer", "texture", "null", ...
  std::string Access = {};          ///< "SRV", "UAV", "CBV", "sampler"
  std::string Resource = {};        ///< name of the texture or buffer
  uint32_t StrideInBytes = 0;       ///< of a structured or typed buffer's elements
  uint64_t SizeInBytes = 0;         ///< of a buffer's view
  AddressDescription Address = {};  ///< buffers and acceleration structures
};

/// One argument of a record, or of a parameter that a root signature has.
struct TableArgument {
  RootParameterType Type = RootParameterType::k32BitConstants;  ///< of its parameter
  uint32_t OffsetInBytes = 0;                                   ///< from the start of the record
  std::vector<std::string> Registers = {};  ///< "t0, space2"; descriptor tables: of each range
  std::vector<std::string> Names = {};      ///< of the HLSL resources that read it
  std::vector<uint32_t> Constants = {};     ///< k32BitConstants: the values
  AddressDescription Address = {};          ///< root views
  /// Descriptor tables: the handle, and the heap and slot that it names if it is live.
  ///@{
  uint64_t Handle = 0;
  bool HandleIsLive = false;
  std::string Heap = {};
  uint32_t Slot = 0;
  ///@}
  std::vector<DescriptorDescription> Descriptors = {};  ///< what lies there
  uint32_t DescriptorsLeftOut = 0;                      ///< past MaxDescriptorsPerTable
};

/// Tells what the identifier of a record is.
enum class TableRecordState : uint32_t {
  kNull,        ///< the NULL identifier: nothing runs
  kKnown,       ///< an identifier of this state object that may stand in this table
  kWrongTable,  ///< one of this state object, but of another kind of table
  kUnknown,     ///< bytes that are no identifier of this state object
  kUnreadable,  ///< outside every live buffer
};

/// Who reaches a record. Miss records have the ray type only.
struct TableReach {
  /// As HLSL's system values of the same names.
  ///@{
  uint32_t InstanceIndex = 0;
  uint32_t InstanceID = 0;
  uint32_t GeometryIndex = 0;
  ///@}
  uint32_t RayType = 0;  ///< index in TableDescriptionDesc::RayTypes
};

/// One record of a table.
struct TableRecord {
  uint64_t Index = 0;                                ///< in its table
  AddressDescription Address = {};                   ///< of its first byte
  TableRecordState State = TableRecordState::kNull;  ///< what its identifier is
  std::string Export = {};                           ///< kKnown, kWrongTable: the export's name
  std::string Shader = {};                           ///< the shader, where it is no hit group
  /// Hit groups: the shaders, empty where there is none.
  ///@{
  std::string AnyHitShader = {};
  std::string ClosestHitShader = {};
  std::string IntersectionShader = {};
  ///@}
  std::vector<TableArgument> Arguments = {};  ///< by the export's local root signature
  uint64_t ArgumentBytes = 0;                 ///< that the local root signature asks for
  std::vector<TableReach> ReachedBy = {};     ///< the first MaxReachesPerRecord
  uint64_t ReachCount = 0;                    ///< all of them
};

/// One shader table of a dispatch.
struct DescribedTable {
  std::string Name = {};                  ///< "ray generation", "miss", "hit group", "callable"
  AddressDescription Address = {};        ///< where it starts
  uint64_t SizeInBytes = 0;               ///< as in DispatchRaysDesc
  uint64_t StrideInBytes = 0;             ///< as in DispatchRaysDesc
  std::vector<TableRecord> Records = {};  ///< in order, from record 0
  uint64_t RecordsLeftOut = 0;            ///< past MaxRecords, or behind one that cannot be read
};

/// The result of DescribeShaderTables.
struct TableDescription {
  std::string StateObject = {};            ///< its name
  std::vector<RayTypeDesc> RayTypes = {};  ///< as they were given
  std::vector<DescribedTable> Tables =
      {};                                  ///< in the order of DispatchRaysDesc; those that are set
  std::vector<std::string> Problems = {};  ///< in words: what cannot be as it was meant
};

/// Decodes the shader tables of a dispatch as they are now, so call it when the work that writes
/// them has completed. Nothing is executed. Records that make no sense are described as such, and
/// are no errors. [DXR: Shader tables; Shader table memory initialization]
/// @errors KA0904 an empty handle; KA0903 objects of different devices; KA0915 the state object is
/// a collection, or no top level stands at TopLevel.
Result<TableDescription> DescribeShaderTables(const Device& device, const StateObject& state_object,
                                              const TableDescriptionDesc& desc);

/// A description as lines of text for a terminal.
std::string ToText(const TableDescription& description);
/// A description as JSON: UTF-8, indented by two.
std::string ToJson(const TableDescription& description);

}  // namespace rtapi

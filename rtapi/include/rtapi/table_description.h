// SPDX-License-Identifier: MIT
//
// Shader tables made readable: what each record names, its arguments by the local root signature of
// its export, and which instances, geometries and ray types reach it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <rtapi/device.h>
#include <rtapi/raytracing.h>
#include <rtapi/root_signature.h>
#include <rtapi/state_object.h>

namespace rtapi {

// One kind of ray of the application: the arguments of its TraceRay calls that choose records.
// [DXR: Hit group table indexing; Miss shader table indexing]
struct RayTypeDesc {
  std::string Name = {};
  uint32_t RayContributionToHitGroupIndex = 0;                    // low 4 bits count
  uint32_t MultiplierForGeometryContributionToHitGroupIndex = 0;  // low 4 bits count
  uint32_t MissShaderIndex = 0;                                   // low 16 bits count
};

struct TableDescriptionDesc {
  DispatchRaysDesc Dispatch = {};
  // A top level that is built: with it and ray types each hit record says who reaches it. 0: none.
  GpuVirtualAddress TopLevel = 0;
  std::vector<RayTypeDesc> RayTypes = {};
  // Of each record, at most so many are listed; TableRecord::ReachCount counts all.
  uint32_t MaxReachesPerRecord = 8;
  uint32_t MaxRecords = 65536;           // of each table; the rest is left out
  uint32_t MaxDescriptorsPerTable = 16;  // of each descriptor table
};

// Where an address points: into a live buffer, or nowhere.
struct AddressDescription {
  GpuVirtualAddress Address = 0;
  bool Live = false;
  std::string Buffer = {};  // its name
  uint64_t OffsetInBytes = 0;
  uint64_t SizeInBytes = 0;  // of the buffer
};

// One slot of a descriptor heap.
struct DescriptorDescription {
  uint32_t Slot = 0;
  std::string Kind = {};      // "structured buffer", "texture", "null", ...
  std::string Access = {};    // "SRV", "UAV", "CBV", "sampler"
  std::string Resource = {};  // name of the texture or buffer
  uint32_t StrideInBytes = 0;
  uint64_t SizeInBytes = 0;         // of a buffer's view
  AddressDescription Address = {};  // buffers and acceleration structures
};

// One argument of a record, or of a parameter that a root signature has.
struct TableArgument {
  RootParameterType Type = RootParameterType::k32BitConstants;
  uint32_t OffsetInBytes = 0;               // from the start of the record
  std::vector<std::string> Registers = {};  // "t0, space2"; descriptor tables: of each range
  std::vector<std::string> Names = {};      // of the HLSL resources that read it
  std::vector<uint32_t> Constants = {};
  AddressDescription Address = {};
  // Descriptor tables: the heap and slot that the handle names, and what lies there.
  uint64_t Handle = 0;
  bool HandleIsLive = false;
  std::string Heap = {};
  uint32_t Slot = 0;
  std::vector<DescriptorDescription> Descriptors = {};
  uint32_t DescriptorsLeftOut = 0;
};

enum class TableRecordState : uint32_t {
  kNull,        // the NULL identifier: nothing runs
  kKnown,       // an identifier of this state object that may stand in this table
  kWrongTable,  // one of this state object, but of another kind of table
  kUnknown,     // bytes that are no identifier of this state object
  kUnreadable,  // outside every live buffer
};

// Who reaches a record. Miss records have the ray type only.
struct TableReach {
  uint32_t InstanceIndex = 0;
  uint32_t InstanceID = 0;
  uint32_t GeometryIndex = 0;
  uint32_t RayType = 0;  // index in TableDescriptionDesc::RayTypes
};

struct TableRecord {
  uint64_t Index = 0;
  AddressDescription Address = {};
  TableRecordState State = TableRecordState::kNull;
  std::string Export = {};  // kKnown, kWrongTable
  // Hit groups: the shaders, empty where there is none. Others: Shader.
  std::string Shader = {};
  std::string AnyHitShader = {};
  std::string ClosestHitShader = {};
  std::string IntersectionShader = {};
  std::vector<TableArgument> Arguments = {};
  uint64_t ArgumentBytes = 0;  // that the local root signature asks for
  std::vector<TableReach> ReachedBy = {};
  uint64_t ReachCount = 0;
};

struct DescribedTable {
  std::string Name = {};  // "ray generation", "miss", "hit group", "callable"
  AddressDescription Address = {};
  uint64_t SizeInBytes = 0;
  uint64_t StrideInBytes = 0;
  std::vector<TableRecord> Records = {};
  uint64_t RecordsLeftOut = 0;
};

struct TableDescription {
  std::string StateObject = {};
  std::vector<RayTypeDesc> RayTypes = {};
  std::vector<DescribedTable> Tables = {};  // in the order of DispatchRaysDesc; those that are set
  std::vector<std::string> Problems = {};   // in words: what cannot be as it was meant
};

// Reads the tables as they are now, so call it when the work that writes them has completed.
// Errors: KA0904 an empty handle; KA0903 objects of different devices; KA0915 a table that the host
// cannot read, a state object that is no pipeline.
Result<TableDescription> DescribeShaderTables(const Device& device, const StateObject& state_object,
                                              const TableDescriptionDesc& desc);

std::string ToText(const TableDescription& description);
std::string ToJson(const TableDescription& description);  // UTF-8, indented by two

}  // namespace rtapi

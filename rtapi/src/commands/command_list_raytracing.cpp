// SPDX-License-Identifier: MIT
//
// Builds, copies and queries of acceleration structures.
#include "rtapi/src/commands/command_list_impl.h"
#include "rtapi/src/resources/acceleration_structure.h"

namespace rtapi {

using namespace detail;

namespace {

// A structure of any kind: what is there is known when the command executes, and micromap arrays
// need less alignment.
Status check_any_structure(const DeviceImpl& device, GpuVirtualAddress address,
                           std::string_view what) {
  const bool micromaps =
      device.desc.Tier >= RaytracingTier::kTier1_2 && device.backend->has_micromaps();
  return check_structure_address(device, address, what,
                                 device.desc.IndirectRtasOperations
                                     ? kRtasClusterTemplateByteAlignment
                                 : micromaps ? kRaytracingOpacityMicromapArrayByteAlignment
                                             : kRaytracingAccelerationStructureByteAlignment);
}

void use_inputs(CommandListImpl& list, const char* call, const runtime::BuildCommand& command) {
  if (!command.micromaps.histogram.empty()) {
    list.use(call, command.micromaps.input_buffer, "micromap input buffer");
    list.use(call, command.micromaps.descs.StartAddress, "micromap descs");
  }
  for (size_t i = 0; i < command.geometries.size(); ++i) {
    const RaytracingGeometryDesc& geometry = command.geometries[i];
    const auto use = [&](uint64_t count, GpuVirtualAddress address, const char* what) {
      if (count != 0) list.use(call, address, concat("geometry ", i, " ", what));
    };
    if (geometry.Type == RaytracingGeometryType::kProceduralPrimitiveAabbs) {
      use(geometry.AABBs.AABBCount, geometry.AABBs.AABBs.StartAddress, "AABBs");
      continue;
    }
    const auto& t = geometry.Triangles;
    use(t.VertexCount, t.VertexBuffer.StartAddress, "vertices");
    use(t.IndexCount, t.IndexBuffer, "indices");
    use(1, t.Transform3x4, "Transform3x4");
    if (command.linkages.empty() || !command.linkages[i]) continue;
    const auto& linkage = *command.linkages[i];
    use(1, linkage.OpacityMicromapIndexBuffer.StartAddress, "micromap indices");
    use(1, linkage.OpacityMicromapArray, "micromap array");
  }
}

}  // namespace

void CommandList::BuildRaytracingAccelerationStructure(
    const BuildRaytracingAccelerationStructureDesc& desc,
    std::span<const RaytracingAccelerationStructurePostbuildInfoDesc> postbuild_infos) {
  static constexpr char kCall[] = "BuildRaytracingAccelerationStructure";
  if (!impl_ || !impl_->check_open(kCall)) return;
  const DeviceImpl& device = *impl_->device;
  if (Status s = check_build_inputs(device, desc.Inputs); !s.ok()) return impl_->fail(s.error());
  runtime::BuildCommand command = describe_build(desc.Inputs);
  if (Status s = check_build_addresses(device, desc, command); !s.ok()) {
    return impl_->fail(s.error());
  }
  uint32_t seen = 0;
  for (const auto& info : postbuild_infos) {
    if (Status s = check_postbuild_info(device, info, 1); !s.ok()) return impl_->fail(s.error());
    const uint32_t bit = 1u << static_cast<uint32_t>(info.InfoType);
    if (seen & bit) {
      return impl_->fail(make_error(Id::kPostbuildInfo, kCall, ": InfoType ",
                                    static_cast<uint32_t>(info.InfoType),
                                    " is requested twice; each may be requested once per build"));
    }
    seen |= bit;
  }
  command.dest = desc.DestAccelerationStructureData;
  command.source = desc.SourceAccelerationStructureData;
  command.scratch = desc.ScratchAccelerationStructureData;
  command.postbuild_infos.assign(postbuild_infos.begin(), postbuild_infos.end());
  impl_->use(kCall, command.dest, "dest");
  impl_->use(kCall, command.source, "source");
  impl_->use(kCall, command.scratch, "scratch");
  use_inputs(*impl_, kCall, command);
  if (command.instance_count != 0) impl_->use(kCall, command.instance_descs, "instance descs");
  for (const auto& info : postbuild_infos) impl_->use(kCall, info.DestBuffer, "postbuild info");
  impl_->record(std::move(command));
}

void CommandList::EmitRaytracingAccelerationStructurePostbuildInfo(
    const RaytracingAccelerationStructurePostbuildInfoDesc& desc,
    std::span<const GpuVirtualAddress> sources) {
  static constexpr char kCall[] = "EmitRaytracingAccelerationStructurePostbuildInfo";
  if (!impl_ || !impl_->check_open(kCall)) return;
  const DeviceImpl& device = *impl_->device;
  if (Status s = check_postbuild_info(device, desc, sources.size()); !s.ok()) {
    return impl_->fail(s.error());
  }
  for (size_t i = 0; i < sources.size(); ++i) {
    if (Status s = check_any_structure(device, sources[i], concat("source ", i)); !s.ok()) {
      return impl_->fail(s.error());
    }
  }
  impl_->use(kCall, desc.DestBuffer, "postbuild info");
  for (size_t i = 0; i < sources.size(); ++i) impl_->use(kCall, sources[i], concat("source ", i));
  impl_->record(runtime::EmitPostbuildInfoCommand{desc, {sources.begin(), sources.end()}});
}

void CommandList::CopyRaytracingAccelerationStructure(
    GpuVirtualAddress dest, GpuVirtualAddress source,
    RaytracingAccelerationStructureCopyMode mode) {
  using Mode = RaytracingAccelerationStructureCopyMode;
  static constexpr char kCall[] = "CopyRaytracingAccelerationStructure";
  if (!impl_ || !impl_->check_open(kCall)) return;
  const DeviceImpl& device = *impl_->device;
  if (mode > Mode::kDeserialize) {
    return impl_->fail(make_error(Id::kAccelerationStructureCopy, "mode ",
                                  static_cast<uint32_t>(mode), " is undefined; it must be 0 to 4"));
  }
  const bool writes_bytes = mode == Mode::kSerialize || mode == Mode::kVisualizationDecodeForTools;
  Status s = mode == Mode::kDeserialize
                 ? check_structure_bytes(device, source,
                                         sizeof(SerializedRaytracingAccelerationStructureHeader),
                                         false, "source")
                 : check_any_structure(device, source, "source");
  if (s.ok()) {
    s = writes_bytes ? check_structure_bytes(device, dest, 8, true, "dest")
                     : check_any_structure(device, dest, "dest");
  }
  if (!s.ok()) return impl_->fail(s.error());
  if (source == dest) {
    return impl_->fail(make_error(Id::kAccelerationStructureCopy,
                                  "source and dest are the same address (",
                                  device.describe_address(dest), "); they must not overlap"));
  }
  impl_->use(kCall, dest, "dest");
  impl_->use(kCall, source, "source");
  impl_->record(runtime::CopyAccelerationStructureCommand{dest, source, mode});
}

}  // namespace rtapi

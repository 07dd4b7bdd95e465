// SPDX-License-Identifier: MIT
#include "runtime/operations/cluster_level.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

#include "runtime/backend/dispatch_checks.h"
#include "runtime/operations/batch.h"

namespace kaamos::runtime {

using rtapi::HasAny;

void ClusterLevelBuilder::note(uint32_t index, const std::string& what) {
  notes_.add_about(index, what);
}

bool ClusterLevelBuilder::leave_out(uint32_t index, const std::string& why) {
  note(index, why + "; it is left out");
  return false;
}

bool ClusterLevelBuilder::check_counts(const Args& args, uint32_t index) {
  if (args.ClasAddressCount > inputs_.MaxClasCountPerArg) {
    note(index, "ClasAddressCount is " + std::to_string(args.ClasAddressCount) +
                    ", but MaxClasCountPerArg is " + std::to_string(inputs_.MaxClasCountPerArg));
  }
  total_ += args.ClasAddressCount;
  if (total_ > inputs_.MaxTotalClasCount && !std::exchange(beyond_total_, true)) {
    note(index, "there are now " + std::to_string(total_) + " clusters, but MaxTotalClasCount is " +
                    std::to_string(inputs_.MaxTotalClasCount));
  }
  return true;
}

bool ClusterLevelBuilder::read(const Args& args, uint32_t index, Clusters& clusters,
                               std::vector<uint64_t>& at) {
  const AddressMap& addresses = *environment_.context.addresses;
  std::string why;
  const ArrayInMemory in = find_array(addresses, args.ClasAddressArray, args.ClasAddressStride,
                                      args.ClasAddressCount, 8, 8, why);
  if (in.first == nullptr && args.ClasAddressCount != 0) {
    return leave_out(index, "the addresses of clusters " + why);
  }
  notes_.reads(args.ClasAddressArray, in.bytes(args.ClasAddressCount, 8), "cluster addresses");
  std::unordered_set<uint64_t> seen;
  for (uint32_t i = 0; i < args.ClasAddressCount; ++i) {
    const auto address = load_element<uint64_t>(in, i);
    if (address == 0) continue;
    const auto structure = environment_.structures.find(address);
    notes_.reads(address, structure == nullptr ? 1 : structure->size_bytes, "cluster");
    if (structure == nullptr || structure->cluster == nullptr) {
      note(index, "there is no cluster " + at_address(addresses, address) +
                      ", so the bottom level goes without it");
    } else if (!seen.insert(address).second) {
      note(index,
           "the cluster " + at_address(addresses, address) + " is named twice; it counts once");
    } else {
      clusters.push_back(structure->cluster);
      at.push_back(address);
    }
  }
  check_clusters(clusters, index);
  return true;
}

void ClusterLevelBuilder::check_clusters(const Clusters& clusters, uint32_t index) {
  const auto any = [&](auto property) {
    return std::any_of(clusters.begin(), clusters.end(),
                       [&](const auto& cluster) { return property(*cluster); });
  };
  if (any([](const Cluster& c) { return c.data_access; }) &&
      any([](const Cluster& c) { return !c.data_access; })) {
    note(index,
         "some of its clusters allow data access and others do not; shaders may not read "
         "positions");
  }
  if (any([](const Cluster& c) { return c.linkage != nullptr; }) &&
      !HasAny(inputs_.Flags, rtapi::RtasOperationFlags::kAllowOmm)) {
    note(index, "its clusters have opacity micromaps, but the operation lacks kAllowOmm");
  }
}

rtapi::Result<bool> ClusterLevelBuilder::build(const Clusters& clusters, uint32_t index,
                                               const RebuildLevel& build,
                                               AccelerationStructure& result) {
  using Flags = rtapi::RtasOperationFlags;
  result.flags = BuildFlags::kNone;
  if (HasAny(inputs_.Flags, Flags::kFastTrace)) result.flags |= BuildFlags::kPreferFastTrace;
  if (HasAny(inputs_.Flags, Flags::kFastOperation)) result.flags |= BuildFlags::kPreferFastBuild;
  const auto status = build_clustered_level(clusters, build, result);
  if (status.ok()) return true;
  if (status.error().id != errors::public_id(Id::kTooManyElements)) return status.error();
  return leave_out(index, status.error().message);
}

}  // namespace kaamos::runtime

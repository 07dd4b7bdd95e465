// SPDX-License-Identifier: MIT
#include "runtime/operations/cluster_moves.h"

#include <algorithm>

#include "runtime/backend/dispatch_checks.h"
#include "runtime/structures/cluster.h"

namespace kaamos::runtime {

using rtapi::HasAny;
using Flags = rtapi::RtasClusterMoveOperationFlags;
using Type = rtapi::RtasMoveOperationType;

namespace {

bool is_of(const AccelerationStructure& structure, Type type) {
  switch (type) {
    case Type::kClusterLevelAccelerationStructure:
      return structure.cluster != nullptr;
    case Type::kClusterTemplate:
      return structure.cluster_template != nullptr;
    default:
      return structure.of_clusters;
  }
}

bool has_micromaps(const AccelerationStructure& structure) {
  const auto& of_template = structure.cluster_template;
  return !structure.linkages.empty() ||
         (of_template != nullptr && of_template->cluster.linkage != nullptr);
}

}  // namespace

std::shared_ptr<const AccelerationStructure> ClusterMover::find(const Args& args, uint32_t index) {
  const uint64_t address = args.SourceAccelerationStructure;
  auto source = environment_.structures.find(address);
  notes_.reads(address, source == nullptr ? 1 : source->size_bytes, "source");
  if (source == nullptr || !is_of(*source, inputs_.Type)) {
    static constexpr const char* kNames[] = {"bottom level of clusters", "cluster",
                                             "cluster template"};
    notes_.add_about(
        index, std::string("there is no ") + kNames[static_cast<uint32_t>(inputs_.Type)] + " " +
                   at_address(*environment_.context.addresses, address) + "; it is left out");
    return nullptr;
  }
  if (has_micromaps(*source) && !HasAny(inputs_.Flags, Flags::kAllowOmm)) {
    notes_.add_about(index, "its source has opacity micromaps, but the operation lacks kAllowOmm");
  }
  const uint64_t before = total_bytes_;
  total_bytes_ += source->size_bytes;
  const bool counts = inputs_.Mode != rtapi::RtasOperationMode::kGetSizes;
  if (counts && before <= inputs_.MaxBytesMoved && total_bytes_ > inputs_.MaxBytesMoved) {
    notes_.add_about(index, "there are now " + std::to_string(total_bytes_) +
                                " bytes to move, but MaxBytesMoved is " +
                                std::to_string(inputs_.MaxBytesMoved));
  }
  return source;
}

void note_overlapping_moves(const rtapi::RtasClusterMovesDesc& inputs,
                            const std::vector<RtasResult>& sources, std::vector<RtasResult> results,
                            OperationNotes& notes) {
  if (!HasAny(inputs.Flags, Flags::kNoOverlap)) return;
  const auto by_address = [](const RtasResult& a, const RtasResult& b) {
    return a.address < b.address;
  };
  std::sort(results.begin(), results.end(), by_address);
  for (size_t i = 0; i < sources.size(); ++i) {
    const RtasResult& source = sources[i];
    if (source.size_bytes == 0) continue;
    // Results may overlap each other; the nearest ones are enough to say so once.
    const auto next = std::upper_bound(results.begin(), results.end(), source, by_address);
    const bool before = next != results.begin() &&
                        source.address - std::prev(next)->address < std::prev(next)->size_bytes;
    const bool after = next != results.end() && next->address - source.address < source.size_bytes;
    if (before || after) {
      notes.add("the source of argument " + std::to_string(i) +
                " overlaps a result, although kNoOverlap is set");
    }
  }
}

}  // namespace kaamos::runtime

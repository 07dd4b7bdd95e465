// SPDX-License-Identifier: MIT
#include "runtime/operations/cluster_operations.h"

#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "runtime/operations/batch.h"
#include "runtime/operations/cluster_level.h"
#include "runtime/operations/cluster_triangles.h"

namespace kaamos::runtime {
namespace {

using rtapi::Status;

struct Run {
  const StructureEnvironment& environment;
  const RebuildLevel& build;
  Batch& batch;
  OperationNotes& notes;
  std::vector<BatchObject> objects;  // by argument
};

void keep(BatchObject& object, uint64_t bytes, std::shared_ptr<Cluster> cluster) {
  object.bytes = bytes;
  if (cluster == nullptr) return;
  if (cluster->linkage != nullptr) object.structure.linkages = {cluster->linkage};
  object.structure.cluster = std::move(cluster);
}

Status make(const rtapi::RtasClusterTrianglesInputsDesc& inputs, Run& run) {
  TriangleReader reader(
      run.environment,
      {inputs.Limits, inputs.Flags, inputs.IndexFormat, inputs.GeometryIndexAndFlagsIndexFormat,
       inputs.OpacityMicromapIndexFormat},
      run.notes);
  for (uint32_t i = 0; i < run.batch.count(); ++i) {
    const auto args = run.batch.read<rtapi::RtasBuildClasFromTrianglesArgs>(i);
    if (!reader.check_counts(args, i)) continue;
    const uint64_t bytes = kClusterSize.of(args.TriangleCount, args.VertexCount);
    if (run.batch.only_sizes()) {
      run.objects[i].bytes = bytes;
      continue;
    }
    auto cluster = std::make_shared<Cluster>();
    const bool whole =
        reader.read_topology(args, i, *cluster) && reader.read_positions(args, i, inputs, *cluster);
    if (whole) keep(run.objects[i], bytes, std::move(cluster));
  }
  return {};
}

Status make(const rtapi::RtasClasInputsDesc& inputs, Run& run) {
  ClusterLevelBuilder builder(run.environment, inputs, run.notes);
  for (uint32_t i = 0; i < run.batch.count(); ++i) {
    const auto args = run.batch.read<rtapi::RtasBuildBlasFromClasArgs>(i);
    if (!builder.check_counts(args, i)) continue;
    const uint64_t bytes = kClusteredLevelSize.of(args.ClasAddressCount);
    if (run.batch.only_sizes()) {
      run.objects[i].bytes = bytes;
      continue;
    }
    Clusters clusters;
    if (!builder.read(args, i, clusters)) continue;
    auto built = builder.build(clusters, i, run.build, run.objects[i].structure);
    if (!built) return built.error();
    if (*built) run.objects[i].bytes = bytes;
  }
  return {};
}

// The others are refused when they are recorded.
template <class Inputs>
Status make(const Inputs&, Run&) {
  return {};
}

}  // namespace

Status run_cluster_operation(const StructureEnvironment& environment,
                             const RtasOperation& operation, const std::string& label,
                             const RebuildLevel& build, std::vector<RtasResult>& results) {
  OperationNotes notes(environment, label);
  Batch batch(environment, operation.batch, facts_of(operation.inputs), notes);
  if (!batch.open()) return {};
  Run run = {environment, build, batch, notes, std::vector<BatchObject>(batch.count())};
  const Status status =
      std::visit([&](const auto& inputs) { return make(inputs, run); }, operation.inputs);
  if (!status.ok()) return status;
  batch.finish(std::move(run.objects), results);
  return {};
}

}  // namespace kaamos::runtime

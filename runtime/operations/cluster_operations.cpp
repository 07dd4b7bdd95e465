// SPDX-License-Identifier: MIT
#include "runtime/operations/cluster_operations.h"

#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "runtime/operations/batch.h"
#include "runtime/operations/cluster_level.h"
#include "runtime/operations/cluster_moves.h"
#include "runtime/operations/cluster_templates.h"
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
    if (!builder.read(args, i, clusters, run.objects[i].clusters)) continue;
    auto built = builder.build(clusters, i, run.build, run.objects[i].structure);
    if (!built) return built.error();
    run.objects[i].structure.clusters =
        std::make_shared<const std::vector<uint64_t>>(run.objects[i].clusters);
    if (*built) run.objects[i].bytes = bytes;
  }
  return {};
}

Status make(const rtapi::RtasClusterTemplateTrianglesInputsDesc& inputs, Run& run) {
  TemplateReader reader(run.environment, inputs, run.notes);
  for (uint32_t i = 0; i < run.batch.count(); ++i) {
    const auto args = run.batch.read<rtapi::RtasBuildClusterTemplatesFromTrianglesArgs>(i);
    if (!reader.check_counts(args, i)) continue;
    const auto& counts = args.TrianglesArgs;
    const uint64_t bytes = kTemplateSize.of(counts.TriangleCount, counts.VertexCount);
    if (run.batch.only_sizes()) {
      run.objects[i].bytes = bytes;
    } else if (auto made = reader.read(args, i)) {
      run.objects[i].bytes = bytes;
      run.objects[i].structure.cluster_template = std::move(made);
    }
  }
  return {};
}

Status make(const rtapi::RtasInstantiateClusterTemplateInputsDesc& inputs, Run& run) {
  TemplateInstantiator instantiator(run.environment, inputs, run.notes);
  for (uint32_t i = 0; i < run.batch.count(); ++i) {
    const auto args = run.batch.read<rtapi::RtasInstantiateClusterTemplatesArgs>(i);
    const auto from = instantiator.find(args, i);
    if (from == nullptr) continue;
    const uint64_t bytes = kClusterSize.of(from->cluster.triangles(), from->vertices);
    if (run.batch.only_sizes()) {
      run.objects[i].bytes = bytes;
    } else if (auto made = instantiator.make(*from, args, i)) {
      keep(run.objects[i], bytes, std::move(made));
    }
  }
  return {};
}

Status make(const rtapi::RtasClusterMovesDesc& inputs, Run& run) {
  ClusterMover mover(run.environment, inputs, run.notes);
  for (uint32_t i = 0; i < run.batch.count(); ++i) {
    const auto args = run.batch.read<rtapi::RtasMoveClusterObjectsArgs>(i);
    if (const auto source = mover.find(args, i)) {
      run.objects[i].bytes = source->size_bytes;
      run.objects[i].moved_from = source->address;
      if (!run.batch.only_sizes()) run.objects[i].structure = *source;
    }
  }
  return {};
}

// The inputs of partitioned top levels make no batch.
Status make(const rtapi::RtasPartitionedTlasInputsDesc&, Run&) {
  return {};
}

// What only shows once all destinations are known.
void check_overlaps(const RtasOperation& operation, const Run& run,
                    const std::vector<RtasResult>& sources, std::vector<RtasResult> placed) {
  const auto* moves = std::get_if<rtapi::RtasClusterMovesDesc>(&operation.inputs);
  if (moves != nullptr) note_overlapping_moves(*moves, sources, std::move(placed), run.notes);
}

}  // namespace

Status run_cluster_operation(const StructureEnvironment& environment,
                             const RtasOperation& operation, OperationNotes& notes,
                             const RebuildLevel& build, std::vector<RtasResult>& results) {
  Batch batch(environment, operation.batch, facts_of(operation.inputs), notes);
  if (!batch.open()) return {};
  Run run = {environment, build, batch, notes, std::vector<BatchObject>(batch.count())};
  const Status status =
      std::visit([&](const auto& inputs) { return make(inputs, run); }, operation.inputs);
  if (!status.ok()) return status;
  std::vector<RtasResult> sources;
  for (const BatchObject& object : run.objects) {
    sources.push_back({object.moved_from, object.moved_from == 0 ? 0 : object.bytes});
  }
  const auto before = static_cast<std::ptrdiff_t>(results.size());
  batch.finish(std::move(run.objects), results);
  check_overlaps(operation, run, sources, {results.begin() + before, results.end()});
  return {};
}

}  // namespace kaamos::runtime

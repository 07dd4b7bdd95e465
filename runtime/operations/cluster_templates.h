// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL. Cluster templates, and clusters that are made of them and of positions.
// [DXR 2.0: Cluster templates]
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <rtapi/rtas_operations.h>

#include "runtime/operations/cluster_triangles.h"
#include "runtime/operations/notes.h"
#include "runtime/structures/cluster.h"
#include "runtime/structures/structure_commands.h"

namespace kaamos::runtime {

// Reads the templates of one operation.
class TemplateReader {
 public:
  using Args = rtapi::RtasBuildClusterTemplatesFromTrianglesArgs;
  TemplateReader(const StructureEnvironment& environment,
                 const rtapi::RtasClusterTemplateTrianglesInputsDesc& inputs, OperationNotes& notes)
      : environment_(environment),
        inputs_(inputs),
        notes_(notes),
        triangles_(environment,
                   {inputs.Limits, inputs.Flags, inputs.IndexFormat,
                    inputs.GeometryIndexAndFlagsIndexFormat, inputs.OpacityMicromapIndexFormat},
                   notes) {}

  bool check_counts(const Args& args, uint32_t index) {
    return triangles_.check_counts(args.TrianglesArgs, index);
  }
  // Null: the argument is left out.
  std::shared_ptr<ClusterTemplate> read(const Args& args, uint32_t index);

 private:
  bool read_box(uint64_t address, uint32_t index, ClusterTemplate& result);

  const StructureEnvironment& environment_;
  rtapi::RtasClusterTemplateTrianglesInputsDesc inputs_;
  OperationNotes& notes_;
  TriangleReader triangles_;
};

// Makes the clusters of one operation.
class TemplateInstantiator {
 public:
  using Args = rtapi::RtasInstantiateClusterTemplatesArgs;
  TemplateInstantiator(const StructureEnvironment& environment,
                       const rtapi::RtasInstantiateClusterTemplateInputsDesc& inputs,
                       OperationNotes& notes)
      : environment_(environment),
        inputs_(inputs),
        notes_(notes),
        triangles_(environment, {inputs.Limits, inputs.Flags, {}, {}, {}}, notes) {}

  // The argument's template; null: it is left out.
  std::shared_ptr<const ClusterTemplate> find(const Args& args, uint32_t index);
  // Null: the argument is left out.
  std::shared_ptr<Cluster> make(const ClusterTemplate& from, const Args& args, uint32_t index);

 private:
  void note(uint32_t index, const std::string& what);
  void offset_geometry(const Args& args, uint32_t index, Cluster& cluster);
  bool read_positions(const ClusterTemplate& from, const Args& args, uint32_t index,
                      Cluster& cluster);
  void check_box(const ClusterTemplate& from, uint32_t index, const Cluster& cluster);

  const StructureEnvironment& environment_;
  rtapi::RtasInstantiateClusterTemplateInputsDesc inputs_;
  OperationNotes& notes_;
  TriangleReader triangles_;
};

}  // namespace kaamos::runtime

// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL. Reads clusters of triangles from GPU memory.
// [DXR 2.0: D3D12_RTAS_OPERATION_BUILD_CLAS_FROM_TRIANGLES_ARGS]
#pragma once

#include <cstdint>
#include <string>

#include <rtapi/rtas_operations.h>

#include "runtime/operations/notes.h"
#include "runtime/structures/cluster.h"
#include "runtime/structures/structure_commands.h"

namespace kaamos::runtime {

// What the inputs say of the arguments of clusters, and of templates.
struct TriangleInputs {
  rtapi::RtasClusterLimits limits = {};
  rtapi::RtasOperationFlags flags = {};
  rtapi::RtasIndexFormat index_format = {};
  rtapi::RtasIndexFormat geometry_index_format = {};
  rtapi::RtasIndexFormat micromap_index_format = {};
};

// Reads the arguments of one operation.
class TriangleReader {
 public:
  using Args = rtapi::RtasBuildClasFromTrianglesArgs;
  TriangleReader(const StructureEnvironment& environment, const TriangleInputs& inputs,
                 OperationNotes& notes)
      : environment_(environment), inputs_(inputs), notes_(notes) {}

  // Whether an argument has counts that a cluster may have. Notes those beyond the limits.
  bool check_counts(const Args& args, uint32_t index);
  // Reads all but positions. False: the argument is left out.
  bool read_topology(const Args& args, uint32_t index, Cluster& cluster);
  // Reads positions, and those of further vertices that indices name.
  bool read_positions(const Args& args, uint32_t index,
                      const rtapi::RtasClusterTrianglesInputsDesc& inputs, Cluster& cluster);

 private:
  bool leave_out(uint32_t index, const std::string& why);
  void note(uint32_t index, const std::string& what);
  bool read_indices(const Args& args, uint32_t index, Cluster& cluster);
  bool read_geometry(const Args& args, uint32_t index, Cluster& cluster);
  bool read_micromaps(const Args& args, uint32_t index, Cluster& cluster);
  void check_geometry(uint32_t index, const Cluster& cluster);

  const StructureEnvironment& environment_;
  TriangleInputs inputs_;
  OperationNotes& notes_;
  uint64_t total_triangles_ = 0;
  uint64_t total_vertices_ = 0;
  bool beyond_totals_ = false;
};

}  // namespace kaamos::runtime

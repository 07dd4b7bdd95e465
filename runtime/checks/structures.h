// SPDX-License-Identifier: MIT
//
// Tracks which acceleration structures are where, what they were made of, and whether they may
// still be used. It is kept apart from the backend's own map because it also remembers structures
// that are gone, to say what happened to them. [DXR: Acceleration structure memory restrictions;
// Data rules]
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "runtime/backend/address_map.h"
#include "runtime/backend/commands.h"
#include "runtime/structures/structure_map.h"

namespace kaamos::checks {

// Besides the shapes, what an update must not change. [DXR: Bottom-level acceleration structure
// updates]
struct GeometryContents {
  uint64_t indices = 0;  // a hash; 0 without indices
  uint64_t active = 0;   // a hash of which vertices or boxes are inactive
};

// An instance record as the build read it.
struct TrackedInstance {
  uint64_t bottom_level = 0;  // 0: inactive
  // The bottom level's version when this was built; in a partitioned top level, when the instance
  // was written or updated. 0: there was none.
  uint64_t version = 0;
  uint32_t contribution = 0;
  uint32_t mask = 0;
  uint32_t flags = 0;
};

// The micromap array of a geometry.
struct TrackedLinkage {
  uint64_t array = 0;    // 0: none is needed
  uint64_t version = 0;  // of the array when it was linked; 0: there was none

  bool operator==(const TrackedLinkage&) const = default;
};

// A cluster of a bottom level.
struct TrackedCluster {
  uint64_t address = 0;
  uint64_t version = 0;  // when the bottom level was built
};

struct TrackedStructure {
  uint64_t address = 0;
  uint64_t size_bytes = 0;
  uint64_t version = 0;  // never used twice
  bool top = false;
  bool partitioned = false;
  bool known = true;  // false: deserialized, so its contents are unknown
  runtime::BuildFlags flags = runtime::BuildFlags::kNone;
  std::vector<runtime::GeometryShape> geometries;
  std::vector<GeometryContents> contents;  // one per geometry
  std::vector<TrackedInstance> instances;
  std::vector<TrackedLinkage> linkages;  // of geometries with micromaps, in order
  bool of_clusters = false;              // a bottom level of clusters
  std::vector<TrackedCluster> clusters;  // of which it was built
  std::array<uint8_t, 16> header = {};   // what its first bytes were
};

enum class StructureState : uint8_t {
  kAlive,
  kNever,        // nothing was ever built at this address
  kOverwritten,  // its bytes were overwritten
  kReplaced,     // another structure was built or copied over part of it
  kFreed,        // its buffer is gone
  kBytesCopied,  // only its bytes were copied there
};

class Structures {
 public:
  explicit Structures(const runtime::AddressMap& addresses) : addresses_(addresses) {}

  // The instance records of a top level build, from GPU memory.
  std::vector<rtapi::RaytracingInstanceDesc> read_instances(
      const runtime::BuildCommand& command) const;

  void built(const runtime::BuildCommand& command, uint64_t size_bytes,
             std::vector<GeometryContents> contents,
             const std::vector<rtapi::RaytracingInstanceDesc>& instances);
  void copied(const runtime::CopyAccelerationStructureCommand& command, uint64_t size_bytes);
  // What the operations of a call made.
  void operated(const std::vector<runtime::RtasResult>& results);
  // A command of the list wrote something else there.
  void written(uint64_t address, uint64_t size_bytes) { end_in(address, size_bytes, 0); }

  // Returns what is or was at exactly this address; null only for kNever and kBytesCopied.
  const TrackedStructure* find(uint64_t address, StructureState& state) const;
  // Grows with every change to any structure.
  uint64_t version() const { return next_version_; }
  // " built over it ...": the end of a message about a structure that is gone.
  std::string history(uint64_t address, StructureState state) const;

 private:
  void place(TrackedStructure structure);
  uint64_t version_at(uint64_t address) const;  // 0: nothing is alive there
  TrackedStructure moved(const runtime::RtasResult& result) const;
  void add_clusters(const runtime::RtasResult& result, TrackedStructure& structure) const;
  void add_instances(const runtime::RtasResult& result, TrackedStructure& structure) const;
  void link(const runtime::BuildCommand& command, TrackedStructure& structure) const;
  // Ends every structure that has bytes there; `by` is the structure that replaces it, 0: other
  // bytes.
  void end_in(uint64_t address, uint64_t size_bytes, uint64_t by);
  uint64_t structure_bytes(uint64_t address) const;
  // Returns where the structure whose bytes are at this address was built; 0: none.
  uint64_t copied_from(uint64_t address) const;

  const runtime::AddressMap& addresses_;
  std::map<uint64_t, TrackedStructure> structures_;
  struct Gone {
    TrackedStructure structure;
    uint64_t by = 0;  // address of the structure that replaced it; 0: other bytes
  };
  std::map<uint64_t, Gone> gone_;
  std::map<std::array<uint8_t, 16>, uint64_t> headers_;  // of every structure built -> its address
  uint64_t next_version_ = 1;
};

}  // namespace kaamos::checks

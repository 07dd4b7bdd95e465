// SPDX-License-Identifier: MIT
//
// Which acceleration structures stand where, of what they were made, and whether they may still be
// used. Its own book beside the backend's: it remembers what is gone, to say what happened to it.
// [DXR: Acceleration structure memory restrictions; Data rules]
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

// What an update must not change, besides the shapes. [DXR: Bottom-level acceleration structure
// updates]
struct GeometryContents {
  uint64_t indices = 0;  // a hash; 0 without
  uint64_t active = 0;   // a hash of which vertices or boxes are inactive
};

// An instance record as the build read it.
struct TrackedInstance {
  uint64_t bottom_level = 0;  // 0: inactive
  uint64_t version = 0;       // of the bottom level at the build; 0: there was none
  uint32_t contribution = 0;
  uint32_t mask = 0;
  uint32_t flags = 0;
};

struct TrackedStructure {
  uint64_t address = 0;
  uint64_t size_bytes = 0;
  uint64_t version = 0;  // never twice
  bool top = false;
  bool known = true;  // false: deserialized, its contents cannot be told
  runtime::BuildFlags flags = runtime::BuildFlags::kNone;
  std::vector<runtime::GeometryShape> geometries;
  std::vector<GeometryContents> contents;  // of the geometries
  std::vector<TrackedInstance> instances;
  std::array<uint8_t, 16> header = {};  // what its first bytes were
};

enum class StructureState : uint8_t {
  kAlive,
  kNever,        // nothing was ever built at this address
  kOverwritten,  // its bytes were written over
  kReplaced,     // another structure was built or copied over a part of it
  kFreed,        // its buffer is gone
  kBytesCopied,  // only bytes were copied there
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
  // Something else was written there by a command of the list.
  void written(uint64_t address, uint64_t size_bytes) { end_in(address, size_bytes, 0); }

  // What stood or stands at exactly this address; null only for kNever and kBytesCopied.
  const TrackedStructure* find(uint64_t address, StructureState& state) const;
  // Grows with everything that happens to structures.
  uint64_t version() const { return next_version_; }
  // " built over it ...", for messages about what is no more; starts with a word.
  std::string history(uint64_t address, StructureState state) const;

 private:
  void place(TrackedStructure structure);
  // Ends what has bytes there; `by` is the structure that takes its place, 0: other bytes.
  void end_in(uint64_t address, uint64_t size_bytes, uint64_t by);
  uint64_t structure_bytes(uint64_t address) const;
  // Where the structure was built whose bytes stand at this address; 0: none.
  uint64_t copied_from(uint64_t address) const;

  const runtime::AddressMap& addresses_;
  std::map<uint64_t, TrackedStructure> structures_;
  struct Gone {
    TrackedStructure structure;
    uint64_t by = 0;  // address of the structure that replaced it; 0: other bytes
  };
  std::map<uint64_t, Gone> gone_;
  std::map<std::array<uint8_t, 16>, uint64_t> headers_;  // of all that were built -> address
  uint64_t next_version_ = 1;
};

}  // namespace kaamos::checks

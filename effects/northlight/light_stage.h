// SPDX-License-Identifier: MIT
/// @file
/// The lights of a frame: lists and shadow maps of local lights, main lighting, and the volume of
/// indirect light.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <optional>

#include "effects/indirect/indirect_diffuse/volume.h"
#include "effects/indirect/indirect_diffuse/volume_on_demand.h"
#include "effects/light/direct/direct.h"
#include "effects/light/lights/lighting.h"
#include "effects/northlight/frame_context.h"

namespace kaamos::effects {

/// The lighting that a whole frame has for effects that shade; other frames have none of it.
class LightStage {
 public:
  /// The demands that effects make on main lighting.
  struct Needs {
    bool main = false;       ///< a picture of all local lights
    bool strongest = false;  ///< the strongest lights of each pixel are added later
  };

  /// The context must stay.
  explicit LightStage(FrameContext& context) : context_(context) {}
  LightStage(const LightStage&) = delete;
  LightStage& operator=(const LightStage&) = delete;

  /// Makes all of it, and bakes or reads the volume, unless it is baked on demand.
  /// @errors KA3041 more than 4,096 local lights; KA3045 a volume file that cannot be read or
  /// written; those of the device.
  rtapi::Result<Outcome> create(const Needs& needs, const Progress& progress);
  /// Follows the camera, before anything is recorded.
  void begin_frame();
  /// Returns whether cells of the volume are baked when they are read.
  bool bakes_on_demand() const { return on_demand_.has_value(); }
  /// Bakes what the volume's readers have read since the last call, with the lights that were
  /// executed or recorded last.
  /// `is_first`: the readers are to be run again, because what lies in solids is known only now.
  /// Precondition: bakes_on_demand.
  /// @errors those of the device.
  rtapi::Result<Outcome> bake_read(bool is_first, const Progress& progress);
  /// The cells that the last bake_read baked.
  std::uint32_t baked() const { return baked_; }
  /// Records the lists, the maps and main lighting, as far as frames read them.
  void record(rtapi::CommandList& list);
  /// Executes that as a pass of the frame.
  /// @errors those of the device.
  rtapi::Status run();
  /// Records the strongest lights, added with the visibility that was summed up last. Nothing where
  /// main lighting has them already.
  void record_strongest(rtapi::CommandList& list) const;
  /// Sets that visibility, and how their shadow maps count besides. [DirectLighting::set_contact]
  /// @errors those of PassViews::set_unordered_access.
  rtapi::Status set_contact(const rtapi::Texture& contact, ContactCombination combination) {
    combination_ = combination;
    return direct_->set_contact(contact);
  }

  /// Lists and shadow maps of local lights; who reads them where no effect of the frame does,
  /// updates them. Null: no whole frame, or none before prepare.
  const Lighting* lighting() const { return lighting_ ? &*lighting_ : nullptr; }
  /// Null: no local lights.
  const DirectLighting* main() const { return direct_ ? &*direct_ : nullptr; }
  /// The light of all local lights. Precondition: main lighting is there.
  const rtapi::Texture& picture() const {
    return leaves_out_strongest_ ? direct_->total() : direct_->direct();
  }
  /// Returns whether an effect of this frame reads the volume of indirect light.
  bool reads_volume() const;
  /// Null: no effect of this frame reads it, or none before prepare.
  const GpuVolume* volume() const { return has_volume_ ? &gpu_volume_ : nullptr; }
  /// The volume, and one without any light.
  ///@{
  const GpuVolume& gpu_volume() const { return gpu_volume_; }
  const GpuVolume& no_volume() const { return no_volume_; }
  ///@}
  /// Statistics of baking it; empty if nothing was baked.
  std::optional<BakeStatistics> bake() const;

 private:
  // Returns whether an effect with such needs is rendered.
  template <class Reads>
  bool any_rendered(Reads reads) const;
  // Returns whether lists and maps are read before the first frame.
  bool reads_early() const;
  bool bakes_volume() const;
  rtapi::Status create_lighting();
  void list_left_out(std::uint32_t lights);
  rtapi::Result<Outcome> create_volume(const Progress& progress);
  rtapi::Result<IndirectVolume> lay_out_volume();
  rtapi::Result<Outcome> bake_volume(IndirectVolume& volume, const Progress& progress);
  BakeScope bake_scope() const;
  BakeDesc bake_desc(bool is_whole) const;

  FrameContext& context_;
  std::optional<Lighting> lighting_;
  std::optional<DirectLighting> direct_;
  bool reads_lights_ = true;  // somebody does in frames: lists and maps, also that of the sun
  bool has_main_ = false, leaves_out_strongest_ = false, has_volume_ = false;
  ContactCombination combination_ = ContactCombination::kProduct;
  GpuVolume gpu_volume_, no_volume_;
  std::optional<BakeStatistics> bake_;
  std::optional<VolumeOnDemand> on_demand_;
  std::uint32_t baked_ = 0;
  bool is_asking_ = true;  // the volume on the device is VolumeOnDemand::asking()
};

}  // namespace kaamos::effects

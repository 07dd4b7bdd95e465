// SPDX-License-Identifier: MIT
// D3D12's categories and ids of messages, where one fits.
#pragma once

#include <directx/d3d12sdklayers.h>

#include <rtapi/result.h>

namespace kaamos::d3d12 {

struct MessageKind {
  D3D12_MESSAGE_CATEGORY category;
  D3D12_MESSAGE_ID id;
};

/// Finds the category and id of an error by its own id. An error for which D3D12 has no id gets
/// D3D12_MESSAGE_ID_UNKNOWN and the category of its range.
MessageKind message_kind(rtapi::ErrorId error);

}  // namespace kaamos::d3d12

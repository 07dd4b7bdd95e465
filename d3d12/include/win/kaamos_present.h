// SPDX-License-Identifier: MIT
/// @file
/// Frames that a swap chain presents, handed to the program's own function. No Windows program
/// needs it; a test or a viewer on Linux may.
#pragma once

#include <directx/dxgiformat.h>
#include <windows.h>

/// A presented back buffer.
struct KaamosFrame {
  UINT64 number;       ///< of the swap chain's presents, from 0
  UINT width;          ///< pixels
  UINT height;         ///< pixels
  DXGI_FORMAT format;  ///< of the back buffer
  UINT row_bytes;      ///< from row to row; a row may end with unused bytes
  const void* pixels;  ///< the top row first, valid during the call
  HWND window;         ///< null without one
};

/// Called by Present, on its thread, once the queue has drawn the frame.
typedef void (*KaamosPresentCallback)(const KaamosFrame* frame, void* user);

/// Sets the function for all swap chains of the process; null: none. Frames are written as
/// KAAMOS_PRESENT says with it, too.
EXTERN_C void kaamos_on_present(KaamosPresentCallback callback, void* user);

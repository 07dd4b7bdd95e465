// SPDX-License-Identifier: MIT
// IDXGIOutput: the one monitor, which nobody sees.
#pragma once

#include "d3d12/dxgi/dxgi_object.h"

namespace kaamos::d3d12 {

/// A monitor of the size that GetSystemMetrics tells, at 60 Hz, with sRGB's colours.
class Output final : public DxgiObject<IDXGIOutputEntries> {
 public:
  explicit Output(IUnknown* adapter) : DxgiObject(adapter) {}

  HRESULT STDMETHODCALLTYPE GetDesc(DXGI_OUTPUT_DESC* desc) override;
  HRESULT STDMETHODCALLTYPE GetDesc1(DXGI_OUTPUT_DESC1* desc) override;
  HRESULT STDMETHODCALLTYPE GetDisplayModeList(DXGI_FORMAT format, UINT flags, UINT* count,
                                               DXGI_MODE_DESC* modes) override;
  HRESULT STDMETHODCALLTYPE GetDisplayModeList1(DXGI_FORMAT format, UINT flags, UINT* count,
                                                DXGI_MODE_DESC1* modes) override;
  HRESULT STDMETHODCALLTYPE FindClosestMatchingMode(const DXGI_MODE_DESC* wanted,
                                                    DXGI_MODE_DESC* closest,
                                                    IUnknown* device) override;
  /// Returns at once: no frame waits for a display.
  HRESULT STDMETHODCALLTYPE WaitForVBlank() override { return S_OK; }
  BOOL STDMETHODCALLTYPE SupportsOverlays() override { return FALSE; }
  HRESULT STDMETHODCALLTYPE CheckHardwareCompositionSupport(UINT* flags) override;
};

/// Formats that a monitor shows and swap chains have. [DXGI: swap chains of the flip model]
bool is_display_format(DXGI_FORMAT format);

}  // namespace kaamos::d3d12

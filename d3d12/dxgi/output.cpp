// SPDX-License-Identifier: MIT
#include "d3d12/dxgi/output.h"

#include <windows.h>

#include <array>
#include <cstdlib>
#include <vector>

namespace kaamos::d3d12 {

namespace {

constexpr std::array<SIZE, 4> kSizes = {{{640, 480}, {1280, 720}, {1600, 900}, {1920, 1080}}};

// Modes differ between versions of the structure by its last member alone, which is zero here.
template <class Mode>
std::vector<Mode> modes_of(DXGI_FORMAT format) {
  std::vector<Mode> out;
  if (!is_display_format(format)) return out;
  for (const SIZE& size : kSizes) {
    Mode mode = {};
    mode.Width = static_cast<UINT>(size.cx);
    mode.Height = static_cast<UINT>(size.cy);
    mode.RefreshRate = {60, 1};
    mode.Format = format;
    mode.ScanlineOrdering = DXGI_MODE_SCANLINE_ORDER_PROGRESSIVE;
    out.push_back(mode);
  }
  return out;
}

template <class Mode>
HRESULT list_modes(DXGI_FORMAT format, UINT* count, Mode* modes) {
  if (count == nullptr) return E_INVALIDARG;
  const std::vector<Mode> all = modes_of<Mode>(format);
  if (modes == nullptr) {
    *count = static_cast<UINT>(all.size());
    return S_OK;
  }
  if (*count < all.size()) return DXGI_ERROR_MORE_DATA;
  std::copy(all.begin(), all.end(), modes);
  *count = static_cast<UINT>(all.size());
  return S_OK;
}

template <class Desc>
HRESULT describe(Desc* desc) {
  if (desc == nullptr) return E_INVALIDARG;
  *desc = {};
  std::wstring_view(L"\\\\.\\DISPLAY1").copy(desc->DeviceName, std::size(desc->DeviceName) - 1);
  desc->DesktopCoordinates = {0, 0, GetSystemMetrics(SM_CXSCREEN), GetSystemMetrics(SM_CYSCREEN)};
  desc->AttachedToDesktop = TRUE;
  desc->Rotation = DXGI_MODE_ROTATION_IDENTITY;
  desc->Monitor = MonitorFromWindow(nullptr, MONITOR_DEFAULTTOPRIMARY);
  return S_OK;
}

}  // namespace

bool is_display_format(DXGI_FORMAT format) {
  return format == DXGI_FORMAT_R16G16B16A16_FLOAT || format == DXGI_FORMAT_R10G10B10A2_UNORM ||
         format == DXGI_FORMAT_R8G8B8A8_UNORM || format == DXGI_FORMAT_B8G8R8A8_UNORM;
}

HRESULT Output::GetDesc(DXGI_OUTPUT_DESC* desc) {
  return describe(desc);
}

HRESULT Output::GetDesc1(DXGI_OUTPUT_DESC1* desc) {
  if (const HRESULT result = describe(desc); result != S_OK) return result;
  desc->BitsPerColor = 8;
  desc->ColorSpace = DXGI_COLOR_SPACE_RGB_FULL_G22_NONE_P709;
  // The primaries of ITU-R BT.709.
  const float primaries[4][2] = {{0.64F, 0.33F}, {0.3F, 0.6F}, {0.15F, 0.06F}, {0.3127F, 0.329F}};
  float* const to[4] = {desc->RedPrimary, desc->GreenPrimary, desc->BluePrimary, desc->WhitePoint};
  for (int i = 0; i < 4; ++i) std::copy(primaries[i], primaries[i] + 2, to[i]);
  desc->MinLuminance = 0.5F;
  desc->MaxLuminance = desc->MaxFullFrameLuminance = 80;  // [IEC 61966-2-1]
  return S_OK;
}

HRESULT Output::GetDisplayModeList(DXGI_FORMAT format, UINT, UINT* count, DXGI_MODE_DESC* modes) {
  return list_modes(format, count, modes);
}

HRESULT Output::GetDisplayModeList1(DXGI_FORMAT format, UINT, UINT* count, DXGI_MODE_DESC1* modes) {
  return list_modes(format, count, modes);
}

HRESULT Output::FindClosestMatchingMode(const DXGI_MODE_DESC* wanted, DXGI_MODE_DESC* closest,
                                        IUnknown*) {
  if (wanted == nullptr || closest == nullptr) return E_INVALIDARG;
  const DXGI_FORMAT format =
      is_display_format(wanted->Format) ? wanted->Format : DXGI_FORMAT_R8G8B8A8_UNORM;
  // Without a size, that of the desktop, which is the last.
  const auto distance = [&](const DXGI_MODE_DESC& mode) {
    if (wanted->Width == 0 || wanted->Height == 0) return -static_cast<long long>(mode.Width);
    return std::llabs(static_cast<long long>(mode.Width) - wanted->Width) +
           std::llabs(static_cast<long long>(mode.Height) - wanted->Height);
  };
  const auto modes = modes_of<DXGI_MODE_DESC>(format);
  *closest = modes.front();
  for (const DXGI_MODE_DESC& mode : modes) {
    if (distance(mode) < distance(*closest)) *closest = mode;
  }
  return S_OK;
}

HRESULT Output::CheckHardwareCompositionSupport(UINT* flags) {
  if (flags == nullptr) return E_INVALIDARG;
  *flags = 0;
  return S_OK;
}

}  // namespace kaamos::d3d12

// SPDX-License-Identifier: MIT
// Which materials have a model of their own, and what it shows in the place of the unified one.
#ifndef KAAMOS_VARIANTS_HLSLI
#define KAAMOS_VARIANTS_HLSLI

#include "eye.hlsli"
#include "hair.hlsli"
#include "skin.hlsli"

// Bits of MaterialConstants::flags. [effects/assets/scene/material.h]
static const uint kMaterialSkin = 32;
static const uint kMaterialEye = 64;
static const uint kMaterialHair = 128;
static const uint kMaterialVariants = kMaterialSkin | kMaterialEye | kMaterialHair;

#endif

#pragma once

#include <string_view>

/// Shader text of the built-in materials. Variants are made with #define lines before it.
namespace gnomon::render::glsl {

std::string_view version() noexcept;
/// HAS_NORMALS HAS_TEXCOORDS HAS_TANGENTS HAS_COLORS: what the mesh has. DEPTH_ONLY.
std::string_view meshVertex() noexcept;
/// Light blocks and the surface's material.
std::string_view meshCommon() noexcept;
/// Texture unit of the images of factorLookup().
inline constexpr unsigned factorUnit = 10;
/// Of factors in an image: what lookupGlsl() and a filter are otherwise.
std::string_view factorLookup() noexcept;
/// Where a fragment is; before meshColor(), meshFactor() and meshUnblurred().
std::string_view meshPlaces() noexcept;
/// Colour pass; after the shadow lookup's text.
std::string_view meshColor() noexcept;
/// Depth of masked casters.
std::string_view meshDepth() noexcept;
/// One light's shadow factor; after the shadow lookup's text.
std::string_view meshFactor() noexcept;
/// Before what follows.
std::string_view blurCommon() noexcept;
/// Surfaces, and some lights' factors and kernels, for ScreenBlur; after the shadow lookup's text.
std::string_view meshUnblurred() noexcept;
/// Passes of ScreenBlur. Least and greatest factor of each block of pixels, and the widest kernel.
std::string_view blurRanges() noexcept;
/// How far from each block factors differ.
std::string_view blurBlocks() noexcept;
/// Covers the blocks that a blur changes.
std::string_view blurVertex() noexcept;
std::string_view blur() noexcept;
/// A triangle that covers the viewport.
std::string_view coverVertex() noexcept;
/// A strip of coloured rows, from below the picture to above it.
std::string_view backgroundVertex() noexcept;
std::string_view background() noexcept;
std::string_view foregroundVertex() noexcept;
std::string_view foreground() noexcept;
/// Darkens what a material with shaders of its own drew; after the shadow lookup's text.
std::string_view combine() noexcept;
/// Least and greatest depth of each block of 32 by 32 pixels; with coverVertex.
std::string_view depthRange() noexcept;

}  // namespace gnomon::render::glsl

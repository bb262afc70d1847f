#pragma once

#include <string_view>

/// Shader text of the built-in materials. Variants are made with #define lines before it.
namespace gnomon::render::glsl {

std::string_view version() noexcept;
/// HAS_NORMALS HAS_TEXCOORDS HAS_TANGENTS HAS_COLORS: what the mesh has. DEPTH_ONLY.
std::string_view meshVertex() noexcept;
/// Light blocks and the surface's material.
std::string_view meshCommon() noexcept;
/// Of factors that were traced: what lookupGlsl() and a filter are otherwise.
std::string_view tracedLookup() noexcept;
/// Colour pass; after the shadow lookup's text.
std::string_view meshColor() noexcept;
/// Depth of masked casters.
std::string_view meshDepth() noexcept;
/// One light's shadow factor; after the shadow lookup's text.
std::string_view meshFactor() noexcept;
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

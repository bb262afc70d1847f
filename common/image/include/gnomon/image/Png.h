#pragma once

#include <gnomon/base/Error.h>
#include <gnomon/image/Image.h>

#include <filesystem>

namespace gnomon::image {

/// Writes a file that is whole or not there at all: to a temporary file beside it, then renamed.
/// Light compression, for speed. Errors (Errc::file): the path and the system's reason.
/// @pre The image is sound.
Result<void> writePng(const std::filesystem::path& path, const Image& image);

/// Reads any PNG: 16 bits become 8, palettes RGB, anything with transparency RGBA.
/// Errors (Errc::file): missing, unreadable, not a PNG, cut short, larger than isSound() allows.
Result<Image> readPng(const std::filesystem::path& path);

}  // namespace gnomon::image

#pragma once

#include <gnomon/base/Error.h>
#include <gnomon/image/Image.h>

#include <filesystem>

namespace gnomon::image {

/// Writes a binary PGM (P5, maxval 255), whole or not at all. Errors as writePng().
/// @pre The image is sound and has one channel.
Result<void> writePgm(const std::filesystem::path& path, const Image& image);

/// Reads a binary PGM of maxval 255; comments in its header are skipped. Errors (Errc::file):
/// missing, unreadable, another kind of file, a size isSound() refuses, too few or too many bytes.
Result<Image> readPgm(const std::filesystem::path& path);

}  // namespace gnomon::image

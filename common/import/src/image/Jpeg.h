#pragma once

#include "image/Image.h"

namespace gnomon::importer {

bool isJpeg(std::span<const std::byte> file) noexcept;
/// Of a file that isJpeg().
Result<ImageHeader> jpegHeader(std::span<const std::byte> file);
Result<Image> decodedJpeg(std::span<const std::byte> file);

}  // namespace gnomon::importer

#pragma once

#include "image/Image.h"

namespace gnomon::importer {

bool isPng(std::span<const std::byte> file) noexcept;
/// Of a file that isPng(). Errors: it is cut short.
Result<ImageHeader> pngHeader(std::span<const std::byte> file);
/// Gamma and colour profiles do not count, as glTF wants it, nor do checksums.
Result<Image> decodedPng(std::span<const std::byte> file);

}  // namespace gnomon::importer

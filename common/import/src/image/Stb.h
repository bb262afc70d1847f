#pragma once

#include <cstddef>

/// stb_image's allocations: one that is larger than any image we accept needs fails, so that a
/// small file that inflates without end stops early.
namespace gnomon::importer {
void* stbAllocate(std::size_t bytes) noexcept;
void* stbResize(void* old, std::size_t bytes) noexcept;
void stbFree(void* memory) noexcept;
}  // namespace gnomon::importer

#define STBI_MALLOC(size) ::gnomon::importer::stbAllocate(size)
#define STBI_REALLOC(old, size) ::gnomon::importer::stbResize(old, size)
#define STBI_FREE(memory) ::gnomon::importer::stbFree(memory)
#define STBI_MAX_DIMENSIONS 16384
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>

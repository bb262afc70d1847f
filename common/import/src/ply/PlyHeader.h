#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::importer {

enum class PlyType { i8, u8, i16, u16, i32, u32, f32, f64 };

std::size_t bytesOf(PlyType type) noexcept;

struct PlyProperty {
    std::string name = {};
    PlyType type = PlyType::f32;  ///< of the value, or of a list's items
    bool isList = false;
    PlyType countType = PlyType::u8;
};

struct PlyElement {
    std::string name = {};
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties = {};
    /// The fewest bytes one of them takes in the file; a list may be empty.
    std::uint64_t leastBytes(bool ascii) const noexcept;
};

struct PlyHeader {
    enum class Format { ascii, littleEndian, bigEndian };
    Format format = Format::ascii;
    std::vector<PlyElement> elements = {};
    std::string texture = {};  ///< MeshLab's "comment TextureFile NAME"
    std::size_t bytes = 0;     ///< where the body begins
};

/// Refuses (throws) what is malformed, and elements that the rest of the file cannot hold.
PlyHeader parsedPlyHeader(std::string_view file);

}  // namespace gnomon::importer

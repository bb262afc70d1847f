#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "ply/PlyHeader.h"

namespace gnomon::importer {

/// Values of a PLY body, one after the other, whatever their form. Refuses (throws) at its end and
/// at what is no number.
class PlyBody {
public:
    PlyBody(std::string_view rest, PlyHeader::Format format) : rest_{rest}, format_{format} {}

    /// What is being read, for errors: element and number.
    void at(const PlyElement& element, std::uint64_t number) noexcept {
        element_ = &element;
        number_ = number;
    }
    double value(PlyType type);
    /// A list's length, which the rest of the file can hold.
    std::size_t listLength(const PlyProperty& property);
    std::size_t left() const noexcept { return rest_.size(); }
    [[noreturn]] void refuse(const std::string& what) const;

private:
    double binary(PlyType type);
    double text();

    std::string_view rest_;
    PlyHeader::Format format_;
    const PlyElement* element_ = nullptr;
    std::uint64_t number_ = 0;
};

}  // namespace gnomon::importer

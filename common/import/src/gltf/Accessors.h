#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>

#include "gltf/Document.h"

namespace gnomon::importer {

/// Elements of an accessor, all of which are known to lie inside their buffer.
class Accessor {
public:
    std::size_t count() const noexcept { return count_; }
    std::size_t components() const noexcept { return components_; }
    bool isFloat() const noexcept { return type_ == 5126; }
    bool isUnsignedInteger() const noexcept {
        return type_ == 5121 || type_ == 5123 || type_ == 5125;
    }
    /// "accessor 3 (POSITION)"
    const std::string& where() const noexcept { return where_; }

    /// Components of element @p i as floats; normalized integers become 0..1 or -1..1.
    /// @pre i < count(), to.size() <= components()
    void read(std::size_t i, std::span<float> to) const noexcept;
    /// @pre i < count(), isUnsignedInteger()
    std::uint32_t readIndex(std::size_t i) const noexcept;

private:
    friend class Accessors;
    std::string where_;
    const std::byte* base_ = nullptr;
    std::size_t stride_ = 0;
    std::size_t count_ = 0;
    std::size_t components_ = 1;
    std::uint32_t type_ = 5126;
    bool normalized_ = false;
    std::shared_ptr<const Bytes> owned_ = {};  // of sparse accessors
};

/// Checks accessors against their buffers, with 64-bit arithmetic and before anything is allocated.
class Accessors {
public:
    explicit Accessors(const GltfDocument& document) : document_{document} {}

    /// @param use  what for, for errors: "POSITION"
    /// Refuses what does not fit its buffer or is malformed.
    Accessor get(std::size_t number, std::string_view use);

private:
    struct Layout {
        std::size_t components = 0;
        std::size_t elementBytes = 0;
    };
    void placeDense(Accessor& accessor, const JsonView& json, const Layout& layout) const;
    std::shared_ptr<const Bytes> withSparse(const Accessor& accessor, const JsonView& sparse,
                                            const Layout& layout) const;

    const GltfDocument& document_;
    std::unordered_map<std::size_t, std::shared_ptr<const Bytes>> sparse_;
};

}  // namespace gnomon::importer

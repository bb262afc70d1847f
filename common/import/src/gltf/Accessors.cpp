#include "gltf/Accessors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "input/Report.h"

namespace gnomon::importer {
namespace {

/// Sparse accessors are written out in full; larger ones than this are refused.
constexpr std::uint64_t maxSparseBytes = std::uint64_t{256} << 20U;

/// What an accessor without a buffer view reads, again and again.
alignas(16) constexpr std::array<std::byte, 64> zeros{};

std::size_t componentBytes(std::uint64_t type) noexcept {
    switch (type) {
        case 5120:
        case 5121:
            return 1;
        case 5122:
        case 5123:
            return 2;
        case 5125:
        case 5126:
            return 4;
        default:
            return 0;
    }
}

std::size_t componentsOf(std::string_view type) noexcept {
    if (type == "SCALAR") return 1;
    if (type == "VEC2") return 2;
    if (type == "VEC3") return 3;
    if (type == "VEC4" || type == "MAT2") return 4;
    if (type == "MAT3") return 9;
    if (type == "MAT4") return 16;
    return 0;
}

template <class T>
T load(const std::byte* from) noexcept {
    T value{};
    std::memcpy(&value, from, sizeof value);
    return value;
}

template <class T>
void readIntegers(const std::byte* from, std::span<float> to, bool normalized) noexcept {
    const float scale = normalized ? static_cast<float>(std::numeric_limits<T>::max()) : 1.0F;
    for (std::size_t c = 0; c < to.size(); ++c)
        to[c] = std::max(static_cast<float>(load<T>(from + c * sizeof(T))) / scale,
                         normalized ? -1.0F : std::numeric_limits<float>::lowest());
}

}  // namespace

void Accessor::read(std::size_t i, std::span<float> to) const noexcept {
    const std::byte* from = base_ + i * stride_;
    switch (type_) {
        case 5120:
            return readIntegers<std::int8_t>(from, to, normalized_);
        case 5121:
            return readIntegers<std::uint8_t>(from, to, normalized_);
        case 5122:
            return readIntegers<std::int16_t>(from, to, normalized_);
        case 5123:
            return readIntegers<std::uint16_t>(from, to, normalized_);
        case 5125:
            return readIntegers<std::uint32_t>(from, to, normalized_);
        default:
            std::memcpy(to.data(), from, to.size_bytes());
    }
}

std::uint32_t Accessor::readIndex(std::size_t i) const noexcept {
    const std::byte* from = base_ + i * stride_;
    if (type_ == 5121) return load<std::uint8_t>(from);
    if (type_ == 5123) return load<std::uint16_t>(from);
    return load<std::uint32_t>(from);
}

Accessor Accessors::get(std::size_t number, std::string_view use) {
    const auto& all = document_.accessors();
    if (number >= all.size())
        refuse(
            fmt::format("{} is accessor {}, but there are {} accessors", use, number, all.size()));
    const JsonView json{all[number]};
    Accessor accessor;
    accessor.where_ = fmt::format("accessor {} ({})", number, printable(use));
    const auto wrong = [&](const std::string& what) { refuse(accessor.where_ + ": " + what); };

    const auto type = json.unsignedInteger("componentType").value_or(0);
    const auto shape = json.string("type", "");
    const auto count = json.unsignedInteger("count");
    const Layout layout{.components = componentsOf(shape),
                        .elementBytes = componentsOf(shape) * componentBytes(type)};
    if (layout.elementBytes == 0)
        wrong(
            fmt::format("componentType {} and type \"{}\", expected 5120-5123, 5125 or 5126 and "
                        "SCALAR, VEC2, VEC3, VEC4 or a matrix",
                        type, printable(shape, 30)));
    if (!count) wrong("count is missing");
    if (*count > 0xffffffffU) wrong(fmt::format("{} elements, the limit is 4294967295", *count));
    accessor.type_ = static_cast<std::uint32_t>(type);
    accessor.components_ = layout.components;
    accessor.count_ = static_cast<std::size_t>(*count);
    accessor.normalized_ = json.boolean("normalized", false);

    placeDense(accessor, json, layout);
    if (const auto sparse = json.object("sparse")) {
        auto& kept = sparse_[number];
        if (!kept) kept = withSparse(accessor, *sparse, layout);
        accessor.owned_ = kept;
        accessor.base_ = kept->data();
        accessor.stride_ = layout.elementBytes;
    }
    return accessor;
}

void Accessors::placeDense(Accessor& accessor, const JsonView& json, const Layout& layout) const {
    const auto& views = document_.views();
    const auto number = json.index("bufferView", views.size(), "buffer views");
    if (!number) {
        accessor.base_ = zeros.data();
        accessor.stride_ = 0;
        return;
    }
    const BufferView& view = views[*number];
    const auto offset = json.unsignedInteger("byteOffset", 0);
    const std::uint64_t stride = view.stride != 0 ? view.stride : layout.elementBytes;
    if (stride < layout.elementBytes)
        refuse(fmt::format("{}: elements of {} bytes, but buffer view {} has a byteStride of {}",
                           accessor.where_, layout.elementBytes, *number, stride));
    // offset < 2^53, count < 2^32, stride < 2^10: no overflow.
    const std::uint64_t end =
        offset + (accessor.count_ == 0 ? 0 : (accessor.count_ - 1) * stride + layout.elementBytes);
    if (end > view.bytes.size()) {
        const auto room = view.bytes.size() > offset ? view.bytes.size() - offset : 0;
        const auto holds =
            room < layout.elementBytes ? 0 : (room - layout.elementBytes) / stride + 1;
        refuse(
            fmt::format("{}: {} elements, but buffer view {} holds {}: {} bytes of {} are needed",
                        accessor.where_, accessor.count_, *number, holds, end, view.bytes.size()));
    }
    accessor.base_ = view.bytes.data() + offset;
    accessor.stride_ = static_cast<std::size_t>(stride);
}

std::shared_ptr<const Bytes> Accessors::withSparse(const Accessor& accessor, const JsonView& sparse,
                                                   const Layout& layout) const {
    const auto wrong = [&](const std::string& what) {
        refuse(accessor.where_ + ": sparse: " + what);
    };
    const std::uint64_t whole = std::uint64_t{accessor.count_} * layout.elementBytes;
    if (whole > maxSparseBytes)
        wrong(fmt::format("{} elements of {} bytes, the limit is {} MiB", accessor.count_,
                          layout.elementBytes, maxSparseBytes >> 20U));
    const auto count = sparse.unsignedInteger("count", 0);
    const auto indices = sparse.object("indices");
    const auto values = sparse.object("values");
    if (!indices || !values) wrong("indices or values are missing");
    if (count > accessor.count_)
        wrong(fmt::format("{} elements replaced of {}", count, accessor.count_));

    const auto part = [&](const JsonView& json, std::uint64_t elementBytes) {
        const auto number = json.index("bufferView", document_.views().size(), "buffer views");
        if (!number) json.refuse("bufferView is missing");
        const auto bytes = document_.views()[*number].bytes;
        const auto offset = json.unsignedInteger("byteOffset", 0);
        if (offset + count * elementBytes > bytes.size())
            wrong(fmt::format("{} elements, but buffer view {} has {} bytes after byte {}", count,
                              *number, bytes.size(), offset));
        return bytes.data() + offset;
    };
    const auto indexType = indices->unsignedInteger("componentType", 0);
    const auto indexBytes = componentBytes(indexType);
    if (indexType != 5121 && indexType != 5123 && indexType != 5125)
        wrong(fmt::format("componentType of the indices is {}, expected 5121, 5123 or 5125",
                          indexType));
    Accessor index;
    index.base_ = part(*indices, indexBytes);
    index.stride_ = indexBytes;
    index.type_ = static_cast<std::uint32_t>(indexType);
    const std::byte* value = part(*values, layout.elementBytes);

    Bytes bytes(static_cast<std::size_t>(whole));
    for (std::size_t i = 0; i < accessor.count_; ++i)
        std::memcpy(bytes.data() + i * layout.elementBytes, accessor.base_ + i * accessor.stride_,
                    layout.elementBytes);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = index.readIndex(i);
        if (at >= accessor.count_)
            wrong(fmt::format("index {} is {}, but there are {} elements", i, at, accessor.count_));
        std::memcpy(bytes.data() + at * layout.elementBytes, value + i * layout.elementBytes,
                    layout.elementBytes);
    }
    return std::make_shared<const Bytes>(std::move(bytes));
}

}  // namespace gnomon::importer

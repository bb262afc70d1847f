#include "Opaque.h"

#include <algorithm>
#include <array>

namespace gnomon::field {

namespace {

/// As many as the longest layout takes: 64 scalars of 8 bytes.
constexpr std::array<std::byte, std::size_t{64} * 8> zeros{};

}  // namespace

std::unique_ptr<FieldContainer> makeOpaque(const TypeInfo& info) {
    return std::make_unique<Opaque>(info);
}

/// Values that nobody wrote take no room: a schema may name many, and a creation is 12 bytes.
Opaque::Opaque(const TypeInfo& info) : info_{info}, values_(info.fields.size()) {}

Opaque::Value Opaque::readValue(Reader& from, const FieldInfo& field) const {
    Value value;
    if (field.layout == "p") {
        value.payload = from.payload();
    } else if (field.layout == "r") {
        value.ref = from.id();
    } else if (field.layout == "s") {
        Writer text;
        text.string(from.string());
        value.bytes = text.take();
    } else {
        const auto raw = from.bytes(minimumBytes(field.layout));
        value.bytes.assign(raw.begin(), raw.end());
    }
    return value;
}

void Opaque::writeValue(Writer& to, const FieldInfo& field, const Value& value) {
    if (field.layout == "p")
        to.payload(value.payload);
    else if (field.layout == "r")
        to.id(value.ref);
    else
        to.bytes(value.bytes);
}

void Opaque::use(const Value& now, const Value& old) {
    if (now.ref) uses_.addedRefs.push_back(now.ref);
    if (old.ref) uses_.droppedRefs.push_back(old.ref);
    if (now.payload) uses_.addedPayloads.push_back(now.payload);
    if (old.payload) uses_.droppedPayloads.push_back(old.payload);
}

void Opaque::write(Writer& to, Mask mask, bool /*whole*/) const {
    for (std::size_t i = 0; i < values_.size(); ++i) {
        if ((mask >> i & 1U) == 0) continue;
        if (info_.fields[i].multi) {
            const auto size = static_cast<std::uint32_t>(values_[i].size());
            to.scalar(size);
            to.scalar(std::uint32_t{0});
            to.scalar(size);
        } else if (values_[i].empty()) {
            // A string's empty length, every scalar's zero, and no reference: all zero bytes.
            to.bytes(std::span{zeros}.first(minimumBytes(info_.fields[i].layout)));
        }
        for (const Value& value : values_[i]) writeValue(to, info_.fields[i], value);
    }
}

void Opaque::read(Reader& from, Mask mask) {
    for (std::size_t i = 0; i < values_.size(); ++i) {
        if ((mask >> i & 1U) == 0) continue;
        touched_ |= Mask{1} << i;
        const FieldInfo& field = info_.fields[i];
        auto& values = values_[i];
        std::size_t size = 1;
        std::size_t first = 0;
        std::size_t count = 1;
        if (field.multi) {
            size = from.scalar<std::uint32_t>();
            first = from.scalar<std::uint32_t>();
            count = from.scalar<std::uint32_t>();
            if (from.failed() || count > from.remaining() / minimumBytes(field.layout) ||
                first + count > size || size > std::max(values.size(), first + count) ||
                first > values.size()) {
                from.fail("a multi field's range does not fit");
                return;
            }
            for (std::size_t k = size; k < values.size(); ++k) use({}, values[k]);
            values.resize(size);
        } else {
            values.resize(1);
        }
        for (std::size_t k = first; k < first + count && !from.failed(); ++k) {
            Value value = readValue(from, field);
            use(value, values[k]);
            values[k] = std::move(value);
        }
    }
}

Mask Opaque::takeTouched(UseLog& log) {
    const auto move = [](auto& from, auto& to) {
        to.insert(to.end(), from.begin(), from.end());
        from.clear();
    };
    move(uses_.addedRefs, log.addedRefs);
    move(uses_.droppedRefs, log.droppedRefs);
    move(uses_.addedPayloads, log.addedPayloads);
    move(uses_.droppedPayloads, log.droppedPayloads);
    return std::exchange(touched_, Mask{0});
}

void Opaque::dropUses(UseLog& log) {
    for (const auto& values : values_)
        for (const Value& value : values) use({}, value);
    takeTouched(log);
}

}  // namespace gnomon::field

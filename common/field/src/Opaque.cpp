#include "Opaque.h"

#include <algorithm>

namespace gnomon::field {

std::unique_ptr<FieldContainer> makeOpaque(const TypeInfo& info) {
    return std::make_unique<Opaque>(info);
}

Opaque::Opaque(const TypeInfo& info) : info_{info}, values_(info.fields.size()) {
    for (std::size_t i = 0; i < values_.size(); ++i) {
        if (info.fields[i].multi) continue;
        // A string's empty length and every scalar's zero are zero bytes.
        values_[i].push_back(
            {.bytes = std::vector<std::byte>(minimumBytes(info.fields[i].layout))});
    }
}

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

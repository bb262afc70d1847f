#pragma once

#include <gnomon/field/FieldContainer.h>

#include <vector>

namespace gnomon::field {

/// A container of a type only another process knows. Keeps its fields as they travel: each single
/// value, and each element of a multi field, as its encoded bytes, so that ranges can be applied,
/// references counted, and everything digested and forwarded.
class Opaque final : public FieldContainer {
public:
    explicit Opaque(const TypeInfo& info);
    void write(Writer& to, Mask mask, bool whole) const override;

protected:
    void read(Reader& from, Mask mask) override;
    Mask takeTouched(UseLog& log) override;
    void clearRanges() noexcept override {}
    void dropUses(UseLog& log) override;

private:
    struct Value {
        std::vector<std::byte> bytes = {};  ///< empty where the layout is a payload
        Payload payload = {};
        Id ref = {};
    };
    Value readValue(Reader& from, const FieldInfo& field) const;
    static void writeValue(Writer& to, const FieldInfo& field, const Value& value);
    void use(const Value& now, const Value& old);

    const TypeInfo& info_;
    std::vector<std::vector<Value>> values_;  // a single field has one at most; none: zero
    UseLog uses_;
    Mask touched_ = 0;
};

std::unique_ptr<FieldContainer> makeOpaque(const TypeInfo& info);

}  // namespace gnomon::field

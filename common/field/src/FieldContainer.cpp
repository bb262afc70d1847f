#include <fmt/format.h>
#include <gnomon/field/FieldContainer.h>

#include <iterator>

namespace gnomon::field {
namespace {

void printValue(std::string& to, Reader& from, std::string_view layout) {
    const auto out = std::back_inserter(to);
    bool first = true;
    for (const char letter : layout) {
        if (!std::exchange(first, false)) to += ' ';
        switch (letter) {
            case 'b':
                fmt::format_to(out, "{}", from.scalar<bool>());
                break;
            case 'B':
                fmt::format_to(out, "{}", from.scalar<std::uint8_t>());
                break;
            case 'i':
                fmt::format_to(out, "{}", from.scalar<std::int32_t>());
                break;
            case 'u':
                fmt::format_to(out, "{}", from.scalar<std::uint32_t>());
                break;
            case 'I':
                fmt::format_to(out, "{}", from.scalar<std::int64_t>());
                break;
            case 'U':
                fmt::format_to(out, "{}", from.scalar<std::uint64_t>());
                break;
            case 'f':
                fmt::format_to(out, "{}", from.scalar<float>());
                break;
            case 'd':
                fmt::format_to(out, "{}", from.scalar<double>());
                break;
            case 's':
                fmt::format_to(out, "\"{}\"", from.string());
                break;
            case 'r': {
                const Id id = from.id();
                fmt::format_to(out, "{}:{}", id.space(), id.counter());
                break;
            }
            default: {
                const auto low = from.scalar<std::uint64_t>();
                const auto high = from.scalar<std::uint64_t>();
                fmt::format_to(out, "{:016x}{:016x} ({} bytes)", high, low,
                               from.scalar<std::uint64_t>());
                break;
            }
        }
    }
}

}  // namespace

std::string print(const FieldContainer& container) {
    const TypeInfo& type = container.type();
    Writer encoded;
    container.write(encoded, type.allFields(), true);
    Reader from{encoded.written()};
    std::string text =
        fmt::format("{} {}:{} {{", type.name, container.id().space(), container.id().counter());
    for (const FieldInfo& field : type.fields) {
        text += " " + field.name + " = ";
        std::uint32_t count = 1;
        if (field.multi) {
            count = from.scalar<std::uint32_t>();
            from.scalar<std::uint32_t>();
            from.scalar<std::uint32_t>();
            text += '[';
        }
        for (std::uint32_t i = 0; i < count; ++i) {
            if (i > 0) text += ", ";
            printValue(text, from, field.layout);
        }
        text += field.multi ? "];" : ";";
    }
    return text + " }";
}

bool sameFields(const FieldContainer& a, const FieldContainer& b) {
    if (a.type().id != b.type().id) return false;
    Writer first;
    Writer second;
    a.write(first, a.type().allFields(), true);
    b.write(second, b.type().allFields(), true);
    const auto x = first.written();
    const auto y = second.written();
    return std::equal(x.begin(), x.end(), y.begin(), y.end());
}

}  // namespace gnomon::field

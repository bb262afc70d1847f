#include "Types.h"

#include <gnomon/field/Wire.h>
#include <gnomon/scene/Types.h>

namespace gnomon::fuzz {
namespace {

struct StrangeField {
    const char* name = "";
    const char* layout = "";
    bool multi = false;
};

void addType(field::Writer& to, const char* name, std::initializer_list<StrangeField> fields) {
    to.string(name);
    to.scalar(static_cast<std::uint32_t>(fields.size()));
    for (const auto& field : fields) {
        to.string(field.name);
        to.string(field.layout);
        to.scalar(static_cast<std::uint8_t>(field.multi));
    }
}

}  // namespace

field::TypeRegistry fuzzTypes() {
    field::TypeRegistry types;
    scene::addTypes(types);
    field::Writer schema;
    schema.scalar(2U);
    addType(schema, "Single",
            {{"text", "s"}, {"other", "r"}, {"data", "p"}, {"place", "dddfffffffff"}, {"on", "b"}});
    addType(schema, "Multi",
            {{"texts", "s", true},
             {"others", "r", true},
             {"data", "p", true},
             {"numbers", "iuIUfdB", true}});
    orThrow(types.agree(schema.written(), "a stranger"));
    return types;
}

std::vector<field::TypeId> fuzzTypeIds() {
    const auto schema = fuzzTypes().schema();
    field::Reader from{schema};
    std::vector<field::TypeId> ids;
    for (auto left = from.scalar<std::uint32_t>(); left > 0; --left) {
        ids.push_back(field::typeIdOf(from.string()));
        for (auto fields = from.scalar<std::uint32_t>(); fields > 0; --fields) {
            from.string();
            from.string();
            from.scalar<std::uint8_t>();
        }
    }
    return ids;
}

}  // namespace gnomon::fuzz

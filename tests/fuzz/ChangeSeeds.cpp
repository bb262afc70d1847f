#include <gnomon/field/Aspect.h>
#include <gnomon/scene/Geometry.h>
#include <gnomon/scene/Light.h>
#include <gnomon/scene/Material.h>
#include <gnomon/scene/Node.h>

#include <algorithm>

#include "Payloads.h"
#include "Seeds.h"
#include "Types.h"

namespace gnomon::fuzz {
namespace {

using field::Aspect;
using field::edit;
using field::FieldContainer;

std::uint8_t shortId(const FieldContainer& container) {
    return static_cast<std::uint8_t>(container.id().counter());
}

Step step(std::uint8_t kind, field::Writer& to) { return {.kind = kind, .bytes = to.take()}; }

/// The same as a whole list, entry by entry.
Script entries(const Aspect& aspect) {
    const auto ids = fuzzTypeIds();
    std::vector<const FieldContainer*> all;
    aspect.forEach([&](const FieldContainer& container) { all.push_back(&container); });
    std::ranges::sort(all, {}, [](const auto* container) { return container->id(); });
    Script script;
    for (const auto* container : all) {
        field::Writer to;
        const auto at = std::ranges::find(ids, container->type().id) - ids.begin();
        to.scalar(static_cast<std::uint8_t>(at));
        to.scalar(shortId(*container));
        script.push_back(step(1, to));
    }
    for (const auto* container : all) {
        field::Writer to;
        to.scalar(shortId(*container));
        to.scalar(container->type().allFields());
        container->write(to, container->type().allFields(), true);
        script.push_back(step(2, to));
    }
    script.push_back({.kind = 5});
    return script;
}

}  // namespace

void addChangeSeeds(const Seeds& seeds) {
    const auto types = fuzzTypes();
    for (const auto id : fuzzTypeIds()) {
        Aspect aspect{types, 2};
        aspect.create(*types.find(id));
        seeds.add("changes", "type-" + std::to_string(id), entries(aspect));
    }

    const auto payloads = knownPayloads();
    Aspect aspect{types, 2};
    const auto top = scene::makeNode<scene::Group>(aspect, "top");
    const auto place = scene::makeNode<scene::Transform>(aspect, "place");
    const auto shape = scene::makeNode<scene::Geometry>(aspect, "shape");
    const auto sun = scene::makeNode<scene::DirectionalLight>(aspect, "sun");
    edit(top.node)->addChild(sun.node);
    edit(sun.node)->addChild(place.node);
    edit(place.node)->addChild(shape.node);
    {
        auto e = edit(shape.core);
        e->positions = payloads[2];
        e->indices = payloads[1];
    }
    const auto first = aspect.commit();
    Script whole{{.kind = 0, .bytes = first.bytes}};
    seeds.add("changes", "scene", whole);
    seeds.add("changes", "scene-entries", entries(aspect));

    edit(place.node)->removeChild(shape.node);
    edit(top.node)->addChild(shape.node);
    edit(top.node)->name = std::string(300, 'x');
    whole.push_back({.kind = 0, .bytes = aspect.commit().bytes});
    edit(sun.node)->removeChild(place.node);
    orThrow(aspect.destroyTree(place.node));
    whole.push_back({.kind = 0, .bytes = aspect.commit().bytes});
    seeds.add("changes", "edits", whole);
}

}  // namespace gnomon::fuzz

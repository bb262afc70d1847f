#include <fmt/format.h>
#include <gnomon/client/Model.h>
#include <gnomon/import/Import.h>
#include <gnomon/scene/Light.h>

namespace gnomon::client {

using field::edit;
using field::Ref;

namespace {

template <class T>
std::vector<T> copy(const field::MultiField<T>& from) {
    return {from.begin(), from.end()};
}

/// The one ImportedScene among the containers from @p first on; nullptr where there is none or
/// more than one.
const scene::ImportedScene* importedScene(const field::Aspect& aspect, std::uint64_t offset) {
    const scene::ImportedScene* found = nullptr;
    int count = 0;
    aspect.forEach([&](const field::FieldContainer& container) {
        if (container.id().value <= offset) return;
        const auto* here = aspect.get(Ref<scene::ImportedScene>{container.id()});
        if (here == nullptr) return;
        found = here;
        ++count;
    });
    return count == 1 ? found : nullptr;
}

/// Is the list sound? Tried on an aspect of its own, because an error half way through a list
/// leaves an aspect half changed. Costs no copies: payloads are shared.
Result<void> tryOut(const field::TypeRegistry& types, std::uint16_t space,
                    const field::ChangeList& imported) {
    field::Aspect trial{types, space};
    const auto offset = trial.adopt(imported);
    if (!offset) return tl::unexpected{offset.error()};
    const auto* result = importedScene(trial, *offset);
    if (result == nullptr)
        return fail(Errc::protocol, "the importer's list does not hold exactly one scene");
    if (trial.get(result->root.get()) == nullptr)
        return fail(Errc::protocol, "the importer's scene has no root node");
    return {};
}

const scene::Light* lightOf(const field::Aspect& aspect, Ref<scene::Node> ref) {
    const scene::Node* node = aspect.get(ref);
    return node == nullptr ? nullptr : aspect.get(Ref<scene::Light>{node->core->id});
}

}  // namespace

Result<Model> adoptModel(field::Aspect& aspect, const SceneTree& tree,
                         const field::ChangeList& imported) {
    if (auto sound = tryOut(aspect.types(), aspect.space(), imported); !sound)
        return tl::unexpected{sound.error()};
    const auto offset = aspect.adopt(imported);
    if (!offset) return tl::unexpected{offset.error()};
    const auto* result = importedScene(aspect, *offset);
    const auto* content = aspect.get(tree.content);
    GNOMON_EXPECTS(result != nullptr && content != nullptr, "the list was tried out");
    edit(*content)->addChild(*aspect.get(result->root.get()));
    Model model;
    model.source = result->source;
    model.root = result->root;
    model.cameras = copy(result->cameras);
    model.animations = copy(result->animations);
    model.poses = copy(result->poses);
    model.lights = copy(result->lights);
    model.bounds = {.min = result->boundsMin, .max = result->boundsMax};
    model.triangles = result->trianglesDrawn;
    model.warnings = copy(result->warnings);
    return model;
}

Result<Model> loadModel(field::Aspect& aspect, const SceneTree& tree,
                        const std::filesystem::path& file, const ProgressCallback& progress) {
    importer::ImportOptions options;
    options.progress = progress;
    const auto imported = importer::importScene(file, options);
    if (!imported) return tl::unexpected{imported.error()};
    auto model = adoptModel(aspect, tree, *imported);
    if (!model)
        return fail(model.error().code,
                    fmt::format("{}: {}", file.filename().string(), model.error().what));
    return model;
}

void switchOffLights(field::Aspect& aspect, const Model& model) {
    for (const auto& node : model.lights)
        if (const auto* light = lightOf(aspect, node)) edit(*light)->on = false;
}

bool hasLight(const field::Aspect& aspect, const Model& model) {
    for (const auto& node : model.lights) {
        const auto* light = lightOf(aspect, node);
        if (light != nullptr && light->on) return true;
    }
    return false;
}

}  // namespace gnomon::client

#include <gnomon/client/SceneTree.h>

namespace gnomon::client {

using field::edit;

SceneTree makeSceneTree(field::Aspect& aspect) {
    const auto root = scene::makeNode<scene::Group>(aspect, "root");
    const auto beacons = scene::makeNode<scene::Group>(aspect, "beacons");
    const auto content = scene::makeNode<scene::Group>(aspect, "content");
    edit(root.node)->addChild(beacons.node);
    edit(root.node)->addChild(content.node);
    return {.root = root.node, .beacons = beacons.node, .content = content.node};
}

const scene::Node& insertAboveContent(field::Aspect& aspect, SceneTree& tree, std::string name,
                                      const scene::NodeCore& core) {
    const scene::Node* content = aspect.get(tree.content);
    GNOMON_EXPECTS(content != nullptr, "the scene tree is not of this aspect");
    const scene::Node* above = aspect.get(content->parent());
    GNOMON_EXPECTS(above != nullptr, "the scene tree's content was taken out of it");
    const scene::Node& node = aspect.create<scene::Node>();
    {
        auto e = edit(node);
        e->name = std::move(name);
        e->core = core;
    }
    edit(*above)->addChild(node);
    edit(node)->addChild(*content);
    tree.lights.emplace_back(node);
    return node;
}

const scene::Node& addBeacon(field::Aspect& aspect, const SceneTree& tree, std::string name,
                             const math::dmat4& worldFromBeacon) {
    const auto made = scene::makeNode<scene::Transform>(aspect, std::move(name));
    edit(made.core)->matrix = math::toAffine(worldFromBeacon);
    const scene::Node* beacons = aspect.get(tree.beacons);
    GNOMON_EXPECTS(beacons != nullptr, "the scene tree is not of this aspect");
    edit(*beacons)->addChild(made.node);
    return made.node;
}

}  // namespace gnomon::client

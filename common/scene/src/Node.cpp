#include <gnomon/scene/Node.h>

namespace gnomon::scene {

std::string Node::label() const {
    return "node \"" + name.get() + "\" (" + std::to_string(id().space()) + ":" +
           std::to_string(id().counter()) + ")";
}

bool Node::isBelow(const Node& node, int& depth) const {
    depth = 0;
    for (const Node* at = this; at != nullptr; at = aspect().get(at->parent_)) {
        if (at == &node) return true;
        if (++depth > maxDepth) return false;
    }
    return false;
}

void Node::addChild(const Node& child) {
    int depth = 0;
    if (isBelow(child, depth))
        throw Failure{Errc::edit, child.label() + " cannot become a child of " + label() +
                                      ": it is above it, or the same"};
    if (depth >= maxDepth)
        throw Failure{Errc::edit, child.label() + " cannot become a child of " + label() +
                                      ": it is deeper than " + std::to_string(maxDepth) +
                                      " levels"};
    if (const Node* old = aspect().get(child.parent_)) edit(*old)->removeChild(child);
    children_.pushBack(Ref<Node>{child});
    const_cast<Node&>(child).parent_ = Ref<Node>{*this};
}

void Node::removeChild(const Node& child) {
    for (std::size_t i = 0; i < children_.size(); ++i) {
        if (children_[i].id != child.id()) continue;
        children_.erase(i);
        const_cast<Node&>(child).parent_ = {};
        return;
    }
    throw Failure{Errc::edit, child.label() + " is not a child of " + label()};
}

void Node::changing(field::Mask mask) {
    if ((mask & field::maskOf<Node>("children")) == 0) return;
    for (const auto& ref : children_) {
        const Node* child = aspect().get(ref);
        if (child != nullptr && child->parent_.id == id()) const_cast<Node*>(child)->parent_ = {};
    }
}

void Node::changed(field::Mask mask) {
    if ((mask & field::maskOf<Node>("children")) == 0) return;
    for (const auto& ref : children_)
        if (const Node* child = aspect().get(ref))
            const_cast<Node*>(child)->parent_ = Ref<Node>{*this};
}

Result<void> Node::validate() const {
    for (const auto& ref : children_) {
        const Node* child = aspect().get(ref);
        if (child == nullptr) return fail(Errc::protocol, label() + " has a child that is no node");
        if (child->parent_.id != id())
            return fail(Errc::protocol, child->label() + " has two parents");
    }
    int depth = 0;
    for (const Node* at = aspect().get(parent_); at != nullptr; at = aspect().get(at->parent_)) {
        if (at == this) return fail(Errc::protocol, label() + " is above itself");
        if (++depth > maxDepth)
            return fail(Errc::protocol,
                        label() + " is deeper than " + std::to_string(maxDepth) + " levels");
    }
    return {};
}

}  // namespace gnomon::scene

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
        auto* child = const_cast<Node*>(aspect().get(ref));
        if (child == nullptr) continue;
        if (child->parent_.id == id()) child->parent_ = {};
        if (child->former_.id == id()) child->former_ = {};
    }
}

void Node::changed(field::Mask mask) {
    if ((mask & field::maskOf<Node>("children")) == 0) return;
    std::uint32_t place = 0;
    for (const auto& ref : children_) {
        if (auto* child = const_cast<Node*>(aspect().get(ref))) {
            if (child->parent_ && child->parent_.id != id()) child->former_ = child->parent_;
            child->parent_ = Ref<Node>{*this};
            child->place_ = place;
        }
        ++place;
    }
}

Result<void> Node::validate() const {
    for (std::uint32_t i = 0; i < children_.size(); ++i) {
        const Node* child = aspect().get(children_[i]);
        if (child == nullptr) return fail(Errc::protocol, label() + " has a child that is no node");
        if (child->parent_.id != id() || child->former_)
            return fail(Errc::protocol, child->label() + " has two parents");
        if (child->place_ != i)
            return fail(Errc::protocol, child->label() + " is a child of " + label() + " twice");
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

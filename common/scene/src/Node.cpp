#include <gnomon/scene/Node.h>

#include <algorithm>
#include <utility>

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
    auto& ours = const_cast<Node&>(child);
    ours.parent_ = Ref<Node>{*this};
    ours.listed_ = 1;
}

void Node::removeChild(const Node& child) {
    for (std::size_t i = 0; i < children_.size(); ++i) {
        if (children_[i].id != child.id()) continue;
        children_.erase(i);
        auto& gone = const_cast<Node&>(child);
        gone.parent_ = {};
        gone.listed_ = 0;
        return;
    }
    throw Failure{Errc::edit, child.label() + " is not a child of " + label()};
}

Node* Node::child(Ref<Node> ref) const { return const_cast<Node*>(aspect().get(ref)); }

/// They are no longer named here. An honest block takes a child from the parent it had, never from
/// the one that it gave it: else nobody would know who has it.
Result<void> Node::letGo(std::span<const Ref<Node>> children) {
    for (const auto& ref : children) {
        Node* gone = child(ref);
        if (gone == nullptr) continue;
        --gone->listed_;
        if (gone->parent_.id != id()) continue;
        gone->parent_ = {};
        if (gone->listed_ > 0) return fail(Errc::protocol, gone->label() + " has two parents");
    }
    return {};
}

Result<void> Node::changed(field::Mask mask) {
    if ((mask & field::maskOf<Node>("children")) == 0) return {};
    if (auto done = letGo(children_.dropped()); !done) return done;
    for (const auto& ref : children_.added()) {
        Node* came = child(ref);
        if (came == nullptr) {
            strange_ = true;
            continue;
        }
        ++came->listed_;
        came->parent_ = Ref<Node>{*this};
        fresh_.push_back(ref);
    }
    return {};
}

Result<void> Node::dropping() { return letGo(children_.get()); }

Result<void> Node::validate() {
    if (strange_) return fail(Errc::protocol, label() + " has a child that is no node");
    for (const auto& ref : std::exchange(fresh_, {})) {
        const Node* came = child(ref);
        if (came == nullptr || came->listed_ <= 1) continue;
        const auto times = std::count(children_.begin(), children_.end(), ref);
        return fail(Errc::protocol,
                    came->label() +
                        (times > 1 ? " is a child of " + label() + " twice" : " has two parents"));
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

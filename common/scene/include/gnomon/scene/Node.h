#pragma once

#include <gnomon/field/Aspect.h>
#include <gnomon/scene/FieldTypes.h>

#include <cstdint>
#include <string>

namespace gnomon::scene {

using field::Container;
using field::edit;
using field::entry;
using field::Field;
using field::MultiField;
using field::Payload;
using field::Ref;

/// What a node is: its core. One core may be shared by many nodes.
class NodeCore : public field::FieldContainer {};

/// A place in the scene's tree. Has one core, one parent and any number of children.
class Node final : public Container<Node> {
public:
    static constexpr std::string_view typeName = "Node";
    /// Deepest tree that is accepted; also ends the search for cycles.
    static constexpr int maxDepth = 1024;

    Field<std::string> name;
    Field<Ref<NodeCore>> core;

    const MultiField<Ref<Node>>& children() const noexcept { return children_; }
    /// The node that lists this one; follows the children fields, does not travel.
    Ref<Node> parent() const noexcept { return parent_; }

    /// Adds at the end; takes the child from its present parent first (which must be writable
    /// here).
    /// @throws Failure Errc::edit, naming both nodes, when it would close a cycle or make the tree
    ///         deeper than maxDepth.
    void addChild(const Node& child);
    /// @throws Failure Errc::edit when @p child is not a child of this node.
    void removeChild(const Node& child);

    static constexpr auto fields() {
        return std::tuple{entry("name", &Node::name), entry("core", &Node::core),
                          entry("children", &Node::children_)};
    }

protected:
    Result<void> changed(field::Mask mask) override;
    Result<void> dropping() override;
    Result<void> validate() override;

private:
    std::string label() const;
    Node* child(Ref<Node> ref) const;
    Result<void> letGo(std::span<const Ref<Node>> children);
    /// Where the way up from this node leads to @p node; depth counts the steps.
    bool isBelow(const Node& node, int& depth) const;

    MultiField<Ref<Node>> children_;
    Ref<Node> parent_ = {};
    std::uint32_t listed_ = 0;  // how many children fields name it; more than 1 within a block only
    std::vector<Ref<Node>> fresh_ = {};  // children that came since the last validate()
    bool strange_ = false;               // one of them is no node
};

/// Groups its children and does nothing else.
class Group final : public Container<Group, NodeCore> {
public:
    static constexpr std::string_view typeName = "Group";
    static constexpr auto fields() { return std::tuple{}; }
};

/// Places its children: parentFromChild.
class Transform final : public Container<Transform, NodeCore> {
public:
    static constexpr std::string_view typeName = "Transform";
    Field<math::Affine> matrix;
    static constexpr auto fields() { return std::tuple{entry("matrix", &Transform::matrix)}; }
};

/// A node with this core, both new in @p aspect.
template <class Core>
struct NodeWith {
    const Node& node;
    const Core& core;
};
template <class Core>
NodeWith<Core> makeNode(field::Aspect& aspect, std::string name) {
    const Core& core = aspect.create<Core>();
    const Node& node = aspect.create<Node>();
    auto e = edit(node);
    e->name = std::move(name);
    e->core = core;
    return {node, core};
}

}  // namespace gnomon::scene

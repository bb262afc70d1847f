#pragma once

#include <gnomon/client/Application.h>
#include <gnomon/scene/Geometry.h>

#include <random>
#include <vector>

namespace gnomon::soak {

/// Things that come, move, change their shape and go, a few of them each frame, decided by a seed.
/// Some shapes are alike, so that payloads are shared, released and needed again.
class Scenery {
public:
    Scenery(client::Application& app, unsigned seed) : app_{app}, random_{seed} {}

    void edit(int changes);
    std::size_t size() const { return things_.size(); }

private:
    static constexpr std::size_t usual = 300;
    struct Thing {
        field::Ref<scene::Node> place, body;
        field::Ref<scene::Transform> transform;
        field::Ref<scene::Geometry> geometry;
    };

    void add();
    void move(const Thing& thing);
    void reshape(const scene::Geometry& geometry);
    void remove(std::size_t index);
    std::size_t below(std::size_t bound) { return random_() % bound; }

    client::Application& app_;
    std::mt19937 random_;
    std::vector<Thing> things_ = {};
};

}  // namespace gnomon::soak

#include "Scenery.h"

#include <glm/gtc/matrix_transform.hpp>
#include <numeric>

namespace gnomon::soak {

using field::edit;

void Scenery::edit(int changes) {
    for (int i = 0; i < changes; ++i) {
        const auto what = below(10);
        // As many come as go when there are so many as there are to be.
        const bool more = below(2 * usual) >= things_.size();
        if (things_.empty() || (what < 2 && more)) {
            add();
            continue;
        }
        const auto at = below(things_.size());
        if (what < 2)
            remove(at);
        else if (what == 2)
            reshape(*app_.aspect().get(things_[at].geometry));
        else
            move(things_[at]);
    }
}

void Scenery::add() {
    auto& aspect = app_.aspect();
    const auto place = scene::makeNode<scene::Transform>(aspect, "place");
    const auto body = scene::makeNode<scene::Geometry>(aspect, "body");
    field::edit(place.node)->addChild(body.node);
    field::edit(app_.content())->addChild(place.node);
    reshape(body.core);
    things_.push_back(
        {.place = place.node, .body = body.node, .transform = place.core, .geometry = body.core});
    move(things_.back());
}

void Scenery::move(const Thing& thing) {
    const auto metres = [&] { return static_cast<double>(below(20'000)) * 1e-3 - 10.0; };
    const math::dvec3 to{metres(), metres(), metres()};
    field::edit(*app_.aspect().get(thing.transform))->matrix =
        math::toAffine(glm::translate(math::dmat4{1.0}, to));
}

/// One of a few sizes up to 60 kB, and of some of these one of few shapes.
void Scenery::reshape(const scene::Geometry& geometry) {
    const std::size_t triangles = std::size_t{20} << below(7);
    std::mt19937 shape{static_cast<unsigned>(below(2) == 0 ? below(6) : random_())};
    std::vector<float> coordinates(triangles * 9);
    std::vector<std::uint32_t> indices(triangles * 3);
    for (auto& coordinate : coordinates) coordinate = static_cast<float>(shape() % 1000) * 1e-3F;
    std::iota(indices.begin(), indices.end(), 0U);
    auto e = field::edit(geometry);
    e->positions = field::Payload::of(std::span<const float>{coordinates});
    e->indices = field::Payload::of(std::span<const std::uint32_t>{indices});
    e->boundsMax = math::vec3{1.0F};
    e->chunks.assign({scene::Chunk{.indexCount = static_cast<std::uint32_t>(indices.size()),
                                   .max = math::vec3{1.0F}}});
}

void Scenery::remove(std::size_t index) {
    auto& aspect = app_.aspect();
    const auto& place = *aspect.get(things_[index].place);
    field::edit(app_.content())->removeChild(place);
    orThrow(aspect.destroyTree(place));
    things_.erase(things_.begin() + static_cast<std::ptrdiff_t>(index));
}

}  // namespace gnomon::soak

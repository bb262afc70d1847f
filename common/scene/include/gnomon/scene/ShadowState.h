#pragma once

#include <gnomon/scene/Node.h>

namespace gnomon::scene {

/// One light's shadow maps for one fit group, the same on every server: the only thing a server
/// needs to know of a fit. Written by the session alone.
class ShadowState final : public Container<ShadowState> {
public:
    static constexpr std::string_view typeName = "ShadowState";
    // Weak, because the application destroys lights and screens before the session can follow.
    Field<field::WeakRef<Node>> light;  ///< the node whose core is the light
    /// The fit group: the screen all its tiles and eyes share, or the undecorated camera.
    Field<field::WeakRef<field::FieldContainer>> group;
    Field<std::string> filter{"hard"};
    Field<std::int32_t> mapSize{512};   ///< texels a side, of each map
    Field<std::int32_t> pageSize{512};  ///< texels a side; divides mapSize
    /// One map per entry (cascades have several): map clip space from world. Depth reversed, 1 at
    /// the light's near side; w > 0 for everything that can be looked up.
    MultiField<math::dmat4> clipFromWorld;
    /// What the fit group draws relative to, so that a map has the same bits wherever it is drawn.
    Field<math::dvec3> origin;
    /// Where the light is, homogeneous, world: w 1 at a place, w 0 in a direction (unit).
    Field<math::dvec4> source;
    /// What it shines from: tangent of a disk's angular radius where it is in a direction, radius
    /// in metres where it is at a place.
    Field<float> extent;
    Field<float> softness;  ///< radius of fixed kernels, metres
    /// How far lookups go around a place at the most, in units of the light's plane: metres where
    /// the light is in a direction, else tangents.
    Field<float> reach;
    Field<std::int32_t> kernelWidth{8};  ///< as ShadowViewport's
    Field<std::int32_t> kernelSamples;
    Field<float> quality{1.0F};  ///< of soft filters: times so many samples
    Field<bool> degenerate;      ///< the fit fell back to a plain one
    static constexpr auto fields() {
        return std::tuple{entry("light", &ShadowState::light),
                          entry("group", &ShadowState::group),
                          entry("filter", &ShadowState::filter),
                          entry("mapSize", &ShadowState::mapSize),
                          entry("pageSize", &ShadowState::pageSize),
                          entry("clipFromWorld", &ShadowState::clipFromWorld),
                          entry("origin", &ShadowState::origin),
                          entry("source", &ShadowState::source),
                          entry("extent", &ShadowState::extent),
                          entry("softness", &ShadowState::softness),
                          entry("reach", &ShadowState::reach),
                          entry("kernelWidth", &ShadowState::kernelWidth),
                          entry("kernelSamples", &ShadowState::kernelSamples),
                          entry("quality", &ShadowState::quality),
                          entry("degenerate", &ShadowState::degenerate)};
    }
};

}  // namespace gnomon::scene

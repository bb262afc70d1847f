#pragma once

#include <gnomon/client/Model.h>

#include <cstdint>
#include <vector>

namespace gnomon::client {

/// Plays models' animations into their transforms. Each repeats after its own duration. Of
/// animations of a model that move the same property of the same node, the first one plays.
///
/// animate() allocates nothing and writes only transforms whose matrix changed.
class AnimationPlayer {
public:
    /// Takes in all animations of the model. A channel whose keys are too few for what it says is
    /// left out.
    void play(const field::Aspect& aspect, const Model& model);
    /// @param time  seconds since the animations' start
    void animate(field::Aspect& aspect, double time);
    bool empty() const noexcept { return tracks_.empty(); }
    /// How many transforms the last animate() changed.
    std::size_t changed() const noexcept { return changed_; }

private:
    struct Pose {
        math::dvec3 translation{0.0};
        math::dvec4 rotation{0.0, 0.0, 0.0, 1.0};  ///< quaternion x y z w
        math::dvec3 scale{1.0};
    };
    struct Target {
        field::Ref<scene::Transform> transform = {};
        Pose pose = {};
        std::uint8_t written = 0;  ///< bit per path that a track writes
    };
    struct Track {
        std::size_t target = 0;
        scene::AnimationChannel::Path path = {};
        scene::AnimationChannel::Interpolation interpolation = {};
        field::Payload times = {};
        field::Payload values = {};
        double duration = 0.0;  ///< of its animation, seconds
    };

    std::size_t targetOf(const field::Aspect& aspect, const Model& model,
                         field::Ref<scene::Transform> transform);
    static math::Affine matrixOf(const Pose& pose) noexcept;

    std::vector<Target> targets_ = {};
    std::vector<Track> tracks_ = {};
    std::size_t changed_ = 0;
};

}  // namespace gnomon::client

#include <gnomon/client/AnimationPlayer.h>

#include <algorithm>
#include <cmath>

#include "KeySampler.h"

namespace gnomon::client {

using field::edit;
using field::Ref;
using Path = scene::AnimationChannel::Path;

namespace {

math::dmat3 rotationMatrix(const math::dvec4& q) noexcept {
    const double x = q.x, y = q.y, z = q.z, w = q.w;
    return math::dmat3{
        math::dvec3{1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)},
        math::dvec3{2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w)},
        math::dvec3{2.0 * (x * z + y * w), 2.0 * (y * z - x * w), 1.0 - 2.0 * (x * x + y * y)}};
}

}  // namespace

std::size_t AnimationPlayer::targetOf(const field::Aspect& aspect, const Model& model,
                                      Ref<scene::Transform> transform) {
    const auto known = std::find_if(targets_.begin(), targets_.end(), [&](const Target& target) {
        return target.transform == transform;
    });
    if (known != targets_.end()) return static_cast<std::size_t>(known - targets_.begin());
    Target target{.transform = transform};
    for (const auto& ref : model.poses) {
        const auto* pose = aspect.get(ref);
        if (pose == nullptr || pose->target.get() != transform) continue;
        target.pose.translation = pose->translation;
        target.pose.rotation = math::dvec4{pose->rotation.get()};
        target.pose.scale = math::dvec3{pose->scale.get()};
    }
    targets_.push_back(target);
    return targets_.size() - 1;
}

void AnimationPlayer::play(const field::Aspect& aspect, const Model& model) {
    for (const auto& animationRef : model.animations) {
        const auto* animation = aspect.get(animationRef);
        if (animation == nullptr) continue;
        std::vector<std::pair<std::size_t, std::uint8_t>> taken;
        for (const auto& channelRef : animation->channels) {
            const auto* channel = aspect.get(channelRef);
            if (channel == nullptr || aspect.get(channel->target.get()) == nullptr) continue;
            const Keys keys{.interpolation = channel->interpolation,
                            .times = channel->times->as<float>(),
                            .values = channel->values->as<float>()};
            if (!complete(keys, channel->path == Path::rotation ? 4 : 3)) continue;
            const std::size_t target = targetOf(aspect, model, channel->target);
            const auto bit = static_cast<std::uint8_t>(1U << static_cast<unsigned>(*channel->path));
            if ((targets_[target].written & bit) != 0) continue;
            taken.emplace_back(target, bit);
            tracks_.push_back({.target = target,
                               .path = channel->path,
                               .interpolation = channel->interpolation,
                               .times = channel->times,
                               .values = channel->values,
                               .duration = animation->duration});
        }
        // Marked after the animation, so that only an earlier animation shuts a channel out.
        for (const auto& [target, bit] : taken) targets_[target].written |= bit;
    }
}

math::Affine AnimationPlayer::matrixOf(const Pose& pose) noexcept {
    math::dmat3 linear = rotationMatrix(pose.rotation);
    for (int i = 0; i < 3; ++i) linear[i] *= pose.scale[i];
    return {.translation = pose.translation, .linear = math::mat3{linear}};
}

void AnimationPlayer::animate(field::Aspect& aspect, double time) {
    for (const Track& track : tracks_) {
        // Repeats; a single key, or keys all at 0, stays where it is.
        const double at =
            track.duration > 0.0 ? std::fmod(std::max(time, 0.0), track.duration) : 0.0;
        const Keys keys{.interpolation = track.interpolation,
                        .times = track.times.as<float>(),
                        .values = track.values.as<float>()};
        Pose& pose = targets_[track.target].pose;
        switch (track.path) {
            case Path::translation:
                pose.translation = sampleVector(keys, at);
                break;
            case Path::rotation:
                pose.rotation = sampleRotation(keys, at);
                break;
            case Path::scale:
                pose.scale = sampleVector(keys, at);
                break;
        }
    }
    changed_ = 0;
    for (const Target& target : targets_) {
        const auto* transform = aspect.get(target.transform);
        if (transform == nullptr) continue;  // destroyed by the application
        const math::Affine matrix = matrixOf(target.pose);
        if (matrix == transform->matrix.get() || !math::isFinite(math::toMatrix(matrix))) continue;
        edit(*transform)->matrix = matrix;
        ++changed_;
    }
}

}  // namespace gnomon::client

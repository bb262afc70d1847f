#include "gltf/Animations.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <set>
#include <span>

namespace gnomon::importer {

using scene::AnimationChannel;
using scene::edit;

namespace {

/// Keys of one channel beyond this are taken for a mistake.
constexpr std::size_t maxKeys = std::size_t{1} << 22U;

struct Sampled {
    AnimationChannel::Interpolation interpolation = AnimationChannel::Interpolation::linear;
    std::vector<float> times = {};
    std::vector<float> values = {};
};

class AnimationReader {
public:
    AnimationReader(const GltfDocument& document, Accessors& accessors,
                    std::vector<GltfAnimated>& nodes, SceneBuilder& to)
        : document_{document}, accessors_{accessors}, nodes_{nodes}, to_{to} {}

    void read(const JsonView& json);

private:
    /// Why a channel cannot be used; the channel alone is left out for it.
    struct Fault {
        std::string what;
    };
    const AnimationChannel* channel(const JsonView& json, std::span<const JsonView> samplers,
                                    float& duration);
    Sampled sampled(const JsonView& sampler, std::size_t components);
    void addPose(GltfAnimated& node);

    const GltfDocument& document_;
    Accessors& accessors_;
    std::vector<GltfAnimated>& nodes_;
    SceneBuilder& to_;
    std::set<std::pair<std::size_t, AnimationChannel::Path>> driven_;
};

void AnimationReader::read(const JsonView& json) {
    const auto samplers = json.objects("samplers");
    std::vector<field::Ref<AnimationChannel>> channels;
    float duration = 0.0F;
    driven_.clear();
    for (const JsonView& entry : json.objects("channels")) {
        try {
            if (const auto* made = channel(entry, samplers, duration))
                channels.push_back(field::Ref<AnimationChannel>{*made});
        } catch (const Fault& fault) {
            to_.report().warn(fmt::format("{}: {}; left out", entry.where(), fault.what));
        } catch (const Failure& failure) {  // what the accessors and getters say
            to_.report().warn(fmt::format("{}: {}; left out", entry.where(), failure.what()));
        }
    }
    if (channels.empty()) return;
    const auto& animation = to_.aspect().create<scene::Animation>();
    {
        auto e = edit(animation);
        e->name = printable(json.string("name", json.where()));
        e->duration = duration;
        e->channels.assign(std::move(channels));
    }
    to_.addAnimation(animation);
}

const AnimationChannel* AnimationReader::channel(const JsonView& json,
                                                 std::span<const JsonView> samplers,
                                                 float& duration) {
    using Path = AnimationChannel::Path;
    const auto target = json.object("target");
    if (!target) throw Fault{"has no target"};
    const auto number = target->index("node", nodes_.size(), "nodes");
    if (!number) return nullptr;  // an extension's business
    const auto name = target->string("path", "");
    Path path = Path::translation;
    if (name == "weights") {
        to_.report().warn("morph targets are not drawn: their animation is left out");
        return nullptr;
    }
    if (name == "rotation")
        path = Path::rotation;
    else if (name == "scale")
        path = Path::scale;
    else if (name != "translation")
        throw Fault{fmt::format("path is \"{}\"", printable(name))};
    GltfAnimated& node = nodes_[*number];
    if (node.transform == nullptr) return nullptr;  // not in the default scene
    if (node.pose.isMatrix)
        throw Fault{fmt::format("node {} has a matrix, which cannot be animated", *number)};
    if (!driven_.insert({*number, path}).second)
        throw Fault{fmt::format("{} of node {} is animated twice", name, *number)};
    const auto sampler = json.index("sampler", samplers.size(), "samplers");
    if (!sampler) throw Fault{"has no sampler"};
    const Sampled keys = sampled(samplers[*sampler], path == Path::rotation ? 4 : 3);

    addPose(node);
    duration = std::max(duration, keys.times.back());
    const auto& made = to_.aspect().create<AnimationChannel>();
    auto e = edit(made);
    e->target = *node.transform;
    e->path = path;
    e->interpolation = keys.interpolation;
    e->times = field::Payload::of(std::span<const float>{keys.times});
    e->values = field::Payload::of(std::span<const float>{keys.values});
    return &made;
}

Sampled AnimationReader::sampled(const JsonView& sampler, std::size_t components) {
    using Interpolation = AnimationChannel::Interpolation;
    Sampled out;
    const auto name = sampler.string("interpolation", "LINEAR");
    std::size_t perKey = 1;
    if (name == "STEP") {
        out.interpolation = Interpolation::step;
    } else if (name == "CUBICSPLINE") {
        out.interpolation = Interpolation::cubicSpline;
        perKey = 3;
    } else if (name != "LINEAR") {
        throw Fault{fmt::format("interpolation is \"{}\"", printable(name))};
    }
    const auto count = document_.accessors().size();
    const auto input = sampler.index("input", count, "accessors");
    const auto output = sampler.index("output", count, "accessors");
    if (!input || !output) throw Fault{"its sampler has no input or no output"};
    const Accessor times = accessors_.get(*input, "animation input");
    const Accessor values = accessors_.get(*output, "animation output");
    if (times.components() != 1 || !times.isFloat())
        throw Fault{times.where() + ": expected floats of type SCALAR"};
    if (times.count() == 0) throw Fault{times.where() + ": there are no keys"};
    if (times.count() > maxKeys)
        throw Fault{
            fmt::format("{}: {} keys, the limit is {}", times.where(), times.count(), maxKeys)};
    if (values.components() != components || values.count() != times.count() * perKey)
        throw Fault{fmt::format("{}: {} elements of {} components for {} keys, expected {} of {}",
                                values.where(), values.count(), values.components(), times.count(),
                                times.count() * perKey, components)};
    out.times.resize(times.count());
    for (std::size_t i = 0; i < out.times.size(); ++i) {
        times.read(i, std::span{&out.times[i], 1});
        if (!std::isfinite(out.times[i]) || (i > 0 && !(out.times[i] > out.times[i - 1])))
            throw Fault{
                fmt::format("{}: key {} is at {}, after {}; times must be finite and ascend",
                            times.where(), i, out.times[i], i > 0 ? out.times[i - 1] : 0.0F)};
    }
    out.values.resize(values.count() * components);
    for (std::size_t i = 0; i < values.count(); ++i)
        values.read(i, std::span{out.values}.subspan(i * components, components));
    for (const float v : out.values)
        if (!std::isfinite(v))
            throw Fault{values.where() + ": contains a value that is not finite"};
    return out;
}

void AnimationReader::addPose(GltfAnimated& node) {
    if (node.posed) return;
    node.posed = true;
    const auto& pose = to_.aspect().create<scene::AnimationPose>();
    {
        auto e = edit(pose);
        e->target = *node.transform;
        e->translation = node.pose.translation;
        e->rotation = math::vec4{node.pose.rotation};
        e->scale = math::vec3{node.pose.scale};
    }
    to_.addPose(pose);
}

}  // namespace

void addAnimations(const GltfDocument& document, Accessors& accessors,
                   std::vector<GltfAnimated>& nodes, SceneBuilder& to) {
    AnimationReader reader{document, accessors, nodes, to};
    for (const JsonView& json : document.root().objects("animations", "animation"))
        reader.read(json);
}

}  // namespace gnomon::importer

#pragma once

#include <gnomon/field/Aspect.h>
#include <gnomon/scene/Geometry.h>
#include <gnomon/scene/Imported.h>
#include <gnomon/scene/Light.h>
#include <gnomon/scene/Material.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "build/Exposure.h"
#include "input/Report.h"

namespace gnomon::importer {

/// A camera of the file, before its far plane is known.
struct CameraDraft {
    const scene::Node* beacon = nullptr;
    math::dvec3 eyeWorld{0.0};
    double fovy = 1.0;
    double near = 0.1;
    double far = 0.0;  ///< 0: so far that the scene is seen
};

/// Puts what readers find into an aspect, and closes the scene: lights above the content they
/// light, exposure, bounds, the ImportedScene.
class SceneBuilder {
public:
    /// Levels of nodes that a reader may use below content(); what is left of Node::maxDepth is for
    /// the root, the lights, and for the application to put above.
    static constexpr std::size_t maxLevels = 1010;
    /// More lights than this are left out.
    static constexpr std::size_t maxLights = 256;

    SceneBuilder(const field::TypeRegistry& types, Report& report);

    field::Aspect& aspect() noexcept { return aspect_; }
    Report& report() noexcept { return report_; }
    /// What readers hang their nodes under: below all lights.
    const scene::Node& content() const noexcept { return *content_; }

    /// Names are a file's own: they are made printable here.
    const scene::Node& addTransform(const scene::Node& parent, std::string_view name,
                                    const math::Affine& parentFromNode);
    const scene::Node& addGroup(const scene::Node& parent, std::string_view name);
    /// A material and a geometry below it. Cores are shared: the same material gets the same
    /// MaterialGroup at each use. @p worldFromParent is for the bounds.
    void addShape(const scene::Node& parent, std::string_view given,
                  const scene::Geometry& geometry, const scene::Material& material,
                  const math::dmat4& worldFromParent);
    void addLight(LightDraft light) { lights_.push_back(std::move(light)); }
    void addCamera(const CameraDraft& camera) { cameras_.push_back(camera); }
    void addAnimation(const scene::Animation& animation) { animations_.push_back(&animation); }
    void addPose(const scene::AnimationPose& pose) { poses_.push_back(&pose); }
    /// Levels of nodes below content() that the reader used.
    void useLevels(std::size_t levels) { levels_ = std::max(levels_, levels); }

    /// Closes the scene: what remains to do is to send it.
    field::ChangeList finish(const std::string& source);

private:
    const scene::Node& addLights(const scene::Node& root, std::vector<const scene::Node*>& made);
    std::vector<const scene::PerspectiveCamera*> makeCameras();

    Report& report_;
    field::Aspect aspect_;
    const scene::Node* content_ = nullptr;
    const scene::Group* group_ = nullptr;  // the one core of all plain nodes
    std::unordered_map<field::Id, const scene::MaterialGroup*> materialGroups_;
    std::vector<LightDraft> lights_;
    std::vector<CameraDraft> cameras_;
    std::vector<const scene::Animation*> animations_;
    std::vector<const scene::AnimationPose*> poses_;
    std::vector<math::Box> boxes_;  // of what is drawn, world space, for the exposure
    math::Box bounds_;
    std::uint64_t triangles_ = 0;
    std::size_t levels_ = 0;
};

}  // namespace gnomon::importer

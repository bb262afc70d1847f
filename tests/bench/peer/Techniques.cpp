// osgShadow's techniques with one map size, and with no light of their own where there is shadow.
#include "Techniques.h"

#include <functional>
#include <map>
#include <osgShadow/LightSpacePerspectiveShadowMap>
#include <osgShadow/MinimalShadowMap>
#include <osgShadow/ParallelSplitShadowMap>
#include <osgShadow/ShadowMap>
#include <osgShadow/SoftShadowMap>
#include <osgShadow/StandardShadowMap>
#include <osgShadow/ViewDependentShadowMap>

namespace peer {
namespace {

using Technique = osg::ref_ptr<osgShadow::ShadowTechnique>;

osg::Vec2s square(int size) { return {static_cast<short>(size), static_cast<short>(size)}; }
const osg::Vec2 noAmbient{0.0F, 1.0F};

template <class T>
Technique plain(int size) {
    osg::ref_ptr<T> made = new T;
    made->setTextureSize(square(size));
    made->setAmbientBias(noAmbient);
    return made;
}

/// The family of StandardShadowMap.
template <class T>
Technique standard(int size) {
    osg::ref_ptr<T> made = new T;
    made->setTextureSize(square(size));
    made->setMainVertexShader(nullptr);  // fixed function's light
    return made;
}

Technique splits(int size) {
    osg::ref_ptr<osgShadow::ParallelSplitShadowMap> made =
        new osgShadow::ParallelSplitShadowMap(nullptr, 3);
    made->setTextureResolution(static_cast<unsigned>(size));
    made->setAmbientBias(noAmbient);
    return made;
}

Technique viewDependent(int) { return new osgShadow::ViewDependentShadowMap; }

const std::map<std::string, std::function<Technique(int)>> all{
    {"None", [](int) { return Technique{}; }},
    {"ShadowMap", plain<osgShadow::ShadowMap>},
    {"SoftShadowMap", plain<osgShadow::SoftShadowMap>},
    {"ParallelSplit", splits},
    {"Standard", standard<osgShadow::StandardShadowMap>},
    {"Minimal", standard<osgShadow::MinimalShadowMap>},
    {"LispVB", standard<osgShadow::LightSpacePerspectiveShadowMapVB>},
    {"LispCB", standard<osgShadow::LightSpacePerspectiveShadowMapCB>},
    {"LispDB", standard<osgShadow::LightSpacePerspectiveShadowMapDB>},
    {"ViewDependent", viewDependent}};

}  // namespace

std::vector<std::string> techniqueNames() {
    std::vector<std::string> names;
    for (const auto& [name, make] : all) names.push_back(name);
    return names;
}

osg::ref_ptr<osgShadow::ShadowedScene> shadowedScene(const std::string& technique, int mapSize) {
    const auto found = all.find(technique);
    if (found == all.end()) return {};
    osg::ref_ptr<osgShadow::ShadowSettings> settings = new osgShadow::ShadowSettings;
    settings->setReceivesShadowTraversalMask(receives);
    settings->setCastsShadowTraversalMask(casts);
    settings->setTextureSize(square(mapSize));
    osg::ref_ptr<osgShadow::ShadowedScene> scene = new osgShadow::ShadowedScene;
    scene->setShadowSettings(settings);
    const Technique made = found->second(mapSize);
    if (made.valid()) scene->setShadowTechnique(made);
    return scene;
}

}  // namespace peer

#pragma once

#include <osg/Array>
#include <osg/Group>
#include <string>

namespace peer {

/// Triangles from a file as `gnomon bench` writes it (client/src/bench/PeerScene.h), one drawable a
/// part. All share one normal, the direction to the light, so that a lit pixel is white and the
/// picture is the shadow factor alone.
struct Model {
    osg::ref_ptr<osg::Group> node = {};
    osg::ref_ptr<osg::Vec3Array> normal = {};
};
/// @throws std::runtime_error
Model readModel(const std::string& file);

}  // namespace peer

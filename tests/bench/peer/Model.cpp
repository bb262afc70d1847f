#include "Model.h"

#include <cstdint>
#include <fstream>
#include <osg/Geometry>
#include <stdexcept>
#include <vector>

namespace peer {
namespace {

std::uint32_t number(std::ifstream& in) {
    std::uint32_t value = 0;
    in.read(reinterpret_cast<char*>(&value), sizeof value);
    return value;
}

osg::ref_ptr<osg::Geometry> readPart(std::ifstream& in, osg::Vec3Array* normal) {
    const auto vertices = number(in);
    const auto indices = number(in);
    if (!in) throw std::runtime_error("cut short");
    osg::ref_ptr<osg::Vec3Array> positions = new osg::Vec3Array(vertices);
    in.read(reinterpret_cast<char*>(&positions->front()),
            static_cast<std::streamsize>(vertices * sizeof(osg::Vec3)));
    osg::ref_ptr<osg::DrawElementsUInt> triangles =
        new osg::DrawElementsUInt(GL_TRIANGLES, indices);
    in.read(reinterpret_cast<char*>(&triangles->front()),
            static_cast<std::streamsize>(indices * sizeof(std::uint32_t)));
    osg::ref_ptr<osg::Geometry> part = new osg::Geometry;
    part->setVertexArray(positions);
    part->setNormalArray(normal, osg::Array::BIND_OVERALL);
    part->addPrimitiveSet(triangles);
    part->setUseDisplayList(false);
    part->setUseVertexBufferObjects(true);
    return part;
}

}  // namespace

Model readModel(const std::string& file) {
    std::ifstream in{file, std::ios::binary};
    const auto parts = number(in);
    if (!in) throw std::runtime_error(file + ": cannot be read");
    Model model{.node = new osg::Group, .normal = new osg::Vec3Array};
    model.normal->push_back(osg::Vec3(0.0F, 1.0F, 0.0F));
    for (std::uint32_t i = 0; i < parts; ++i) model.node->addChild(readPart(in, model.normal));
    if (!in) throw std::runtime_error(file + ": cut short");
    return model;
}

}  // namespace peer

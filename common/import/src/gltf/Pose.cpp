#include "gltf/Pose.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace gnomon::importer {
namespace {

template <std::size_t n>
void requireFloats(const JsonView& node, const char* key, const std::array<double, n>& values) {
    for (const double v : values)
        if (!std::isfinite(static_cast<float>(v)))
            node.refuse(fmt::format("{}: {:g} does not fit a float", key, v));
}

}  // namespace

math::dmat3 rotationTimesScale(const math::dvec4& q, const math::dvec3& scale) {
    const math::dvec3 x{1.0 - 2.0 * (q.y * q.y + q.z * q.z), 2.0 * (q.x * q.y + q.z * q.w),
                        2.0 * (q.x * q.z - q.y * q.w)};
    const math::dvec3 y{2.0 * (q.x * q.y - q.z * q.w), 1.0 - 2.0 * (q.x * q.x + q.z * q.z),
                        2.0 * (q.y * q.z + q.x * q.w)};
    const math::dvec3 z{2.0 * (q.x * q.z + q.y * q.w), 2.0 * (q.y * q.z - q.x * q.w),
                        1.0 - 2.0 * (q.x * q.x + q.y * q.y)};
    return math::dmat3{x * scale.x, y * scale.y, z * scale.z};
}

GltfPose gltfPose(const JsonView& node, Report& report) {
    GltfPose pose;
    std::array<double, 16> m{};
    if (node.numbers("matrix", m)) {
        requireFloats(node, "matrix", m);
        pose.isMatrix = true;
        math::dmat4 matrix;
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r) matrix[c][r] = m[static_cast<std::size_t>(c * 4 + r)];
        pose.parentFromNode = math::toAffine(matrix);
        return pose;
    }
    std::array<double, 3> t{0.0, 0.0, 0.0};
    std::array<double, 4> q{0.0, 0.0, 0.0, 1.0};
    std::array<double, 3> s{1.0, 1.0, 1.0};
    node.numbers("translation", t);
    node.numbers("rotation", q);
    node.numbers("scale", s);
    requireFloats(node, "translation", t);
    requireFloats(node, "rotation", q);
    requireFloats(node, "scale", s);
    pose.translation = {t[0], t[1], t[2]};
    pose.scale = {s[0], s[1], s[2]};
    const math::dvec4 rotation{q[0], q[1], q[2], q[3]};
    const double length = glm::length(rotation);
    if (length > 0.0)
        pose.rotation = rotation / length;
    else
        report.warn(node.where() + ": rotation is a quaternion of length 0; not rotated");
    pose.parentFromNode = {.translation = pose.translation,
                           .linear = math::mat3{rotationTimesScale(pose.rotation, pose.scale)}};
    return pose;
}

}  // namespace gnomon::importer

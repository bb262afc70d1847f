#include <embree3/rtcore.h>
#include <gnomon/truth/RayScene.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "AlphaMask.h"

namespace gnomon::truth {
namespace {

using math::dvec3;

using Vertex = std::array<float, 3>;

dvec3 pointOf(const Vertex& v) { return {v[0], v[1], v[2]}; }

/// What a ray asks for; handed to the filter functions through the context.
struct Asking {
    RTCIntersectContext context;  // first: Embree gives us a pointer to it
    bool drawn = false;           ///< only what is drawn: single-sided surfaces from their front
};

struct DeviceDeleter {
    void operator()(RTCDevice device) const noexcept { rtcReleaseDevice(device); }
};
struct SceneDeleter {
    void operator()(RTCScene scene) const noexcept { rtcReleaseScene(scene); }
};
struct GeometryDeleter {
    void operator()(RTCGeometry geometry) const noexcept { rtcReleaseGeometry(geometry); }
};
using Device = std::unique_ptr<RTCDeviceTy, DeviceDeleter>;
using Scene = std::unique_ptr<RTCSceneTy, SceneDeleter>;
using Geometry = std::unique_ptr<RTCGeometryTy, GeometryDeleter>;

void report(void*, RTCError code, const char* text) {
    if (code == RTC_ERROR_NONE) return;
    throw Failure{Errc::limit, std::string{"Embree: "} + (text == nullptr ? "" : text)};
}

/// A geometry as one kind of material shows it.
struct Mesh {
    Scene scene = {};
    std::vector<Vertex> vertices = {};
    std::vector<glm::uvec3> triangles = {};
    bool singleSided = false;
    std::unique_ptr<AlphaMask> mask = {};
};

void filter(const RTCFilterFunctionNArguments* a) {
    const auto& mesh = *static_cast<const Mesh*>(a->geometryUserPtr);
    const auto* asking = reinterpret_cast<const Asking*>(a->context);
    for (unsigned i = 0; i < a->N; ++i) {
        if (a->valid[i] == 0) continue;
        if (mesh.singleSided && asking->drawn) {
            const float facing = RTCRayN_dir_x(a->ray, a->N, i) * RTCHitN_Ng_x(a->hit, a->N, i) +
                                 RTCRayN_dir_y(a->ray, a->N, i) * RTCHitN_Ng_y(a->hit, a->N, i) +
                                 RTCRayN_dir_z(a->ray, a->N, i) * RTCHitN_Ng_z(a->hit, a->N, i);
            if (facing > 0.0F) {
                a->valid[i] = 0;
                continue;
            }
        }
        if (mesh.mask) {
            const auto& corners = mesh.triangles[RTCHitN_primID(a->hit, a->N, i)];
            if (!mesh.mask->covers(corners, RTCHitN_u(a->hit, a->N, i), RTCHitN_v(a->hit, a->N, i)))
                a->valid[i] = 0;
        }
    }
}

}  // namespace

struct RayScene::Parts {
    explicit Parts(const field::Aspect& a) : aspect{a}, device{rtcNewDevice(nullptr)} {
        if (!device) throw Failure{Errc::limit, "Embree cannot start on this processor"};
        rtcSetDeviceErrorFunction(device.get(), report, nullptr);
    }

    /// One use of a mesh, in both upper levels or one.
    struct Use {
        const Mesh* mesh = nullptr;
        Geometry seen = {};      ///< an instance in `drawn`
        Geometry blocking = {};  ///< and in `casters`; null where it does not cast
        math::dmat4 originFromLocal{1.0};
        math::dmat3 normalFromLocal{1.0};
    };
    struct Key {
        const scene::Geometry* geometry = nullptr;
        const scene::Material* mask = nullptr;  ///< null where it does not matter
        bool singleSided = false;
        friend auto operator<=>(const Key&, const Key&) = default;
    };

    const Mesh* mesh(const scene::FlatScene::Instance& instance);
    std::unique_ptr<Mesh> build(const scene::Geometry& geometry, const scene::PhongMaterial* masked,
                                bool singleSided) const;
    void rebuild(const scene::FlatScene& flat);
    void place(Use& use, const math::dmat4& worldFromLocal) const;
    Geometry instanceOf(const Mesh& mesh, RTCScene into, unsigned id) const;
    bool blocked(const math::vec3& from, const math::vec3& direction, float near,
                 float reach) const;

    const field::Aspect& aspect;
    Device device;
    std::map<Key, std::unique_ptr<Mesh>> meshes;
    std::vector<Use> uses;  ///< by instance of the flat scene; without mesh: not for rays
    Scene drawn;
    Scene casters;
    dvec3 origin{0.0};
    bool built = false;
};

const Mesh* RayScene::Parts::mesh(const scene::FlatScene::Instance& instance) {
    if (instance.geometry->primitive != scene::Primitive::triangles) return nullptr;
    const auto* phong = dynamic_cast<const scene::PhongMaterial*>(instance.material);
    const auto* own = dynamic_cast<const scene::ShaderMaterial*>(instance.material);
    using Alpha = scene::PhongMaterial::Alpha;
    if (phong != nullptr && phong->alpha == Alpha::blend) return nullptr;
    const bool masked = phong != nullptr && phong->alpha == Alpha::mask;
    const bool singleSided =
        (phong != nullptr && !phong->doubleSided) || (own != nullptr && !own->doubleSided);
    auto& slot = meshes[{.geometry = instance.geometry,
                         .mask = masked ? instance.material : nullptr,
                         .singleSided = singleSided}];
    if (!slot) slot = build(*instance.geometry, masked ? phong : nullptr, singleSided);
    return slot->triangles.empty() ? nullptr : slot.get();
}

std::unique_ptr<Mesh> RayScene::Parts::build(const scene::Geometry& geometry,
                                             const scene::PhongMaterial* masked,
                                             bool singleSided) const {
    auto made = std::make_unique<Mesh>();
    const auto positions = geometry.positions->as<Vertex>();
    const auto indices = geometry.indices->as<std::uint32_t>();
    made->singleSided = singleSided;
    made->vertices.assign(positions.begin(), positions.end());
    for (std::size_t i = 0; i + 3 <= indices.size(); i += 3) {
        const glm::uvec3 corners{indices[i], indices[i + 1], indices[i + 2]};
        if (corners.x >= positions.size() || corners.y >= positions.size() ||
            corners.z >= positions.size())
            return std::make_unique<Mesh>();  // the renderer draws nothing of it either
        made->triangles.push_back(corners);
    }
    if (made->triangles.empty()) return made;
    if (masked != nullptr) made->mask = std::make_unique<AlphaMask>(aspect, geometry, *masked);
    const Geometry triangles{rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE)};
    void* vertices =
        rtcSetNewGeometryBuffer(triangles.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(Vertex), made->vertices.size());
    std::copy(made->vertices.begin(), made->vertices.end(), static_cast<Vertex*>(vertices));
    void* corners =
        rtcSetNewGeometryBuffer(triangles.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                sizeof(glm::uvec3), made->triangles.size());
    std::copy(made->triangles.begin(), made->triangles.end(), static_cast<glm::uvec3*>(corners));
    rtcSetGeometryUserData(triangles.get(), made.get());
    if (made->mask || singleSided) rtcSetGeometryIntersectFilterFunction(triangles.get(), filter);
    if (made->mask) rtcSetGeometryOccludedFilterFunction(triangles.get(), filter);
    rtcCommitGeometry(triangles.get());
    made->scene = Scene{rtcNewScene(device.get())};
    rtcSetSceneFlags(made->scene.get(), RTC_SCENE_FLAG_ROBUST);
    rtcAttachGeometry(made->scene.get(), triangles.get());
    rtcCommitScene(made->scene.get());
    return made;
}

Geometry RayScene::Parts::instanceOf(const Mesh& mesh, RTCScene into, unsigned id) const {
    Geometry instance{rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_INSTANCE)};
    rtcSetGeometryInstancedScene(instance.get(), mesh.scene.get());
    rtcSetGeometryTimeStepCount(instance.get(), 1);
    rtcAttachGeometryByID(into, instance.get(), id);
    return instance;
}

void RayScene::Parts::rebuild(const scene::FlatScene& flat) {
    uses.clear();
    meshes.clear();
    for (Scene* top : {&drawn, &casters}) {
        *top = Scene{rtcNewScene(device.get())};
        rtcSetSceneFlags(top->get(), RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC);
    }
    const auto instances = flat.instances();
    uses.resize(instances.size());
    for (std::size_t i = 0; i < instances.size(); ++i) {
        Use& use = uses[i];
        use.mesh = mesh(instances[i]);
        if (use.mesh == nullptr) continue;
        use.seen = instanceOf(*use.mesh, drawn.get(), static_cast<unsigned>(i));
        if (instances[i].castsShadow)
            use.blocking = instanceOf(*use.mesh, casters.get(), static_cast<unsigned>(i));
        place(use, flat.worldFromLocal(instances[i]));
    }
}

void RayScene::Parts::place(Use& use, const math::dmat4& worldFromLocal) const {
    use.originFromLocal = worldFromLocal;
    use.originFromLocal[3] -= math::dvec4{origin, 0.0};
    // Normals go by the cofactors.
    const math::dmat3 m{worldFromLocal};
    use.normalFromLocal = {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
    const math::mat4 rounded{use.originFromLocal};
    for (RTCGeometry instance : {use.seen.get(), use.blocking.get()}) {
        if (instance == nullptr) continue;
        rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &rounded[0][0]);
        rtcCommitGeometry(instance);
    }
}

RayScene::RayScene(const field::Aspect& aspect) : parts_{std::make_unique<Parts>(aspect)} {}
RayScene::~RayScene() = default;
const math::dvec3& RayScene::origin() const noexcept { return parts_->origin; }

void RayScene::update(const scene::FlatScene& flat, const dvec3& origin) {
    Parts& p = *parts_;
    const bool shifted = origin != p.origin;
    p.origin = origin;
    if (!p.built || flat.rebuilt()) {
        p.rebuild(flat);
    } else if (shifted) {
        for (std::size_t i = 0; i < p.uses.size(); ++i)
            if (p.uses[i].mesh != nullptr)
                p.place(p.uses[i], flat.worldFromLocal(flat.instances()[i]));
    } else if (!flat.moved().empty()) {
        for (const std::uint32_t i : flat.moved())
            if (p.uses[i].mesh != nullptr)
                p.place(p.uses[i], flat.worldFromLocal(flat.instances()[i]));
    } else {
        return;
    }
    p.built = true;
    rtcCommitScene(p.drawn.get());
    rtcCommitScene(p.casters.get());
}

void RayScene::moveTo(const dvec3& origin) {
    Parts& p = *parts_;
    if (origin == p.origin) return;
    const math::dvec4 before{p.origin, 0.0};
    p.origin = origin;
    for (Parts::Use& use : p.uses) {
        if (use.mesh == nullptr) continue;
        math::dmat4 world = use.originFromLocal;
        world[3] += before;
        p.place(use, world);
    }
    rtcCommitScene(p.drawn.get());
    rtcCommitScene(p.casters.get());
}

unsigned RayScene::blocked(const RayPacket& packet) const {
    Asking asking{.context = {}, .drawn = false};
    rtcInitIntersectContext(&asking.context);
    asking.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    RTCRay8 rays{};
    for (std::size_t i = 0; i < RayPacket::size; ++i) {
        rays.org_x[i] = packet.from_[0][i];
        rays.org_y[i] = packet.from_[1][i];
        rays.org_z[i] = packet.from_[2][i];
        rays.dir_x[i] = packet.direction_[0][i];
        rays.dir_y[i] = packet.direction_[1][i];
        rays.dir_z[i] = packet.direction_[2][i];
        rays.tfar[i] = packet.reach_[i];
        rays.mask[i] = ~0U;
    }
    rtcOccluded8(packet.valid_, parts_->casters.get(), &asking.context, &rays);
    unsigned blocked = 0;
    for (std::size_t i = 0; i < RayPacket::size; ++i)
        if (packet.valid_[i] != 0 && rays.tfar[i] < 0.0F) blocked |= 1U << i;
    return blocked;
}

std::optional<RayScene::Hit> RayScene::firstHit(const dvec3& from, const dvec3& direction,
                                                double reach) const {
    Asking asking{.context = {}, .drawn = true};
    rtcInitIntersectContext(&asking.context);
    RTCRayHit query{};
    query.ray.org_x = static_cast<float>(from.x);
    query.ray.org_y = static_cast<float>(from.y);
    query.ray.org_z = static_cast<float>(from.z);
    query.ray.dir_x = static_cast<float>(direction.x);
    query.ray.dir_y = static_cast<float>(direction.y);
    query.ray.dir_z = static_cast<float>(direction.z);
    query.ray.tnear = 0.0F;
    query.ray.tfar = static_cast<float>(reach);
    query.ray.mask = ~0U;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(parts_->drawn.get(), &asking.context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    const Parts::Use& use = parts_->uses[query.hit.instID[0]];
    const auto& corners = use.mesh->triangles[query.hit.primID];
    const dvec3 a = pointOf(use.mesh->vertices[corners.x]);
    const dvec3 b = pointOf(use.mesh->vertices[corners.y]);
    const dvec3 c = pointOf(use.mesh->vertices[corners.z]);
    const double u = query.hit.u;
    const double v = query.hit.v;
    Hit hit{.distance = query.ray.tfar};
    hit.position = dvec3{use.originFromLocal * math::dvec4{a * (1.0 - u - v) + b * u + c * v, 1.0}};
    const dvec3 normal = use.normalFromLocal * glm::cross(b - a, c - a);
    const double length = glm::length(normal);
    // A triangle without area is never hit; one that a transform flattened faces the ray.
    hit.normal = length > 0.0 ? normal / length : -direction / glm::length(direction);
    if (glm::dot(hit.normal, direction) > 0.0) hit.normal = -hit.normal;
    return hit;
}

bool RayScene::Parts::blocked(const math::vec3& from, const math::vec3& direction, float near,
                              float reach) const {
    Asking asking{.context = {}, .drawn = false};
    rtcInitIntersectContext(&asking.context);
    RTCRay ray{};
    ray.org_x = from.x;
    ray.org_y = from.y;
    ray.org_z = from.z;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tnear = near;
    ray.tfar = reach;
    ray.mask = ~0U;
    rtcOccluded1(casters.get(), &asking.context, &ray);
    return ray.tfar < 0.0F;
}

bool RayScene::blocked(const dvec3& from, const dvec3& direction, double reach) const {
    return parts_->blocked(math::vec3{from}, math::vec3{direction}, 0.0F,
                           static_cast<float>(reach));
}

bool RayScene::shadowed(const Hit& hit, const dvec3& direction, double reach) const {
    // The start is off the surface by what floats of this size cannot tell: some units in the last
    // place of the position, of the vertices and of the transform.
    const dvec3 size = glm::abs(hit.position);
    const double slack = 0x1p-21 * (1.0 + std::max({size.x, size.y, size.z}));
    const dvec3 from = hit.position + hit.normal * slack;
    const double end = reach - slack;
    if (!(end > slack)) return false;
    return parts_->blocked(math::vec3{from}, math::vec3{direction}, static_cast<float>(slack),
                           static_cast<float>(end));
}

}  // namespace gnomon::truth

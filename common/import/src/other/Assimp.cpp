#include "other/Assimp.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "build/Phong.h"
#include "mesh/BuildGeometry.h"
#include "mesh/Normals.h"
#include "other/AssimpFiles.h"
#include "other/AssimpMaterials.h"

namespace gnomon::importer {
namespace {

constexpr std::size_t maxDepth = 1000;
constexpr std::size_t maxNodes = 1'000'000;

math::vec3 vec(const aiVector3D& v) { return {v.x, v.y, v.z}; }

math::dmat4 matrix(const aiMatrix4x4& m) {
    math::dmat4 out;
    for (unsigned r = 0; r < 4; ++r)
        for (unsigned c = 0; c < 4; ++c)
            out[static_cast<int>(c)][static_cast<int>(r)] = double{m[r][c]};
    return out;
}

/// A rotation whose -z axis is @p direction.
math::Affine towards(const math::vec3& direction, const math::vec3& position) {
    const math::vec3 z = unitOr(-math::dvec3{direction}, math::vec3{0.0F, 0.0F, 1.0F});
    const math::vec3 up =
        std::abs(z.y) < 0.99F ? math::vec3{0.0F, 1.0F, 0.0F} : math::vec3{1.0F, 0.0F, 0.0F};
    const math::vec3 x = glm::normalize(glm::cross(up, z));
    return {.translation = math::dvec3{position}, .linear = math::mat3{x, glm::cross(z, x), z}};
}

class AssimpReader {
public:
    AssimpReader(const aiScene& scene, Folder& folder, SceneBuilder& to)
        : scene_{scene},
          to_{to},
          materials_{scene, to.aspect(), folder, to.report()},
          geometries_(scene.mNumMeshes) {}

    void read(const math::Affine& worldFromRoot);

private:
    const scene::Geometry* geometry(unsigned number);
    std::optional<LightDraft> light(const aiLight& from) const;
    void addContents(const aiNode& from, const scene::Node& node, const math::dmat4& world);

    const aiScene& scene_;
    SceneBuilder& to_;
    AssimpMaterials materials_;
    std::vector<std::optional<const scene::Geometry*>> geometries_;
    std::multimap<std::string, const aiLight*> lights_;
};

const scene::Geometry* AssimpReader::geometry(unsigned number) {
    auto& made = geometries_[number];
    if (made) return *made;
    made = nullptr;
    const aiMesh& from = *scene_.mMeshes[number];
    const auto where = fmt::format("mesh {}", number);
    MeshData mesh;
    const unsigned corners = (from.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) != 0 ? 3
                             : (from.mPrimitiveTypes & aiPrimitiveType_LINE) != 0   ? 2
                                                                                    : 1;
    mesh.primitive = corners == 3   ? scene::Primitive::triangles
                     : corners == 2 ? scene::Primitive::lines
                                    : scene::Primitive::points;
    for (unsigned f = 0; f < from.mNumFaces; ++f) {
        const aiFace& face = from.mFaces[f];
        if (face.mNumIndices != corners) continue;
        for (unsigned k = 0; k < corners; ++k) {
            if (face.mIndices[k] >= from.mNumVertices)
                refuse(fmt::format("{}: face {} names vertex {}, but there are {}", where, f,
                                   face.mIndices[k], from.mNumVertices));
            mesh.indices.push_back(face.mIndices[k]);
        }
    }
    for (unsigned v = 0; v < from.mNumVertices; ++v) {
        mesh.positions.push_back(vec(from.mVertices[v]));
        if (from.HasNormals()) mesh.normals.push_back(vec(from.mNormals[v]));
        if (from.HasTextureCoords(0))
            mesh.texCoords.emplace_back(from.mTextureCoords[0][v].x, from.mTextureCoords[0][v].y);
        if (from.HasVertexColors(0)) {
            const aiColor4D& c = from.mColors[0][v];
            mesh.colors.push_back({byteOf(linearFromSrgb(double{c.r})),
                                   byteOf(linearFromSrgb(double{c.g})),
                                   byteOf(linearFromSrgb(double{c.b})), byteOf(double{c.a})});
        }
    }
    if (corners == 3 && !from.HasNormals()) {
        auto normals = creasedNormals(mesh.positions, mesh.indices);
        unshareVertices(mesh);
        mesh.normals = std::move(normals);
    }
    if (from.HasBones()) to_.report().warn("skins are not drawn: meshes stay in their bind pose");
    if (from.mNumAnimMeshes > 0)
        to_.report().warn("morph targets are not drawn: meshes keep their basic shape");
    const bool normalMap = static_cast<bool>(*materials_.get(from.mMaterialIndex).normalMap);
    made = buildGeometry(to_.aspect(), std::move(mesh), normalMap, to_.report(), where);
    return *made;
}

std::optional<LightDraft> AssimpReader::light(const aiLight& from) const {
    LightDraft draft{.name = from.mName.C_Str()};
    if (from.mType == aiLightSource_DIRECTIONAL)
        draft.kind = LightDraft::Kind::directional;
    else if (from.mType == aiLightSource_POINT)
        draft.kind = LightDraft::Kind::point;
    else if (from.mType == aiLightSource_SPOT)
        draft.kind = LightDraft::Kind::spot;
    else
        return {};
    const aiColor3D& c = from.mColorDiffuse;
    const double brightest = std::max({double{c.r}, double{c.g}, double{c.b}});
    if (!(brightest > 0.0 && brightest < 1.0e12)) return {};
    draft.intensity = brightest;
    draft.color = clamped(math::dvec3{c.r, c.g, c.b} / brightest);
    constexpr double halfPi = 1.5707963267948966;
    if (draft.kind == LightDraft::Kind::spot) {  // Assimp has whole angles
        draft.outerAngle = std::clamp(double{from.mAngleOuterCone} * 0.5, 0.01, halfPi);
        draft.innerAngle =
            std::clamp(double{from.mAngleInnerCone} * 0.5, 0.0, draft.outerAngle * 0.999);
    }
    return draft;
}

void AssimpReader::addContents(const aiNode& from, const scene::Node& node,
                               const math::dmat4& world) {
    for (unsigned i = 0; i < from.mNumMeshes; ++i) {
        const unsigned number = from.mMeshes[i];
        if (number >= scene_.mNumMeshes) refuse(fmt::format("a node names mesh {}", number));
        if (const auto* shape = geometry(number))
            to_.addShape(node, scene_.mMeshes[number]->mName.C_Str(), *shape,
                         materials_.get(scene_.mMeshes[number]->mMaterialIndex), world);
    }
    const auto [first, last] = lights_.equal_range(from.mName.C_Str());
    for (auto at = first; at != last; ++at) {
        auto draft = light(*at->second);
        if (!draft || !math::isFinite(world)) continue;
        const auto place = towards(vec(at->second->mDirection), vec(at->second->mPosition));
        draft->beacon = &to_.addTransform(node, draft->name + " beacon", place);
        draft->positionWorld = math::dvec3{world * math::dvec4{place.translation, 1.0}};
        to_.addLight(*std::move(draft));
    }
    lights_.erase(first, last);  // names may repeat; the first node has it
}

void AssimpReader::read(const math::Affine& worldFromRoot) {
    for (unsigned i = 0; i < scene_.mNumLights; ++i)
        lights_.emplace(scene_.mLights[i]->mName.C_Str(), scene_.mLights[i]);
    struct Open {
        const aiNode* from;
        const scene::Node* parent;
        math::dmat4 worldFromParent;
        std::size_t depth;
    };
    const auto& root = to_.addTransform(to_.content(), "root", worldFromRoot);
    std::vector<Open> open{{scene_.mRootNode, &root, math::toMatrix(worldFromRoot), 1}};
    for (std::size_t count = 0; !open.empty(); ++count) {
        const Open now = open.back();
        open.pop_back();
        if (now.from == nullptr) continue;
        if (now.depth > maxDepth || count > maxNodes)
            refuse(fmt::format("more than {} nodes, or nodes deeper than {}", maxNodes, maxDepth));
        const auto parentFromNode = matrix(now.from->mTransformation);
        const auto affine = math::toAffine(parentFromNode);
        const auto world = now.worldFromParent * math::toMatrix(affine);
        if (!math::isFinite(math::toMatrix(affine))) {
            to_.report().warn(fmt::format("node \"{}\": its place is not finite; left out",
                                          printable(now.from->mName.C_Str())));
            continue;
        }
        const auto& node = to_.addTransform(*now.parent, now.from->mName.C_Str(), affine);
        to_.useLevels(now.depth + 4);
        addContents(*now.from, node, world);
        for (unsigned i = now.from->mNumChildren; i > 0; --i)
            open.push_back({now.from->mChildren[i - 1], &node, world, now.depth + 1});
    }
}

}  // namespace

void readWithAssimp(const std::filesystem::path& file, Folder& folder, SceneBuilder& to) {
    Assimp::Importer importer;
    // Assimp's own dump: nobody's models are in it, and its reader believes every number.
    importer.UnregisterLoader(importer.GetImporter("assbin"));
    importer.SetIOHandler(std::make_unique<AssimpFiles>(file, folder).release());  // now its own
    // Cameras have no use here; components that are removed need not be checked.
    importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                                aiComponent_CAMERAS | aiComponent_ANIMATIONS);
    to.report().progress(0.1, "reading");
    const aiScene* scene = importer.ReadFile(
        file.string(), aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_GenUVCoords |
                           aiProcess_TransformUVCoords | aiProcess_FlipUVs);
    if (scene == nullptr) {
        const std::string why = importer.GetErrorString();
        refuse(why.empty() ? "is of no format that can be read" : printable(why, 300));
    }
    if (scene->mNumAnimations > 0) to.report().warn("animations are read from glTF files only");
    if (scene->mNumCameras > 0) to.report().warn("cameras are read from glTF files only");
    auto extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    // FBX counts in centimetres (Assimp's root already holds the file's own unit and axes).
    const math::Affine worldFromRoot{.linear = math::mat3{extension == ".fbx" ? 0.01F : 1.0F}};
    to.report().progress(0.5, "building");
    AssimpReader{*scene, folder, to}.read(worldFromRoot);
}

}  // namespace gnomon::importer
